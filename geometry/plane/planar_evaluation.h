/* Declares planar evaluation: curves as points, regions as outlines, including the offsets and booleans of the
 * plane. */
#ifndef VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H
#define VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H

#include "geometry/plane/outline.h"
#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"

/* Samples a curve; its ends are exact. */
bool vs_curve_sample(const vs_node *curve, const vs_fineness *f, vs_polyline *out, vs_error *e);
/* Adds the corners of a curve or a region, for a hull that contains it (a vs_hull_leaf). Surfaces are an error here. */
bool vs_planar_corners(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e);
bool vs_outline_coplanar(const vs_outline *a, const vs_outline *b);
/* Makes the loops of a region, or of a closed curve taken as filled. There are none if the region is empty, as is the
 * intersection of disjoint regions. */
bool vs_region_outline(const vs_node *region, const vs_fineness *f, vs_outline *out, vs_error *e);

#endif
