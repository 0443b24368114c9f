/* Owns lowering: the replacement of nodes by simpler nodes, or by triangles. */
#ifndef VS_BACKENDS_LOWER_H
#define VS_BACKENDS_LOWER_H

#include "backends/backend.h"

/* Returns simpler kinds for ref's node, as one new reference; NULL: impossible or failed, and e's error says so. It
 * keeps no results: the driver does. */
vs_node *vs_lower(vs_emitter *e, const vs_ref *ref);
/* Returns true if n is a set of regions that is written as one region: all but unions of several planes, and of parts
 * with different paint. */
bool vs_lower_as_area(const vs_emitter *e, const vs_node *n);
/* Makes the triangles of a node. `out` is empty before; the caller frees it, also after a failure. */
bool vs_lower_mesh(vs_emitter *e, const vs_ref *ref, vs_solid *out);
/* Whether cuts through planar facets keep the bends that the kernel's grid gives them (kernel_options.h). AGAIN: with
 * bends, and without warnings, since the first attempt gave them. */
typedef enum { VS_BENT, VS_STRAIGHT, VS_BENT_AGAIN } vs_bends;
/* Makes the union of the solids among the references. */
bool vs_lower_solids(vs_emitter *e, const vs_ref *refs, size_t count, vs_bends bends, vs_solid *out);
/* Makes one mesh of all solids of the drawing, rounded: it merges corners that the format's numbers cannot distinguish,
 * and e warns, with the place, where that folds the mesh. The mesh has no bends, unless fewer triangles intersect with
 * them. */
bool vs_lower_drawing(vs_emitter *e, vs_solid *out);
/* The same, with equal parts once. */
bool vs_lower_drawing_copies(vs_emitter *e, vs_solid_copies *out);
/* Returns true if the node's shape is round somewhere: its triangles get smooth shading. */
bool vs_lower_is_round(const vs_node *n);

#endif
