/* Declares the triangulation of planar polygons with holes: caps, regions, polygonal faces. */
#ifndef VS_GEOMETRY_PLANE_EAR_CLIPPING_H
#define VS_GEOMETRY_PLANE_EAR_CLIPPING_H

#include "model/mesh.h"

typedef struct { double x, y; } vs_vec2;

/* Triangulates an outer loop, counter-clockwise, and its holes, clockwise; loop l has sizes[l] of the points `at`, in
 * order. Adds triangles over m's vertices index[i]; turned: clockwise ones. Every edge of the loops is used once in its
 * own direction and all others cancel, even if a loop crosses itself: a mesh closed with these caps is closed. Every
 * vertex is used, and no edge passes through a collinear one. Cost: n log n, and for each hole the edges at the height
 * of its leftmost corner. Returns false when memory is out. */
bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index,
                    bool turned);

#endif
