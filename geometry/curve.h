/* Owns, for geometry/ alone, curves as paths: sampled points that know the directions in which the curve arrives and leaves. */
#ifndef VS_GEOMETRY_CURVE_H
#define VS_GEOMETRY_CURVE_H

#include "geometry/frame.h"
#include "geometry/tessellate.h"

typedef struct {
  vs_path_point *at; /* closed: the first is not repeated */
  size_t count, room;
  bool closed;
  double length; /* of the samples, the closing stretch too */
} vs_path;

void vs_path_free(vs_path *p);
bool vs_path_add(vs_path *p, vs_vec3 at, vs_vec3 arriving, vs_vec3 leaving); /* false: out of memory */
void vs_path_measure(vs_path *p); /* fills along and length */
/* The curve, with `placed` applied; placements, appearance and one-curve regions are followed. */
bool vs_curve_path(const vs_node *curve, const vs_affine *placed, const vs_facets *f, vs_path *out, vs_error *e);
/* Joins open paths that meet end to end into closed ones, in place; *count becomes the number left. */
bool vs_path_join(vs_path *paths, size_t *count, vs_error *e);
bool vs_polyline_from_path(const vs_path *path, vs_polyline *out);
/* p turned to run the other way */
void vs_path_reverse(vs_path *p);

#endif
