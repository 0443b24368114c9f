/* Declares the triangulation of planar polygons with holes, for caps, regions and polygonal faces. */
#ifndef VS_GEOMETRY_PLANE_EAR_CLIPPING_H
#define VS_GEOMETRY_PLANE_EAR_CLIPPING_H

#include "model/mesh.h"

typedef struct { double x, y; } vs_vec2;

/* Triangulates an outer loop, counter-clockwise, and its holes, clockwise; appends the triangles to m, clockwise if
 * `turned`. Loop l has sizes[l] of the points `at`, in order; index[i] is the vertex of point i. A mesh closed with
 * such caps is closed, even if a loop crosses itself. Returns false when memory is out. */
bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index,
                    bool turned);

#endif
