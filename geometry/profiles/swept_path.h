/* Declares the stations of a sweep, for geometry/ alone: the points of its path at which it has sections. */
#ifndef VS_GEOMETRY_PROFILES_SWEPT_PATH_H
#define VS_GEOMETRY_PROFILES_SWEPT_PATH_H

#include "geometry/plane/curve.h"
#include "geometry/tolerance.h"

/* Samples the curve as the path of a profile whose points are at most `reach` away from it. Returns false and sets e if
 * `curve` is not a single curve. The caller frees path (vs_path_free). */
bool vs_swept_path(const vs_node *curve, const vs_fineness *f, double reach, vs_path *path, vs_error *e);

#endif
