/* Owns the measure of how much work the arrangement of a mesh with itself is. */
#ifndef VS_KERNEL_MESH_CROWD_H
#define VS_KERNEL_MESH_CROWD_H

#include "kernel/kernel_options.h"
#include "model/mesh.h"

/* How many pairs of its triangles may meet by their boxes; counting ends at `most`. False on error only. */
bool vs_mesh_pairs(const vs_mesh *m, size_t most, const vs_kernel_options *options, size_t *pairs,
                   vs_kernel_error *error);

#endif
