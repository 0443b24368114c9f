/* Declares false colours: a number for each pixel becomes a colour, with a legend beside the picture. */
#ifndef VS_GEOMETRY_PICTURES_FALSE_COLOR_H
#define VS_GEOMETRY_PICTURES_FALSE_COLOR_H

#include "geometry/files/pixels.h"
#include "model/node.h"

/* The scale of colours: numbers from `least` to `most` become colours from dark blue through green and yellow to dark
 * red. steps: number of equal bands, each with one colour; 0: colours change continuously. */
typedef struct {
  double least, most;
  bool logarithmic;
  int steps;
  const char *unit; /* text of the unit of the numbers, such as "lx"; only digits and the letters of "cd/m2 h lx" can be
                     * drawn */
} vs_color_scale;

/* Returns a scale of colours for `count` numbers at `at`, without the least and the greatest hundredth of them. If
 * `logarithmic` is true, it covers only numbers above 0, and at most six powers of ten. */
vs_color_scale vs_color_scale_of(const float *at, size_t count, bool logarithmic, const char *unit);
/* Sets rgb to the colour of the number x as sRGB bytes, by Anton Mikhailov's colour map Turbo (Google AI Blog,
 * 2019). */
void vs_false_color(const vs_color_scale *s, double x, unsigned char rgb[3]);
/* A number for each pixel, row by row from the top; NaN if the pixel has no number. */
typedef struct { const float *at; uint32_t columns, rows; } vs_pixel_numbers;

/* Makes a picture of the numbers as colours, with a legend, in the store's memory. Pixels without a number stay blank.
 * Returns false when memory is out. */
bool vs_false_color_picture(vs_store *store, const vs_pixel_numbers *numbers, const vs_color_scale *s, vs_pixels *out,
                            vs_error *e);

/* Draws dark text into a picture, in letters of five by seven pixels. (x, y): upper left corner of the text, in
 * pixels. */
void vs_picture_text(const vs_pixels *picture, uint32_t x, uint32_t y, const char *text);

#endif
