/* Owns, for geometry/ alone, convex hulls: of points in space and in a plane, and of the parts of a hull node. */
#ifndef VS_GEOMETRY_SHAPES_HULL_H
#define VS_GEOMETRY_SHAPES_HULL_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"

typedef struct { vs_vec3 *at; size_t count, room; } vs_cloud;
void vs_cloud_free(vs_cloud *c);
bool vs_cloud_add(vs_cloud *c, vs_vec3 p); /* false: out of memory */

/* Returns the dimension of the points: 0 one point, 1 a line, 2 a plane, 3 space, within a billionth of their extent;
 * -1: there are no points. */
int vs_cloud_dimension(const vs_cloud *c);
/* Appends the hull's triangles; none if the points are in one plane. Returns false when memory is out. */
bool vs_cloud_hull(const vs_cloud *c, vs_mesh *out);
/* Makes the hull of points in one plane, counter-clockwise about some normal; of points on a line its two ends. out is
 * empty before. */
bool vs_cloud_polygon(const vs_cloud *c, vs_polyline *out);

bool vs_cloud_add_all(vs_cloud *out, const vs_affine *placed, const vs_vec3 *at, size_t count, vs_error *e);

/* Adds the corners of a node that is no placement and no union, with the fineness f in its own coordinates. */
typedef bool vs_hull_leaf(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e);
/* Adds the points whose hull is the node's hull, in its own coordinates: `leaf` adds those of each part. */
bool vs_hull_cloud(const vs_node *hull, vs_hull_leaf *leaf, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
