/* Declares convex hulls, for use in geometry/ alone: of points in space, of points in a plane, and of a node's
 * parts. */
#ifndef VS_GEOMETRY_SHAPES_HULL_H
#define VS_GEOMETRY_SHAPES_HULL_H

#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"

typedef struct { vs_vec3 *at; size_t count, room; } vs_cloud;
void vs_cloud_free(vs_cloud *c);
bool vs_cloud_add(vs_cloud *c, vs_vec3 p); /* adds the point p to the cloud; returns false when memory is out */

/* Returns the dimension of the points: 0 for one point, 1 for a line, 2 for a plane, 3 for space; -1: there are no
 * points. Deviations up to a billionth of the extent are ignored. */
int vs_cloud_dimension(const vs_cloud *c);
/* Appends the triangles of the convex hull of the cloud to out. Appends none if the points lie in one plane. Returns
 * false when memory is out. */
bool vs_cloud_hull(const vs_cloud *c, vs_mesh *out);
/* Computes the convex hull of points in one plane, as a polygon that is counter-clockwise about one of the plane's
 * normals. For points on a line, it has only the two end points. out must be empty. */
bool vs_cloud_polygon(const vs_cloud *c, vs_polyline *out);

bool vs_cloud_add_all(vs_cloud *out, const vs_affine *placed, const vs_vec3 *at, size_t count, vs_error *e);

/* Adds the corners of node n, mapped by `placed`, to out. n is neither a placement nor a union. f: fineness in the
 * coordinates of n. Returns false and sets the error on failure. */
typedef bool vs_hull_leaf(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e);
/* Adds points to out whose convex hull is the node `hull`, in its own coordinates. Calls `leaf` for each part of the
 * node. Returns false and sets e on failure. */
bool vs_hull_cloud(const vs_node *hull, vs_hull_leaf *leaf, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
