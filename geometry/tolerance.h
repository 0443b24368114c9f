/* Declares the fineness of curves: one rule for the number of facets of a curve, which all back-ends and the kernel
 * use. */
#ifndef VS_GEOMETRY_TOLERANCE_H
#define VS_GEOMETRY_TOLERANCE_H

#include "model/vec.h"

typedef struct {
  double tolerance; /* largest distance of a chord from its arc, in model units; above 0 */
  int segments;     /* Number of facets of a full turn, or a minimum. Above 0: the number for every node whose field
                     * `segments` is 0. Below 0: the tolerance determines the number, and -segments is its minimum. 0:
                     * the minimum is 32. */
} vs_fineness;

/* Returns the default tolerance of a drawing: the power of two nearest to 1/4000 of the diagonal of its bounds. */
double vs_fineness_tolerance(const vs_bounds *drawing);
/* Returns the number of facets of a full turn with radius r. It is the node's `segments` if above 0, else f->segments
 * if above 0. Otherwise f->tolerance determines the number; it is then a multiple of 4, because quarter turns must be
 * vertices. */
int vs_fineness_turn(const vs_fineness *f, double r, int segments);
/* Returns the minimum of the number of facets of a full turn, for curves whose tolerance determines this number. */
int vs_fineness_least(const vs_fineness *f);
/* Returns the number of facets of a full turn by the tolerance alone, but no less than `least`. The tolerance and
 * `least` must be above 0. */
int vs_fineness_turn_least(const vs_fineness *f, double r, int least);
/* Returns the fineness to use inside a placement a, so that the distance of chords in the drawing stays within f's
 * tolerance. The scale of a is rounded to a power of two, so that equal parts at slightly different scales remain
 * equal. */
vs_fineness vs_fineness_placed(const vs_fineness *f, const vs_affine *a);

#endif
