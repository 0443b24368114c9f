/* Declares the replacement of a closed mesh's facets by curved triangles through its corners. */
#ifndef VS_GEOMETRY_SHAPES_SMOOTHING_H
#define VS_GEOMETRY_SHAPES_SMOOTHING_H

#include "geometry/nets/mesh_edges.h"

/* Adds to out, which must be empty, the mesh of s with each triangle curved, and divided until it follows the curve
 * within the tolerance. The corners stay. Edges that fold by more than `sharp` radians stay edges, as smooth curves
 * where two of them meet. Returns false when memory is out. */
bool vs_mesh_smooth(const vs_mesh_edges *s, double sharp, double tolerance, vs_mesh *out);

#endif
