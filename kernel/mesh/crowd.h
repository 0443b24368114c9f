/* Declares an estimate of the work that the arrangement of a mesh with itself needs. */
#ifndef VS_KERNEL_MESH_CROWD_H
#define VS_KERNEL_MESH_CROWD_H

#include "kernel/kernel_options.h"
#include "model/mesh.h"

/* Counts the pairs of the mesh's triangles whose boxes intersect, and stops at `most`. Returns false and sets the error
 * on failure. */
bool vs_mesh_pairs(const vs_mesh *m, size_t most, const vs_kernel_options *options, size_t *pairs,
                   vs_kernel_error *error);

#endif
