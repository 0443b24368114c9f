/* Compares two EXR pictures as numbers: `exrdiff A.exr B.exr`. Prints the number of pixels; the number of pixels that
 * differ in luminance by more than a hundredth; the mean of all differences; and the largest difference with its
 * position. Exits with 0 if both files can be read and have equal sizes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/tools/read_picture.h"

int main(int argc, char **argv) {
  vs_store *s = vs_store_new(NULL, NULL);
  vs_raster a = { 0 }, b = { 0 };
  if (argc != 3 || !read_picture(s, "exrdiff", argv[1], &a) || !read_picture(s, "exrdiff", argv[2], &b)) return 2;
  if (a.columns != b.columns || a.rows != b.rows) return fprintf(stderr, "exrdiff: they have different sizes\n"), 1;
  size_t count = (size_t)a.columns * a.rows, differ = 0, at = 0;
  double sum = 0, most = 0;
  for (size_t i = 0; i < count; i++) {
    double d = fabs(a.at[i] - b.at[i]);
    sum += d;
    differ += d > 0.01;
    if (d > most) most = d, at = i;
  }
  printf("%zu pixels, %zu differ, mean %.6f, largest %.6f at %zu %zu\n", count, differ, sum / (double)count, most, at % a.columns, at / a.columns);
  vs_raster_free(&a);
  vs_raster_free(&b);
  vs_store_release(s);
  return 0;
}
