/* Owns the removal of overlaps from meshes, which makes them good solids. */
#ifndef VS_SOLIDS_OVERLAPS_H
#define VS_SOLIDS_OVERLAPS_H

#include "geometry/tolerance.h"
#include "kernel/kernel_options.h"
#include "model/mesh.h"
#include "model/node.h"

/* Replaces a closed mesh that overlaps or touches itself by the solid that it winds around more than 0 times; any other
 * stays unchanged. options may be NULL. */
bool vs_mesh_without_overlaps(vs_mesh *m, const vs_kernel_options *options, vs_error *e);

/* Sets *overlaps: whether the mesh of n from geometry/ overlaps itself. Fails as e's error tells. */
bool vs_primitive_overlaps(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, bool *overlaps,
                           vs_error *e);

/* Removes the overlaps of m, the mesh of n from geometry/, as vs_mesh_without_overlaps does. The mesh of a sweep then
 * does not intersect itself in the numbers of any format either. The error names the bend of a sweep if this fails. */
bool vs_primitive_freed(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *m,
                        vs_error *e);

#endif
