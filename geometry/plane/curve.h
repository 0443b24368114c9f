/* Declares paths, for use in geometry/ alone: curves as sampled points, with the directions in which the curve arrives
 * and leaves. */
#ifndef VS_GEOMETRY_PLANE_CURVE_H
#define VS_GEOMETRY_PLANE_CURVE_H

#include "geometry/frame.h"
#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"

typedef struct {
  vs_path_point *at; /* sampled points of the curve in order; on a closed curve the first sample is not repeated at the
                      * end */
  size_t count, room;
  bool closed;
  double length; /* length of the polyline through the samples, including the segment that closes it */
} vs_path;

void vs_path_free(vs_path *p);
bool vs_path_add(vs_path *p, vs_vec3 at, vs_vec3 arriving, vs_vec3 leaving); /* adds a sample: the point `at` and the
                                                                              * directions before and after it; returns
                                                                              * false when memory is out */
void vs_path_measure(vs_path *p); /* sets the member `along` of each sample, and the path's length */
/* Samples a line, arc, circle or spline, and appends the samples, mapped by `map`, to out. Returns false when memory is
 * out. */
bool vs_curve_leaf(const vs_node *curve, const vs_affine *map, const vs_fineness *f, vs_path *out);
/* Enlarges b by the exact bounds of the spline s, mapped by `map`. Returns false when memory is out. */
bool vs_spline_bounds(const struct vs_spline *s, const vs_affine *map, vs_bounds *b);
/* Samples the arc a, or its whole circle if `circle` is true, mapped by `map`. Returns false when memory is out. */
bool vs_curve_round(const struct vs_arc *a, bool circle, const vs_affine *map, const vs_fineness *f, vs_path *out);
bool vs_path_of_polyline(const vs_polyline *p, vs_path *out); /* makes a path of a polyline; out must be empty; returns
                                                               * false when memory is out */
/* Samples a curve of any kind, or the border of a region of one loop, and maps the samples by `placed`. Returns false
 * and sets e on failure. */
bool vs_curve_path(const vs_node *curve, const vs_affine *placed, const vs_fineness *f, vs_path *out, vs_error *e);
bool vs_curve_is_straight(const vs_node *curve); /* returns true if the curve is a polyline, possibly placed */
bool vs_polyline_from_path(const vs_path *path, vs_polyline *out);
/* Reverses the order of the samples of p, and their directions. */
void vs_path_reverse(vs_path *p);

#endif
