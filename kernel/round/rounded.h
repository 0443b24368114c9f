/* Declares the kinds of numbers to which corners are rounded, and counts of the changes that rounding requires. */
#ifndef VS_KERNEL_ROUND_ROUNDED_H
#define VS_KERNEL_ROUND_ROUNDED_H

#include "model/vec.h"

typedef enum {
  VS_NUMBERS_DOUBLE,
  VS_NUMBERS_DIGITS /* numbers with 12 significant digits */,
  VS_NUMBERS_SINGLE /* 32-bit floating-point numbers */,
  VS_NUMBERS_LOOSE /* 32-bit floating-point numbers in a format without vertex numbers */
} vs_numbers;

typedef struct {
  size_t collapsed;       /* number of short edges that were collapsed */
  size_t flipped;         /* number of flipped edges, in triangles lower than the distance by which rounding moves their
                           * corners */
  size_t met;             /* number of triangles that intersect other triangles after rounding, near short edges or low
                           * triangles, as far as doubles can decide */
  vs_vec3 at;             /* position of the first triangle that intersects another after rounding */
  size_t met_before;      /* number of the intersecting triangles that intersect before rounding as well, so that the
                           * format is not the cause. If the format's numbers are finer than the exact mesh, it is the
                           * number of all of them */
  size_t lost;            /* number of corners where the repair moved the surface by more than sixteen units */
  vs_vec3 lost_at;
  size_t dropped;         /* number of removed shells, which were thinner than the numbers can represent */
  vs_vec3 dropped_at;
} vs_rounded;

#endif
