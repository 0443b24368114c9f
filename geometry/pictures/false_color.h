/* Declares false colours: a number for each pixel becomes a colour, with a legend beside the picture. */
#ifndef VS_GEOMETRY_PICTURES_FALSE_COLOR_H
#define VS_GEOMETRY_PICTURES_FALSE_COLOR_H

#include "geometry/files/pixels.h"
#include "model/node.h"

/* Numbers from least to most become colours from dark blue through green and yellow to dark red; steps > 0: in so many
 * equal bands. */
typedef struct {
  double least, most;
  bool logarithmic;
  int steps;
  const char *unit; /* digits and the letters of "cd/m2 h lx" */
} vs_color_scale;

/* Returns the range of all numbers except the hundredth at either end; logarithmic: of those above 0, at most six
 * powers of ten. */
vs_color_scale vs_color_scale_of(const float *at, size_t count, bool logarithmic, const char *unit);
/* Sets a number's sRGB bytes: Anton Mikhailov's Turbo (Google AI Blog, 2019). */
void vs_false_color(const vs_color_scale *s, double x, unsigned char rgb[3]);
/* A number for each pixel, row by row from the top; NaN: no number. */
typedef struct { const float *at; uint32_t columns, rows; } vs_pixel_numbers;

/* Makes a picture of the numbers with a legend, in the store's memory; pixels without a number stay blank. Returns
 * false when memory is out. */
bool vs_false_color_picture(vs_store *store, const vs_pixel_numbers *numbers, const vs_color_scale *s, vs_pixels *out,
                            vs_error *e);

/* Draws a legend's digits and letters into a picture, dark, from (x, y) down and to the right. */
void vs_picture_text(const vs_pixels *picture, uint32_t x, uint32_t y, const char *text);

#endif
