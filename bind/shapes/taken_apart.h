/* Owns the interface of taken_apart.c: natives take objects apart at the program's own fineness; failures set its
 * condition. */
#ifndef VS_BIND_SHAPES_TAKEN_APART_H
#define VS_BIND_SHAPES_TAKEN_APART_H

#include "vm/machine/native.h"
#include "geometry/shapes/bending.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns the fineness for triangles or points that are kept: the program's own, otherwise the drawing's rule at the
 * object's size. */
vs_fineness vs_bend_facets(vs_scheme *vm, const vs_node *n);
/* Replaces ref's node, which the caller owns, like vs_resolve (solids/resolve.h). Returns false with the condition
 * set. */
bool vs_bend_resolve(vs_scheme *vm, vs_ref *ref);
/* As vs_take_apart (solids/deformed.h), also for an unresolved object. Returns false with the condition set. */
bool vs_bend_take_apart(vs_scheme *vm, vs_ref object, const char *no_regions, vs_bend_leaves *out);
/* As vs_mesh_without_overlaps (solids/overlaps.h). Returns false with the condition set. */
bool vs_bend_solid(vs_scheme *vm, vs_mesh *m);
/* Returns the triangles of a solid or surface. Without a tolerance of the program's, they get a quarter of the
 * drawing's, since they are kept. */
vs_status vs_bend_triangles(vs_scheme *vm, vs_ref ref, vs_mesh *out);

#endif
