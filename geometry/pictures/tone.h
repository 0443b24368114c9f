/* Declares the conversion of linear light to values for a screen: exposure, tone curve, and sRGB bytes. */
#ifndef VS_GEOMETRY_PICTURES_TONE_H
#define VS_GEOMETRY_PICTURES_TONE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
  VS_TONE_NEUTRAL, /* Khronos PBR Neutral (2024), which web pages also use */
  VS_TONE_AGX,    /* AgX by Troy Sobotka in Benjamin Wrensch's approximation (2023), with the contrast of its look
                   * 'punchy' */
  VS_TONE_FILMIC, /* John Hable, Filmic Tonemapping Operators (2010): the curve of Uncharted 2 */
  VS_TONE_LINEAR  /* no tone curve is applied, and light above white is clipped */
} vs_tone_curve;

typedef struct {
  vs_tone_curve curve;
  bool fixed;      /* true: the exposure is `stops`; false: the exposure is `stops` more than vs_tone_exposure computes
                    * for the picture */
  double stops;
  bool dither;     /* true if neighbouring pixels with equal light may be rounded to different bytes, so that a gradient
                    * shows no bands */
  uint32_t left, top; /* column and row of the picture's first pixel within a larger picture, so that the dithering of
                       * its parts fits together */
} vs_tone;

/* A picture in linear light: for each pixel a red, green and blue number of linear sRGB, row by row from the top. */
typedef struct { const float *red, *green, *blue; uint32_t columns, rows; } vs_light;
static inline size_t vs_light_pixels(const vs_light *light) { return (size_t)light->columns * light->rows; }

/* Returns the exposure of the picture in stops, by Reinhard's method (Parameter Estimation for Photographic Tone
 * Reproduction, 2002) with changes for bright and dark scenes; 0 for a black picture. */
double vs_tone_exposure(const vs_light *light, vs_tone_curve curve);
/* Converts the picture to sRGB; rgb receives three bytes for each pixel. Returns the exposure that was applied, in
 * stops. */
double vs_tone_apply(const vs_light *light, const vs_tone *tone, unsigned char *rgb);

#endif
