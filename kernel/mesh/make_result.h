/* Declares the function that makes the mesh of the kernel's result (make_result.c). */
#ifndef VS_KERNEL_MESH_MAKE_RESULT_H
#define VS_KERNEL_MESH_MAKE_RESULT_H

#include "kernel/cluster.h"

bool vs_output_faces(vs_kernel *k, vs_cluster *c, vs_mesh *out);
bool vs_output_outlines(vs_kernel *k, vs_cluster *c, vs_outlines *out);

#endif
