/* Owns nodes of the simplest kinds, made of finished points and triangles. */
#ifndef VS_GEOMETRY_SHAPES_SIMPLE_NODES_H
#define VS_GEOMETRY_SHAPES_SIMPLE_NODES_H

#include "geometry/plane/outline.h"
#include "model/mesh.h"
#include "model/node.h"

/* A line through the points of a polyline, one new reference. NULL: out of memory. */
vs_node *vs_node_of_polyline(vs_store *store, const vs_polyline *p);
/* A region bounded by these loops, or the empty object where there are none. NULL: out of memory. */
vs_node *vs_node_of_outline(vs_store *store, const vs_outline *o, const vs_origin *origin);
/* Is the region one whose borders are lines already? */
bool vs_node_is_outline(const vs_node *n);
/* A polyface mesh of the triangles, or the empty object where there are none. closed: they bound a solid. NULL: out of
 * memory. */
vs_node *vs_node_of_mesh(vs_store *store, const vs_mesh *m, bool closed);

#endif
