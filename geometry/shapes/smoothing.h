/* Declares the smoothing of a closed mesh: curved triangles through its corners replace its flat facets. */
#ifndef VS_GEOMETRY_SHAPES_SMOOTHING_H
#define VS_GEOMETRY_SHAPES_SMOOTHING_H

#include "geometry/nets/mesh_edges.h"

/* Writes a smooth copy of the mesh of s to out, which must be empty. Each triangle is curved, and divided until it
 * follows its curve within the tolerance. Edges with a fold of more than `sharp` radians stay edges. Returns false when
 * memory is out. */
bool vs_mesh_smooth(const vs_mesh_edges *s, double sharp, double tolerance, vs_mesh *out);

#endif
