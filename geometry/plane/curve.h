/* Declares, for use in geometry/ alone, curves as paths: sampled points with the directions in which the curve arrives and
 * leaves. */
#ifndef VS_GEOMETRY_PLANE_CURVE_H
#define VS_GEOMETRY_PLANE_CURVE_H

#include "geometry/frame.h"
#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"

typedef struct {
  vs_path_point *at; /* closed: the first is not repeated */
  size_t count, room;
  bool closed;
  double length; /* of the samples, including the closing segment */
} vs_path;

void vs_path_free(vs_path *p);
bool vs_path_add(vs_path *p, vs_vec3 at, vs_vec3 arriving, vs_vec3 leaving); /* false: out of memory */
void vs_path_measure(vs_path *p); /* sets along and length */
/* Samples a line, arc, circle or spline under map; returns false when memory is out. */
bool vs_curve_leaf(const vs_node *curve, const vs_affine *map, const vs_fineness *f, vs_path *out);
/* Does the same for an arc, or for its whole circle. */
bool vs_curve_round(const struct vs_arc *a, bool circle, const vs_affine *map, const vs_fineness *f, vs_path *out);
bool vs_path_of_polyline(const vs_polyline *p, vs_path *out); /* out is empty before; false: out of memory */
/* Samples any curve under `placed`; follows placements, appearance and regions of one loop (planar_evaluation.c). */
bool vs_curve_path(const vs_node *curve, const vs_affine *placed, const vs_fineness *f, vs_path *out, vs_error *e);
bool vs_curve_is_straight(const vs_node *curve); /* returns true for a polyline, also a placed one */
bool vs_polyline_from_path(const vs_path *path, vs_polyline *out);
/* reverses p */
void vs_path_reverse(vs_path *p);

#endif
