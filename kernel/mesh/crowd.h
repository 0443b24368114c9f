/* Declares the functions for the measure of the work that the arrangement of a mesh with itself takes. */
#ifndef VS_KERNEL_MESH_CROWD_H
#define VS_KERNEL_MESH_CROWD_H

#include "kernel/kernel_options.h"
#include "model/mesh.h"

/* Counts the pairs of its triangles whose boxes meet, up to `most`. Returns false only on an error. */
bool vs_mesh_pairs(const vs_mesh *m, size_t most, const vs_kernel_options *options, size_t *pairs,
                   vs_kernel_error *error);

#endif
