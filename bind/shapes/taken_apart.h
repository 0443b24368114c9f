/* Declares functions by which natives divide objects into parts, with the fineness that the program has set. If they
 * fail, they set the interpreter's error. */
#ifndef VS_BIND_SHAPES_TAKEN_APART_H
#define VS_BIND_SHAPES_TAKEN_APART_H

#include "vm/machine/native.h"
#include "geometry/shapes/bending.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns the fineness (size of facets) for triangles or points that become part of an object n: the fineness that the
 * program has set, otherwise that of drawings for an object of this size. */
vs_fineness vs_bend_facets(vs_scheme *vm, const vs_node *n);
/* Replaces sections and shadows in the node of *ref by the curves and regions that they stand for (vs_resolve in
 * solids/resolve.h). *ref owns the node. If it fails, sets the error and returns false. */
bool vs_bend_resolve(vs_scheme *vm, vs_ref *ref);
/* Divides an object into leaves as vs_take_apart does (solids/deformed.h), after computing its sections and shadows. If
 * it fails, sets the error and returns false. */
bool vs_bend_take_apart(vs_scheme *vm, vs_ref object, const char *no_regions, vs_bend_leaves *out);
/* Removes overlaps from a mesh as vs_mesh_without_overlaps does (solids/overlaps.h). If it fails, sets the error and
 * returns false. */
bool vs_bend_solid(vs_scheme *vm, vs_mesh *m);
/* Sets *out to the triangles of a solid or surface, which become part of an object. If the program has set no
 * tolerance, uses a quarter of that of drawings. */
vs_status vs_bend_triangles(vs_scheme *vm, vs_ref ref, vs_mesh *out);

#endif
