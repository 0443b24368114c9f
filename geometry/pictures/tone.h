/* Owns the way from linear light to the numbers of a screen: exposure, a tone curve, sRGB. */
#ifndef VS_GEOMETRY_PICTURES_TONE_H
#define VS_GEOMETRY_PICTURES_TONE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
  VS_TONE_NEUTRAL, /* Khronos PBR Neutral (2024): the web page's */
  VS_TONE_AGX,    /* Troy Sobotka's AgX as Benjamin Wrensch's fit has it (2023), with the contrast of its punchy look */
  VS_TONE_FILMIC, /* John Hable, Filmic Tonemapping Operators (2010): the curve of Uncharted 2 */
  VS_TONE_LINEAR  /* none: what is brighter than white is cut off */
} vs_tone_curve;

typedef struct {
  vs_tone_curve curve;
  bool fixed;      /* stops are over the light as it is; else over the exposure that vs_tone_exposure finds */
  double stops;
} vs_tone;

/* A picture in light: planes of numbers of linear sRGB, row by row. */
typedef struct { const float *red, *green, *blue; uint32_t columns, rows; } vs_light;
static inline size_t vs_light_pixels(const vs_light *light) { return (size_t)light->columns * light->rows; }

/* Stops by which the picture is to be brightened, from the histogram of its luminance: what takes its bright end to
 * just below the curve's white, or where that is more, what Erik Reinhard, Parameter Estimation for Photographic
 * Tone Reproduction, Journal of Graphics Tools 7(1), 2002, finds. A black picture: 0. */
double vs_tone_exposure(const vs_light *light, vs_tone_curve curve);
/* Makes three bytes a pixel, sRGB. Returns the stops that it brightened by. The curve is one of vs_tone_curve. */
double vs_tone_apply(const vs_light *light, const vs_tone *tone, unsigned char *rgb);

#endif
