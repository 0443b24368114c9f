/* Owns planar evaluation: curves as points, regions as outlines, with the offsets and booleans of the plane in them
 * worked out. */
#ifndef VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H
#define VS_GEOMETRY_PLANE_PLANAR_EVALUATION_H

#include "geometry/plane/outline.h"
#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"

/* A curve as points, with exact ends. */
bool vs_curve_sample(const vs_node *curve, const vs_fineness *f, vs_polyline *out, vs_error *e);
/* The corners of a curve or a region, for a hull that holds it (a vs_hull_leaf). Surfaces are an error here. */
bool vs_planar_corners(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e);
bool vs_outline_coplanar(const vs_outline *a, const vs_outline *b);
/* The loops of a region, or of a closed curve taken as filled. None where the region turns out to be empty: an
 * intersection of what does not meet. */
bool vs_region_outline(const vs_node *region, const vs_fineness *f, vs_outline *out, vs_error *e);

#endif
