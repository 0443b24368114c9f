/* Owns the way in which natives take objects apart: at the program's own fineness, with its conditions. */
#ifndef VS_BIND_SHAPES_TAKEN_APART_H
#define VS_BIND_SHAPES_TAKEN_APART_H

#include "vm/machine/native.h"
#include "geometry/shapes/bending.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* The fineness at which what is kept as triangles or points is sampled: the program's own, else the drawing rule at
 * the object's size. */
vs_fineness vs_bend_facets(vs_scheme *vm, const vs_node *n);
/* Replaces ref's node, which the caller owns, as vs_resolve does (solids/resolve.h). False: the condition is set. */
bool vs_bend_resolve(vs_scheme *vm, vs_ref *ref);
/* As vs_take_apart (solids/deformed.h), of an object that need not be resolved. False: the condition is set. */
bool vs_bend_take_apart(vs_scheme *vm, vs_ref object, const char *no_regions, vs_bend_leaves *out);
/* As vs_mesh_without_overlaps (solids/overlaps.h). False: the condition is set. */
bool vs_bend_solid(vs_scheme *vm, vs_mesh *m);
/* The triangles of a solid or surface: of what is round a quarter as coarse as in drawings, since they are kept. */
vs_status vs_bend_triangles(vs_scheme *vm, vs_ref ref, vs_mesh *out);

#endif
