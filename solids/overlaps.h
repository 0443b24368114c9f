/* Declares the removal of overlaps from meshes, so that they bound solids. */
#ifndef VS_SOLIDS_OVERLAPS_H
#define VS_SOLIDS_OVERLAPS_H

#include "geometry/tolerance.h"
#include "kernel/kernel_options.h"
#include "model/mesh.h"
#include "model/node.h"

/* Replaces a closed mesh that overlaps or touches itself by the solid of all space around which it winds more than 0
 * times. Does not change any other mesh. options may be NULL. Returns false and sets e on failure. */
bool vs_mesh_without_overlaps(vs_mesh *m, const vs_kernel_options *options, vs_error *e);

/* Sets *overlaps to true if the mesh that geometry/ makes of node n overlaps itself. Returns false and sets e on
 * failure. */
bool vs_primitive_overlaps(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, bool *overlaps,
                           vs_error *e);

/* Makes the mesh of n by geometry/, which may overlap itself. m must be empty. Returns false and sets e on failure, for
 * example if the limit on triangles is exceeded. */
bool vs_primitive_tessellated(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *m,
                              vs_error *e);

/* Removes the overlaps of m, the mesh that geometry/ has made of n. The mesh of a sweep then does not intersect itself
 * in the numbers of any format, and agrees with the exact sections at its tight bends. Returns false on failure; the
 * error then describes the bend. */
bool vs_primitive_freed(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *m,
                        vs_error *e);

#endif
