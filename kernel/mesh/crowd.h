/* Declares a function that counts pairs of intersecting boxes of a mesh's triangles. The count estimates the time to
 * intersect the mesh with itself. */
#ifndef VS_KERNEL_MESH_CROWD_H
#define VS_KERNEL_MESH_CROWD_H

#include "kernel/kernel_options.h"
#include "model/mesh.h"

/* Counts the pairs of the mesh's triangles whose bounding boxes intersect. Stops when *pairs reaches `most`. Returns
 * false and sets the error on failure. */
bool vs_mesh_pairs(const vs_mesh *m, size_t most, const vs_kernel_options *options, size_t *pairs,
                   vs_kernel_error *error);

#endif
