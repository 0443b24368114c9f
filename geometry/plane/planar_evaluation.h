/* Declares planar evaluation: curves as points, regions as outlines, including the offsets and booleans of the
 * plane. */
#ifndef VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H
#define VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H

#include "geometry/plane/outline.h"
#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"

/* Samples a curve to the polyline out. The curve's ends are exact. Returns false and sets e on failure. */
bool vs_curve_sample(const vs_node *curve, const vs_fineness *f, vs_polyline *out, vs_error *e);
/* Appends the corners of a curve or region, mapped by `placed`, to out, the points of a hull. Returns false and sets e
 * on failure, and for a surface. */
bool vs_planar_corners(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e);
bool vs_outline_coplanar(const vs_outline *a, const vs_outline *b);
/* Makes the outline of a region, or of the inside of a closed curve. It has no loops if the region is empty, such as an
 * intersection of disjoint regions. Returns false and sets e on failure. */
bool vs_region_outline(const vs_node *region, const vs_fineness *f, vs_outline *out, vs_error *e);

#endif
