/* Declares the bounds of drawn objects. For cut objects, they are tighter than the bounds that geometry/ computes. */
#ifndef VS_SOLIDS_DRAWN_BOUNDS_H
#define VS_SOLIDS_DRAWN_BOUNDS_H

#include "geometry/tolerance.h"
#include "kernel/evaluate.h"
#include "model/node.h"

enum { VS_DRAWN_BOUNDS_MOST = 400 }; /* greatest useful value of the member `budget` of vs_drawn_search: a search that
                                      * meshes so many shapes takes some hundredths of a second */

/* The settings of a search for bounds. */
typedef struct {
  const vs_fineness *facets; /* fineness of the meshes; if its tolerance is 0, the default tolerance of drawings
                              * applies */
  const vs_kernel_options *options;
  size_t *budget;            /* number of shapes in booleans that the search may still mesh; it decreases during the
                              * search; NULL: no limit */
  bool at_most;              /* result: true if the budget was too small; the bounds are then those of the operands
                              * without cuts */
} vs_drawn_search;

/* Computes the bounds of a node that has no unbounded parts. They are exact for primitives and unions of placed
 * primitives. For cut or rotated objects, a mesh makes them tighter. Returns false and sets *e on failure. */
bool vs_drawn_bounds(const vs_ref *ref, vs_drawn_search *search, vs_bounds *out, vs_error *e);
/* Computes the bounds of several drawn objects together. Visits the members of unions separately, so that members
 * without cuts need no mesh. Returns false and sets *e on failure. */
bool vs_drawn_bounds_all(const vs_ref *refs, size_t count, vs_drawn_search *search, vs_bounds *out, vs_error *e);

#endif
