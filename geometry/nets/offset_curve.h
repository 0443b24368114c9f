/* Declares offset curves on a mesh: curves at a given distance from another curve over the triangles. */
#ifndef VS_GEOMETRY_NETS_OFFSET_CURVE_H
#define VS_GEOMETRY_NETS_OFFSET_CURVE_H

#include "geometry/nets/mesh_edges.h"
#include "model/long_work.h"

/* A point of the curve, on the mesh or near it. tangent: unit vector of the curve's direction. */
typedef struct {
  vs_vec3 at, tangent;
} vs_offset_from;

/* The points of a curve. The array belongs to the caller. */
typedef struct {
  const vs_offset_from *at;
  size_t count;
  bool closed; /* true if the last point is joined to the first, which is not repeated */
} vs_offset_row;

/* A point of the offset curve. first: true if it is not joined to the point before it. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* The points of an offset curve, in the order of the original curve; {0} is empty. The owner frees `at`. */
typedef struct {
  vs_offset_point *at;
  size_t count, room;
} vs_offset_points;

/* Walks the distance from each point of the curve, perpendicular to the curve and straight over the triangles. The walk
 * goes to the left, as seen from the side to which the normals of the triangles point; to the right if the distance is
 * negative. Omits walks that reach a border of the mesh, and points beyond a border. Cuts off loops where the distance
 * exceeds the curve's radius. If the curve is closed and its offset has no gap, the first point is repeated at the end.
 * Calls `poll` once for each point. Returns false when `poll` interrupts or memory is out. The caller frees out->at in
 * either case. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out);

#endif
