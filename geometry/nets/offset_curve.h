/* Declares curves at a distance from others over the triangles of a mesh. */
#ifndef VS_GEOMETRY_NETS_OFFSET_CURVE_H
#define VS_GEOMETRY_NETS_OFFSET_CURVE_H

#include "geometry/nets/mesh_edges.h"
#include "model/long_work.h"

/* A point of the curve, on the mesh or near it, and the curve's unit direction there. */
typedef struct {
  vs_vec3 at, tangent;
} vs_offset_from;

/* A curve as an array of its points, which the caller owns. */
typedef struct {
  const vs_offset_from *at;
  size_t count;
  bool closed; /* the last point is joined to the first, which is not repeated */
} vs_offset_row;

/* A point of the offset. `first`: a line begins here, which is not joined to the point before. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* The points of an offset, in the order of the curve; {0} is empty. The owner frees `at`. */
typedef struct {
  vs_offset_point *at;
  size_t count, room;
} vs_offset_points;

/* Walks the distance from each of the points, perpendicular to the curve and straight over the triangles. It walks to
 * the left, seen from the side to which the triangles' normals point; a negative distance: to the right. It omits walks
 * that reach a border of the mesh, and points beyond a border, and cuts off loops where the offset exceeds the curve's
 * radius. If the curve is closed and its offset complete, the first point is repeated as the last. It polls once for
 * each point. The caller frees out->at, also after a failure. Returns false when `poll` interrupts or memory is out. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out);

#endif
