/* Declares the fineness of curves: the one rule that every back-end and the kernel share. */
#ifndef VS_GEOMETRY_TOLERANCE_H
#define VS_GEOMETRY_TOLERANCE_H

#include "model/vec.h"

typedef struct {
  double tolerance; /* the largest distance of a chord from its arc, in model units, > 0 */
  int segments;     /* > 0: facets of a full turn, for every node whose own field is 0 */
} vs_fineness;

/* Returns the default tolerance of a drawing: the power of two nearest to 1/4000 of the diagonal of its bounds. */
double vs_fineness_tolerance(const vs_bounds *drawing);
/* Returns the facets of a full turn of radius r: by the node's own segments, else by f->segments, else by f->tolerance.
 * By tolerance there are at least 32, and a multiple of 4, because quarter turns must be vertices. */
int vs_fineness_turn(const vs_fineness *f, double r, int segments);
/* Returns the facets by the tolerance alone, but no fewer than `least`. The tolerance and `least` are above 0. */
int vs_fineness_turn_least(const vs_fineness *f, double r, int least);
/* Returns the fineness inside a placement a: a chord's distance is then f's tolerance in the drawing. The scale is
 * rounded to a power of two: rotations and small differences change nothing, and equal parts stay equal. */
vs_fineness vs_fineness_placed(const vs_fineness *f, const vs_affine *a);

#endif
