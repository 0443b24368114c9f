/* Declares nodes of the simplest kinds, made from computed points and triangles. */
#ifndef VS_GEOMETRY_SHAPES_SIMPLE_NODES_H
#define VS_GEOMETRY_SHAPES_SIMPLE_NODES_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns a line through the points of a polyline, a new reference. NULL: out of memory. */
vs_node *vs_node_of_polyline(vs_store *store, const vs_polyline *p);
/* Returns a region bounded by these loops; without loops the empty object. NULL: out of memory. */
vs_node *vs_node_of_outline(vs_store *store, const vs_outline *o, const vs_origin *origin);
/* Returns true if the region's borders are lines already. */
bool vs_node_is_outline(const vs_node *n);
/* Returns a polyface mesh of the triangles; without triangles the empty object. closed: they bound a solid. NULL: out
 * of memory. */
vs_node *vs_node_of_mesh(vs_store *store, const vs_mesh *m, bool closed);

#endif
