/* Declares the kinds of numbers to which corners are rounded, and the counts of that rounding. */
#ifndef VS_KERNEL_ROUND_ROUNDED_H
#define VS_KERNEL_ROUND_ROUNDED_H

#include "model/vec.h"

typedef enum {
  VS_NUMBERS_DOUBLE,
  VS_NUMBERS_DIGITS /* 12 significant digits */,
  VS_NUMBERS_SINGLE /* 32 bits */,
  VS_NUMBERS_LOOSE /* 32 bits, without indices */
} vs_numbers;

typedef struct {
  size_t collapsed;       /* number of edges */
  size_t flipped;         /* number of edges of triangles lower than the distance by which rounding moves their
                           * corners */
  size_t met;             /* number of triangles that meet others after rounding, near edges that were too short or
                           * triangles that were too low; as far as doubles can decide */
  vs_vec3 at;             /* position of the first of them */
  size_t met_before;      /* number of those pairs that meet before rounding as well, so that the format is not the
                           * cause; all of them if the format's numbers are finer than the exact mesh */
  size_t lost;            /* number of corners where mending moved the surface by more than sixteen units */
  vs_vec3 lost_at;
  size_t dropped;         /* number of shells thinner than the numbers can represent */
  vs_vec3 dropped_at;
} vs_rounded;

#endif
