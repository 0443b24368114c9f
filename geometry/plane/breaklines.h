/* Declares the insertion of given edges (breaklines) into a triangulation. */
#ifndef VS_GEOMETRY_PLANE_BREAKLINES_H
#define VS_GEOMETRY_PLANE_BREAKLINES_H

#include "geometry/plane/areas.h"

typedef enum {
  VS_BREAKLINES_DONE,
  VS_BREAKLINES_CROSS, /* two of the given edges cross each other */
  VS_BREAKLINES_LOST,  /* a given edge is not a side of triangles at the end, because of rounding errors */
  VS_BREAKLINES_MEMORY
} vs_breaklines_outcome;

/* The counter-clockwise triangles of a Delaunay triangulation of points, all at different positions. The caller frees
 * `triangles`. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  uint32_t (*triangles)[3];
  size_t triangle_count, room;
} vs_breakline_mesh;

/* Makes each of the given edges a side of triangles. First adds triangles until they cover the convex hull of the
 * points; GEOS omits flat triangles at the border. Then flips sides. A point on an edge divides the edge. The other
 * sides become those of a constrained Delaunay triangulation (Sloan, 1993). *where: the crossing of two edges, or the
 * beginning of an edge that was not found. */
vs_breaklines_outcome vs_breaklines_insert(vs_breakline_mesh *t, const uint32_t (*edges)[2], size_t edge_count,
                                                 vs_vec2 *where);

#endif
