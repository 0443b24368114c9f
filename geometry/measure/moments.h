/* Owns areas and centroids of regions by formula. */
#ifndef VS_GEOMETRY_MEASURE_MOMENTS_H
#define VS_GEOMETRY_MEASURE_MOMENTS_H

#include "geometry/plane/outline.h"

/* Of a region, or a closed curve taken as filled, bounded by polylines, circles, arcs and joins of them: exact.
 * outline: the same region, sampled; it says which loops are holes. *known false: some curve is of another kind. False:
 * failed. */
bool vs_region_moments(const vs_node *region, const vs_outline *outline, double *area, vs_vec3 *centroid, bool *known,
                       vs_error *e);

#endif
