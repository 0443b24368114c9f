/* Owns the bounds of what is drawn: tighter than geometry's for what is cut. */
#ifndef VS_SOLIDS_DRAWN_BOUNDS_H
#define VS_SOLIDS_DRAWN_BOUNDS_H

#include "geometry/tolerance.h"
#include "kernel/evaluate.h"
#include "model/node.h"

enum { VS_DRAWN_BOUNDS_MOST = 400 }; /* a budget (below) that takes some hundredths of a second */

/* How bounds are looked for. */
typedef struct {
  const vs_fineness *facets; /* tolerance 0: by the rule of drawings */
  const vs_kernel_options *options;
  size_t *budget;            /* how many shapes may be combined, less what was used; NULL: any number */
  bool at_most;              /* set where more would be needed: the bounds are those of the operands */
} vs_drawn_search;

/* The bounds of a node without endless parts. Of primitives, placed ones and unions of them they are exact. Of what is
 * cut, or turned with corners that no formula knows, sides that the triangles do not come near to are drawn in to them;
 * a side that they come near to, as near as facets come to what is round, stays as the formula has it. Fails as *e
 * says. */
bool vs_drawn_bounds(const vs_ref *ref, vs_drawn_search *search, vs_bounds *out, vs_error *e);
/* The same of several things drawn, united. Unions are gone into, so that what is not cut in them costs nothing. */
bool vs_drawn_bounds_all(const vs_ref *refs, size_t count, vs_drawn_search *search, vs_bounds *out, vs_error *e);

#endif
