/* Declares lowering: the replacement of nodes by simpler nodes or by triangles. */
#ifndef VS_BACKENDS_LOWER_H
#define VS_BACKENDS_LOWER_H

#include "backends/backend.h"

/* Returns a node of simpler kinds that replaces ref's node, as a new reference. Returns NULL if no simpler kinds can
 * replace it, or on failure; e's error has the reason. The driver, not this function, stores the result for other
 * places of the node. */
vs_node *vs_lower(vs_emitter *e, const vs_ref *ref);
/* Returns true if n is an operation on regions that the format writes as a single region. Returns false for unions of
 * regions in several planes, and for unions of parts with different paint. */
bool vs_lower_as_area(const vs_emitter *e, const vs_node *n);
/* Computes the triangles of a node. `out` must be empty before; the caller frees it, even after a failure. */
bool vs_lower_mesh(vs_emitter *e, const vs_ref *ref, vs_solid *out);
/* Whether the edges of cut faces keep the small bends that rounding to the kernel's grid causes (kernel_options.h).
 * VS_BENT_AGAIN: keeps the bends, but gives no warnings, since the first attempt gave them. */
typedef enum { VS_BENT, VS_STRAIGHT, VS_BENT_AGAIN } vs_bends;
/* Computes the union of the solids among the `count` references. Returns false, with e's error set, on failure. */
bool vs_lower_solids(vs_emitter *e, const vs_ref *refs, size_t count, vs_bends bends, vs_solid *out);
/* Computes the union of the solids as vs_lower_solids does, but keeps the faces of different objects separate
 * (vs_solid_of_objects). */
bool vs_lower_objects(vs_emitter *e, const vs_refs *refs, int depth, vs_bends bends, vs_solid *out);
/* Computes a single mesh of all solids of the drawing. Vertices that the format's numbers cannot distinguish are
 * merged; if this folds the mesh, warns with the place. Cut edges have no bends (vs_bends), unless fewer triangles
 * intersect with bends. */
bool vs_lower_drawing(vs_emitter *e, vs_solid *out);
/* Computes the meshes of all solids of the drawing as vs_lower_drawing does, but each group of equal parts only
 * once. */
bool vs_lower_drawing_copies(vs_emitter *e, vs_solid_copies *out);
/* Returns true if some face of the node's shape is curved, so that its triangles need smooth shading. */
bool vs_lower_is_round(const vs_node *n);

#endif
