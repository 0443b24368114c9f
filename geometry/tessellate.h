/* Owns the triangles of nodes; the same facets for every back-end. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Solids and surfaces that are not operations (levels up to SWEPT; TRANSFORM, MATERIAL and LAYER chains are followed;
 * booleans are the kernel's): triangles in the node's own coordinates, appended to out. Solids come closed and
 * oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
/* The points whose hull the node's is, in its own coordinates: corners of what it holds, as finely as f asks. Sets of
 * solids other than unions are the kernel's to mesh (solids/resolve.h): they are an error here. */
bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
