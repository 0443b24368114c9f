/* Declares the insertion of given edges (breaklines) into a triangulation. */
#ifndef VS_GEOMETRY_PLANE_BREAKLINES_H
#define VS_GEOMETRY_PLANE_BREAKLINES_H

#include "geometry/plane/areas.h"

typedef enum {
  VS_BREAKLINES_DONE,
  VS_BREAKLINES_CROSS, /* two of the given edges cross each other */
  VS_BREAKLINES_LOST,  /* rounding errors prevent that a given edge becomes a side of triangles */
  VS_BREAKLINES_MEMORY
} vs_breaklines_outcome;

/* The triangles of a Delaunay triangulation, counter-clockwise. All its points have different positions. The caller
 * frees `triangles`. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  uint32_t (*triangles)[3];
  size_t triangle_count, room;
} vs_breakline_mesh;

/* Turns the triangulation into a constrained Delaunay triangulation (Sloan, 1993) that has each given edge as a side of
 * triangles and covers the convex hull of the points. *where: crossing of two given edges, or beginning of an edge that
 * could not be inserted. */
vs_breaklines_outcome vs_breaklines_insert(vs_breakline_mesh *t, const uint32_t (*edges)[2], size_t edge_count,
                                                 vs_vec2 *where);

#endif
