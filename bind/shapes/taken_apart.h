/* Declares functions by which natives divide objects into parts, with the fineness that the program has set. If they
 * fail, they set the interpreter's condition. */
#ifndef VS_BIND_SHAPES_TAKEN_APART_H
#define VS_BIND_SHAPES_TAKEN_APART_H

#include "vm/machine/native.h"
#include "geometry/shapes/bending.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns the fineness for triangles or points that become part of an object: the program's own, or that of drawings
 * for an object of this size. */
vs_fineness vs_bend_facets(vs_scheme *vm, const vs_node *n);
/* Replaces *ref's node, which the caller owns, as vs_resolve does (solids/resolve.h). If it fails, sets the condition
 * and returns false. */
bool vs_bend_resolve(vs_scheme *vm, vs_ref *ref);
/* Divides an object into leaves as vs_take_apart does (solids/deformed.h); resolves it first. If it fails, sets the
 * condition and returns false. */
bool vs_bend_take_apart(vs_scheme *vm, vs_ref object, const char *no_regions, vs_bend_leaves *out);
/* Removes overlaps from a mesh as vs_mesh_without_overlaps does (solids/overlaps.h). If it fails, sets the condition
 * and returns false. */
bool vs_bend_solid(vs_scheme *vm, vs_mesh *m);
/* Computes the triangles of a solid or surface. If the program has set no tolerance, uses a quarter of that of
 * drawings, since the triangles become part of an object. */
vs_status vs_bend_triangles(vs_scheme *vm, vs_ref ref, vs_mesh *out);

#endif
