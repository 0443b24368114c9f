/* Declares areas and centroids of regions by exact formulas. */
#ifndef VS_GEOMETRY_MEASURE_MOMENTS_H
#define VS_GEOMETRY_MEASURE_MOMENTS_H

#include "geometry/plane/outline.h"

/* Computes the exact area and centroid of a region or closed curve. Sets *known to false if its borders are not
 * polylines, circles, arcs or joins of these. outline: the sampled outline, which shows which loops are holes. Returns
 * false on failure. */
bool vs_region_moments(const vs_node *region, const vs_outline *outline, double *area, vs_vec3 *centroid, bool *known,
                       vs_error *e);

#endif
