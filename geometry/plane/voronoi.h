/* Declares Voronoi cells: the points that are nearer to a given point than to any other. */
#ifndef VS_GEOMETRY_PLANE_VORONOI_H
#define VS_GEOMETRY_PLANE_VORONOI_H

#include "geometry/plane/areas.h"

/* Cuts the box into the convex cells of n points: cell i has the corners at[start[i]] ... at[start[i + 1] - 1],
 * counter-clockwise. A point at the position of an earlier one has an empty cell. */
typedef struct {
  vs_vec2 *at;
  size_t *start, count, room;
} vs_voronoi;

bool vs_voronoi_make(const vs_vec2 *points, size_t n, const vs_vec2 box[2], vs_voronoi *out, vs_error *e);
void vs_voronoi_free(vs_voronoi *v);

#endif
