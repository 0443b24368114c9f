/* Declares Voronoi cells. The cell of a point contains all places that are nearer to this point than to any other
 * point. */
#ifndef VS_GEOMETRY_PLANE_VORONOI_H
#define VS_GEOMETRY_PLANE_VORONOI_H

#include "geometry/plane/areas.h"

/* The cells of n points within a box. Cell i is convex and has the corners at[start[i]] to at[start[i + 1] - 1],
 * counter-clockwise. A point at the position of an earlier one has an empty cell. */
typedef struct {
  vs_vec2 *at;
  size_t *start, count, room;
} vs_voronoi;

bool vs_voronoi_make(const vs_vec2 *points, size_t n, const vs_vec2 box[2], vs_voronoi *out, vs_error *e);
void vs_voronoi_free(vs_voronoi *v);

#endif
