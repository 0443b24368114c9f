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

/* A point of the offset curve. first: true if a gap separates it from the point before it. */
typedef struct {
  vs_vec3 at;
  bool first;
} vs_offset_point;

/* The points of an offset curve, in the order of the original curve; {0} is an empty curve. The owner frees `at`. */
typedef struct {
  vs_offset_point *at;
  size_t count, room;
} vs_offset_points;

/* Computes the curve at the given distance from a curve on the mesh: on its left, or on its right if the distance is
 * negative. Calls `poll` once for each point. Returns false when `poll` interrupts or memory is out. The caller frees
 * out->at in either case. */
bool vs_mesh_offset_curve(const vs_mesh_edges *s, const vs_offset_row *from, double distance, vs_poller poll,
                          vs_offset_points *out);

#endif
