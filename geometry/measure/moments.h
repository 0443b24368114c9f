/* Declares areas and centroids of regions by formula. */
#ifndef VS_GEOMETRY_MEASURE_MOMENTS_H
#define VS_GEOMETRY_MEASURE_MOMENTS_H

#include "geometry/plane/outline.h"

/* Computes the exact area and centroid of a region, or of a closed curve taken as filled. Its borders are polylines,
 * circles, arcs and joins of them. outline: the same region, sampled; it determines which loops are holes. *known
 * false: some curve is of another kind. Returns false on failure. */
bool vs_region_moments(const vs_node *region, const vs_outline *outline, double *area, vs_vec3 *centroid, bool *known,
                       vs_error *e);

#endif
