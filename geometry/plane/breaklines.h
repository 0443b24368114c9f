/* Declares the insertion of given edges into a triangulation (breaklines.c). */
#ifndef VS_GEOMETRY_PLANE_BREAKLINES_H
#define VS_GEOMETRY_PLANE_BREAKLINES_H

#include "geometry/plane/areas.h"

typedef enum {
  VS_BREAKLINES_DONE,
  VS_BREAKLINES_CROSS, /* two of the given edges cross */
  VS_BREAKLINES_LOST,  /* a given edge was not found, because of rounding errors */
  VS_BREAKLINES_MEMORY
} vs_breaklines_outcome;

/* The counter-clockwise triangles of a Delaunay triangulation of points. No two points are equal. The caller frees
 * triangles. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  uint32_t (*triangles)[3];
  size_t triangle_count, room;
} vs_breakline_mesh;

/* Adds triangles until they cover the convex hull of the points; GEOS omits flat triangles at the border. Then flips
 * sides of triangles until each given edge is a side. A point on an edge divides the edge. The other sides become those
 * of a constrained Delaunay triangulation (Sloan, 1993). *where: the crossing of two edges, or the beginning of the
 * edge that was not found. */
vs_breaklines_outcome vs_breaklines_insert(vs_breakline_mesh *t, const uint32_t (*edges)[2], size_t edge_count,
                                                 vs_vec2 *where);

#endif
