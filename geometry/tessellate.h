/* Owns the triangles of nodes; the same facets for every back-end. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Solids and surfaces that are not operations (levels up to SWEPT; TRANSFORM, MATERIAL and LAYER chains are followed;
 * booleans are the kernel's): triangles in the node's own coordinates, appended to out. Solids come closed and
 * oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e);

#endif
