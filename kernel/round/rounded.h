/* Owns the kinds of numbers that corners are rounded to, and what is counted when a mesh is. */
#ifndef VS_KERNEL_ROUND_ROUNDED_H
#define VS_KERNEL_ROUND_ROUNDED_H

#include "model/vec.h"

typedef enum {
  VS_NUMBERS_DOUBLE,
  VS_NUMBERS_DIGITS /* 12 significant */,
  VS_NUMBERS_SINGLE /* 32 bits */,
  VS_NUMBERS_LOOSE /* the same, without indices */
} vs_numbers;

typedef struct {
  size_t collapsed;       /* edges */
  size_t flipped;         /* edges, of triangles lower than rounding moves their corners */
  size_t met;             /* triangles that, rounded, may meet others near where edges were too short or triangles too
                           * low; as far as doubles can tell */
  vs_vec3 at;             /* of the first of them */
  size_t met_before;      /* pairs of them that meet before rounding as well, so that it is not the numbers that are to
                           * blame; all of them where the numbers are finer than what is exact */
  size_t lost;            /* corners where mending moved the surface by more than sixteen units */
  vs_vec3 lost_at;
  size_t dropped;         /* shells thinner than the numbers tell apart */
  vs_vec3 dropped_at;
} vs_rounded;

#endif
