/* Compares a part of a picture with the whole picture (PNG or EXR): `cutdiff WHOLE PART X Y` compares pixel (x, y) of
 * PART with pixel (x + X, y + Y) of WHOLE. Prints the number of pixels that differ in luminance, and the largest
 * difference with its position in PART. Exits with 0 if none differs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/tools/read_picture.h"

int main(int argc, char **argv) {
  vs_store *s = vs_store_new(NULL, NULL);
  vs_raster whole = { 0 }, part = { 0 };
  if (argc != 5 || !read_picture(s, "cutdiff", argv[1], &whole) || !read_picture(s, "cutdiff", argv[2], &part)) return 2;
  size_t left = (size_t)atoi(argv[3]), top = (size_t)atoi(argv[4]), differ = 0, at = 0;
  if (left + part.columns > whole.columns || top + part.rows > whole.rows)
    return fprintf(stderr, "cutdiff: the part reaches past the whole\n"), 2;
  double most = 0;
  for (size_t i = 0; i < (size_t)part.columns * part.rows; i++) {
    size_t x = i % part.columns, y = i / part.columns;
    double d = fabs(part.at[i] - whole.at[(top + y) * whole.columns + left + x]);
    differ += d > 0;
    if (d > most) most = d, at = i;
  }
  printf("%zu pixels differ, the largest by %.6f at %zu %zu\n", differ, most, at % part.columns, at / part.columns);
  vs_raster_free(&whole);
  vs_raster_free(&part);
  vs_store_release(s);
  return differ > 0;
}
