/* Owns curves at a distance from others over the triangles of a mesh. */
#ifndef VS_GEOMETRY_NETS_OFFSET_CURVE_H
#define VS_GEOMETRY_NETS_OFFSET_CURVE_H

#include "geometry/nets/mesh_edges.h"
#include "model/long_work.h"

/* A point of the curve, which lies on the mesh or near it, and the unit direction in which the curve goes on. */
typedef struct {
  vs_vec3 at, tangent;
} vs_offset_from;

/* A curve as a row of its points, the caller's. */
typedef struct {
  const vs_offset_from *at;
  size_t count;
  bool closed; /* the last point goes on to the first, which does not come again */
} vs_offset_row;

/* A point of the offset. `first`: a line begins here, which joins no earlier point. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* The points of an offset, in the order of the curve; {0} is empty. The owner frees `at`. */
typedef struct {
  vs_offset_point *at;
  size_t count, room;
} vs_offset_points;

/* Walks the distance from each of the points, at a right angle to the curve and straight on over the triangles: to the
 * left, seen from the side to which the triangles' normals point; a negative distance: to the right. A walk that
 * reaches a border of the mesh is left out, and so is a point that lies beyond one. Loops where the offset is wider
 * than the curve bends are cut off. Where the curve is closed and its offset whole, the first point comes again as the
 * last. The caller frees out->at, also after a failure; `poll` is asked once a point. False: it stopped the work, or
 * memory is out. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out);

#endif
