/* Declares offset curves on a mesh: curves at a given distance from another curve over the triangles. */
#ifndef VS_GEOMETRY_NETS_OFFSET_CURVE_H
#define VS_GEOMETRY_NETS_OFFSET_CURVE_H

#include "geometry/nets/mesh_edges.h"
#include "model/long_work.h"

/* A point of the original curve, on the mesh or near it. tangent: unit vector of the curve's direction there. */
typedef struct {
  vs_vec3 at, tangent;
} vs_offset_from;

/* The points of the original curve. The array belongs to the caller. */
typedef struct {
  const vs_offset_from *at;
  size_t count;
  bool closed; /* true if the last point is joined to the first point, which is not repeated */
} vs_offset_row;

/* A point of the offset curve. first: true if it is not joined to the point before it. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* The points of an offset curve, in the order of the original curve; {0} is an empty curve. The owner frees `at`. */
typedef struct {
  vs_offset_point *at;
  size_t count, room;
} vs_offset_points;

/* From each point of a curve, walks the distance perpendicular to the curve, straight over the triangles. The ends are
 * the offset curve. It walks to the left, as seen from the side to which the triangles face, or to the right if the
 * distance is negative. Omits walks that reach a border of the mesh, and points beyond a border. Cuts off loops where
 * the distance exceeds the curve's radius. If the curve is closed and its offset has no gap, the first point is
 * repeated at the end. Calls `poll` once for each point. Returns false when `poll` interrupts or memory is out. The
 * caller frees out->at in either case. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out);

#endif
