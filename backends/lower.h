/* Owns lowering: nodes as simpler ones, or as triangles. */
#ifndef VS_BACKENDS_LOWER_H
#define VS_BACKENDS_LOWER_H

#include "backends/backend.h"

/* Simpler kinds for ref's node, one new reference; NULL: cannot be or failed, and the error says so. Not memoised: the
 * driver does that. */
vs_node *vs_lower(vs_emitter *e, const vs_ref *ref);
/* Is this a set of regions that is to be written as one region? All but unions of several planes, or of parts painted
 * apart. */
bool vs_lower_as_area(const vs_emitter *e, const vs_node *n);
/* Triangles of a node, as vs_emit_mesh but made anew; out is empty before, and the caller's to free also after a
 * failure. */
bool vs_lower_mesh(vs_emitter *e, const vs_ref *ref, vs_solid *out);
/* Whether cuts through planar facets keep the bends that the kernel's grid gives them (kernel_options.h); AGAIN: with
 * them and without warnings, since those were said before. */
typedef enum { VS_BENT, VS_STRAIGHT, VS_BENT_AGAIN } vs_bends;
/* The union of the solids among these. */
bool vs_lower_solids(vs_emitter *e, const vs_ref *refs, size_t count, vs_bends bends, vs_solid *out);
/* All solids of the drawing as one mesh, settled: corners that the format's numbers cannot hold apart become one, and
 * the writer says where that folds the mesh. Without bends, unless less triangles meet with them. */
bool vs_lower_drawing(vs_emitter *e, vs_solid *out);
/* The same with equal parts once. */
bool vs_lower_drawing_copies(vs_emitter *e, vs_solid_copies *out);
/* Is this node's shape round somewhere, so that its triangles should be shaded smoothly? */
bool vs_lower_is_round(const vs_node *n);

#endif
