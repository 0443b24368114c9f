/* Owns deformed objects: objects taken apart into leaves, and what VS_DEFORM nodes become: their child's bounds mapped
 * trilinearly onto eight corners.
 *
 * Where the corners are a parallelepiped's the map is affine, and the child is placed. Else each leaf is meshed, once
 * for each child, cut where the map bends it (geometry/shapes/bending.h), and mapped, once for each set of corners up
 * to a movement: a hexahedron that is a moved or turned copy of an earlier one gets that one's mesh, placed. */
#ifndef VS_SOLIDS_DEFORMED_H
#define VS_SOLIDS_DEFORMED_H

#include "geometry/shapes/bending.h"
#include "solids/solid_meshes.h"

/* Takes an object apart into leaves with their looks and origins, each a mesh in the object's coordinates; facets
 * without tolerance: each leaf at its own default. no_regions: the error that a region is, or NULL: regions are
 * surfaces. The object is resolved (solids/resolve.h). */
bool vs_take_apart(vs_ref object, const vs_fineness *facets, const vs_kernel_options *options, const char *no_regions,
                   vs_bend_leaves *out, vs_error *e);

/* Is the deformation of an object with these bounds affine? Then *out is its map. */
bool vs_deform_is_affine(const struct vs_deform *d, const vs_bounds *bounds, vs_affine *out);

typedef struct vs_deformer vs_deformer;

/* facets without tolerance: a two-hundredth of each hexahedron. All three outlive it. NULL: out of memory. */
vs_deformer *vs_deformer_new(vs_store *s, const vs_fineness *facets, const vs_kernel_options *options);
void vs_deformer_free(vs_deformer *d); /* NULL is fine */
/* Returns the child deformed, as placements and meshes; the child is resolved. NULL: e is set. */
vs_node *vs_deformer_apply(vs_deformer *d, const struct vs_deform *corners, vs_ref child, vs_error *e);

#endif
