/* Declares functions that make nodes of the simplest kinds from computed points and triangles. */
#ifndef VS_GEOMETRY_SHAPES_SIMPLE_NODES_H
#define VS_GEOMETRY_SHAPES_SIMPLE_NODES_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns a new line node through the points of a polyline. Returns NULL when memory is out. */
vs_node *vs_node_of_polyline(vs_store *store, const vs_polyline *p);
/* Returns a new region node whose borders are the loops of o. If o has no loops, returns the empty object. Returns NULL
 * when memory is out. */
vs_node *vs_node_of_outline(vs_store *store, const vs_outline *o, const vs_origin *origin);
/* Returns true if n is a region whose borders are already lines. */
bool vs_node_is_outline(const vs_node *n);
/* Returns a new polyface mesh with the triangles of m. If m has no triangles, returns the empty object. closed: true if
 * the triangles bound a solid. Returns NULL when memory is out. */
vs_node *vs_node_of_mesh(vs_store *store, const vs_mesh *m, bool closed);

#endif
