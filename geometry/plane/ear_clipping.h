/* Declares the triangulation of planar polygons with holes, for caps, regions and polygonal faces. */
#ifndef VS_GEOMETRY_PLANE_EAR_CLIPPING_H
#define VS_GEOMETRY_PLANE_EAR_CLIPPING_H

#include "model/mesh.h"

typedef struct { double x, y; } vs_vec2;

/* Triangulates an outer loop, counter-clockwise, and its holes, clockwise. Loop l has sizes[l] of the points `at`, in
 * order. Appends triangles of the vertices index[i] of the mesh m, clockwise if `turned`. Every edge of the loops is
 * used once in its own direction, and all other edges cancel, even if a loop crosses itself. Thus a mesh that is closed
 * with such caps is closed. Every vertex is used, and no edge passes through a collinear vertex. The time is n log n,
 * plus the number of edges at the height of each hole's leftmost corner. Returns false when memory is out. */
bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index,
                    bool turned);

#endif
