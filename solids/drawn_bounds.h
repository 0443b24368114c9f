/* Owns the bounds of drawn objects: tighter than geometry's if they are cut. */
#ifndef VS_SOLIDS_DRAWN_BOUNDS_H
#define VS_SOLIDS_DRAWN_BOUNDS_H

#include "geometry/tolerance.h"
#include "kernel/evaluate.h"
#include "model/node.h"

enum { VS_DRAWN_BOUNDS_MOST = 400 }; /* a budget (below) that takes some hundredths of a second */

/* The settings of a search for bounds. */
typedef struct {
  const vs_fineness *facets; /* tolerance 0: by the rule of drawings */
  const vs_kernel_options *options;
  size_t *budget;            /* number of shapes that may still be combined; the search subtracts from it; NULL: no
                              * limit */
  bool at_most;              /* set if the search would need more: the bounds are then those of the operands */
} vs_drawn_search;

/* Computes the bounds of a node without endless parts. They are exact for primitives, placed ones and unions of them.
 * For objects that are cut, or turned and without a formula for their corners, the function moves sides inwards to the
 * triangles. A side stays at the formula's place if triangles are as near to it as facets are to a curved surface.
 * Returns false and sets *e on failure. */
bool vs_drawn_bounds(const vs_ref *ref, vs_drawn_search *search, vs_bounds *out, vs_error *e);
/* Computes the united bounds of several drawn objects. The search enters unions, so their parts without cuts cost
 * nothing. */
bool vs_drawn_bounds_all(const vs_ref *refs, size_t count, vs_drawn_search *search, vs_bounds *out, vs_error *e);

#endif
