/* Declares the functions of breaklines.c: edges that a triangulation must have. */
#ifndef VS_GEOMETRY_PLANE_BREAKLINES_H
#define VS_GEOMETRY_PLANE_BREAKLINES_H

#include "geometry/plane/areas.h"

typedef enum {
  VS_BREAKLINES_DONE,
  VS_BREAKLINES_CROSS, /* two of the edges cross */
  VS_BREAKLINES_LOST,  /* rounding: an edge does not pass through the triangles */
  VS_BREAKLINES_MEMORY
} vs_breaklines_outcome;

/* The triangles of a Delaunay triangulation, counter-clockwise. No two points are equal. The caller frees triangles. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  uint32_t (*triangles)[3];
  size_t triangle_count, room;
} vs_breakline_mesh;

/* Adds triangles until they cover the hull of the points, which GEOS does not at flat corners of the border. Then flips
 * edges until each given edge is one; a point on an edge divides it. The others become those of a constrained Delaunay
 * triangulation (Sloan, 1993). *where: the crossing, or the beginning of the lost edge. */
vs_breaklines_outcome vs_breaklines_insert(vs_breakline_mesh *t, const uint32_t (*edges)[2], size_t edge_count,
                                                 vs_vec2 *where);

#endif
