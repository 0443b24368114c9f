/* Declares the kinds of numbers to which corners are rounded, and counts of the changes that rounding requires. */
#ifndef VS_KERNEL_ROUND_ROUNDED_H
#define VS_KERNEL_ROUND_ROUNDED_H

#include "model/vec.h"

typedef enum {
  VS_NUMBERS_DOUBLE,
  VS_NUMBERS_DIGITS /* decimal numbers with 12 significant digits */,
  VS_NUMBERS_SINGLE /* 32-bit floating-point numbers */,
  VS_NUMBERS_LOOSE /* 32-bit floating-point numbers in a format that repeats the positions of the corners for each
                    * triangle, without vertex numbers */
} vs_numbers;

typedef struct {
  size_t collapsed;       /* number of edges that were too short for the format and were collapsed */
  size_t flipped;         /* number of edges that were flipped because their triangle was lower than the distance by
                           * which rounding moves its corners */
  size_t met;             /* number of triangles that intersect other triangles after rounding, as far as computation in
                           * doubles can decide */
  vs_vec3 at;             /* position of the first triangle that intersects another triangle after rounding */
  size_t met_before;      /* Greater than 0 if some triangles counted in `met` intersect before rounding as well, so
                           * that the format is not the cause. Counts pairs of triangles; for numbers finer than the
                           * exact mesh, it is set to `met`. */
  size_t lost;            /* number of corners where the repair moved the surface by more than sixteen units of the last
                           * place */
  vs_vec3 lost_at;
  size_t dropped;         /* number of removed shells (connected parts of the surface), which were thinner than the
                           * numbers can represent */
  vs_vec3 dropped_at;
} vs_rounded;

#endif
