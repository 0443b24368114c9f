/* Declares the functions for the conversion of linear light to screen values: exposure, a tone curve, sRGB. */
#ifndef VS_GEOMETRY_PICTURES_TONE_H
#define VS_GEOMETRY_PICTURES_TONE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
  VS_TONE_NEUTRAL, /* Khronos PBR Neutral (2024): the web page's curve */
  VS_TONE_AGX,    /* Troy Sobotka's AgX in Benjamin Wrensch's approximation (2023), with the contrast of its punchy
                   * look */
  VS_TONE_FILMIC, /* John Hable, Filmic Tonemapping Operators (2010): the curve of Uncharted 2 */
  VS_TONE_LINEAR  /* none: light above white is clipped */
} vs_tone_curve;

typedef struct {
  vs_tone_curve curve;
  bool fixed;      /* stops are relative to the picture's own light; else to the exposure of vs_tone_exposure */
  double stops;
} vs_tone;

/* A picture in light: planes of linear sRGB numbers, row by row. */
typedef struct { const float *red, *green, *blue; uint32_t columns, rows; } vs_light;
static inline size_t vs_light_pixels(const vs_light *light) { return (size_t)light->columns * light->rows; }

/* Returns the stops of exposure by the histogram of the picture's luminance: the larger of two. The first takes the
 * picture's bright end just below the curve's white; the second is that of Erik Reinhard, Parameter Estimation for
 * Photographic Tone Reproduction, Journal of Graphics Tools 7(1), 2002. A black picture: 0. */
double vs_tone_exposure(const vs_light *light, vs_tone_curve curve);
/* Makes three bytes for each pixel, sRGB. Returns the stops of exposure. The curve is one of vs_tone_curve. */
double vs_tone_apply(const vs_light *light, const vs_tone *tone, unsigned char *rgb);

#endif
