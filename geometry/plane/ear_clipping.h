/* Owns the cutting of planar polygons with holes into triangles: caps, regions, polygonal faces. */
#ifndef VS_GEOMETRY_PLANE_EAR_CLIPPING_H
#define VS_GEOMETRY_PLANE_EAR_CLIPPING_H

#include "model/mesh.h"

typedef struct { double x, y; } vs_vec2;

/* An outer loop, counter-clockwise, and its holes, clockwise; loop l has sizes[l] of the points `at`, in order. Adds
 * triangles over m's vertices index[i]; turned: clockwise ones. Every edge of the loops is used once in its own
 * direction and all others cancel, even where a loop crosses itself: a mesh closed with these caps is closed. No vertex
 * is skipped, collinear ones are not cut through. Cost: n log n, and for each hole the edges at the height of its
 * leftmost corner. False: out of memory. */
bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index,
                    bool turned);

#endif
