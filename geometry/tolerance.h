/* Owns how finely curves are cut: the one rule that every back-end and the kernel share. */
#ifndef VS_GEOMETRY_TOLERANCE_H
#define VS_GEOMETRY_TOLERANCE_H

#include "model/vec.h"

typedef struct {
  double tolerance; /* chord height, model units, > 0 */
  int segments;     /* > 0: facets a turn for every node whose own field is 0 */
} vs_fineness;

/* The default chord height of a drawing: the power of two nearest 1/4000 of the diagonal of its bounds. */
double vs_fineness_tolerance(const vs_bounds *drawing);
/* Facets a full turn of radius r: by the node's own segments, then f->segments, then f->tolerance; never fewer than 32
 * by tolerance; a multiple of 4 by tolerance so that quarter turns are vertices. */
int vs_fineness_turn(const vs_fineness *f, double r, int segments);
/* by the tolerance alone, but at least so many. The tolerance and `least` are above 0. */
int vs_fineness_turn_least(const vs_fineness *f, double r, int least);
/* The rule inside a placement: a chord that a shrinks or stretches keeps its height in the drawing. Stretch goes by
 * powers of two, so that turns and small differences change nothing and equal parts stay equal. */
vs_fineness vs_fineness_placed(const vs_fineness *f, const vs_affine *a);

#endif
