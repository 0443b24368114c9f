/* Owns curves at a distance from others over the triangles of a mesh. */
#ifndef VS_GEOMETRY_NETS_OFFSET_CURVE_H
#define VS_GEOMETRY_NETS_OFFSET_CURVE_H

#include "geometry/nets/mesh_edges.h"

/* A point of the curve, which lies on the mesh or near it, and the unit direction in which the curve goes on. */
typedef struct {
  vs_vec3 at, tangent;
} vs_offset_from;

/* A point of the offset. `first`: a line begins here, which joins no earlier point. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* Walks the distance from each of the points, at a right angle to the curve and straight on over the triangles: to the
 * left, seen from the side to which the triangles' normals point; a negative distance: to the right. A walk that
 * reaches a border of the mesh is left out, and so is a point that lies beyond one. Loops where the offset is wider
 * than the curve bends are cut off. The points come in the order of the curve; where the curve is closed and its offset
 * whole, the first one comes again as the last. The caller frees *out; `poll` is asked once a point, and false stops
 * the work. False: it did, or memory is out. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_from *from, size_t count, bool closed,
                          double distance, bool (*poll)(void *context), void *context, vs_offset_point **out,
                          size_t *out_count);

#endif
