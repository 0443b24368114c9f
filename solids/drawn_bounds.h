/* Owns the bounds of what is drawn: tighter than geometry's for what is cut. */
#ifndef VS_SOLIDS_DRAWN_BOUNDS_H
#define VS_SOLIDS_DRAWN_BOUNDS_H

#include "geometry/tolerance.h"
#include "kernel/evaluate.h"
#include "model/node.h"

enum { VS_DRAWN_BOUNDS_MOST = 400 }; /* a budget (below) that takes some hundredths of a second */

/* The bounds of a node without endless parts. Of primitives, placed ones and unions of them they are exact. Of what is
 * cut, or turned with corners that no formula knows, sides that the triangles do not come near to are drawn in to them;
 * a side that they come near to, as near as facets come to what is round, stays as the formula has it.
 * facets->tolerance 0: by the rule of drawings. budget: how many shapes may be combined for it, less what this call
 * used; NULL: any number. Where more would be needed the bounds are those of the operands, and *at_most (may be NULL)
 * becomes true. False: *e says why. */
bool vs_drawn_bounds(const vs_ref *ref, const vs_fineness *facets, const vs_kernel_options *options, size_t *budget,
                     vs_bounds *out, bool *at_most, vs_error *e);
/* The same of several things drawn, united. Unions are gone into, so that what is not cut in them costs nothing. */
bool vs_drawn_bounds_all(const vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                         size_t budget, vs_bounds *out, bool *at_most, vs_error *e);

#endif
