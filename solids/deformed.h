/* Declares deformed objects. A VS_DEFORM node maps the bounds of its child trilinearly onto eight corners. This code
 * divides objects into leaves, and replaces VS_DEFORM nodes by placements and meshes.
 *
 * If the corners are those of a parallelepiped, the map is affine, and the child becomes a placement. Otherwise each
 * leaf is meshed, once for each child, and divided where the map bends it (geometry/shapes/bending.h). It is then
 * mapped, once for each set of corners up to a rigid motion. If a hexahedron is a moved or rotated copy of an earlier
 * hexahedron, it becomes a placement of the earlier mesh. */
#ifndef VS_SOLIDS_DEFORMED_H
#define VS_SOLIDS_DEFORMED_H

#include "geometry/shapes/bending.h"
#include "solids/solid_meshes.h"

/* Divides an object into meshes, each with its material, layer and origin, in the object's coordinates. no_regions:
 * error message for a region; NULL: regions become surfaces. The object has been resolved (solids/resolve.h). Returns
 * false and sets e on failure. */
bool vs_take_apart(vs_ref object, const vs_fineness *facets, const vs_kernel_options *options, const char *no_regions,
                   vs_bend_leaves *out, vs_error *e);

/* Returns true if the deformation d, applied to an object with these bounds, is affine. *out: the affine map. */
bool vs_deform_is_affine(const struct vs_deform *d, const vs_bounds *bounds, vs_affine *out);

typedef struct vs_deformer vs_deformer;

/* Returns a new deformer, or NULL if memory is out. If the tolerance of `facets` is 0, a two-hundredth of each
 * hexahedron's diagonal is used. s, facets and options must exist longer than the deformer. */
vs_deformer *vs_deformer_new(vs_store *s, const vs_fineness *facets, const vs_kernel_options *options);
void vs_deformer_free(vs_deformer *d); /* frees the deformer d, which may be NULL */
/* Returns the child, deformed to the hexahedron `corners`, as a node of placements and meshes. The child has been
 * resolved. Returns NULL and sets e on failure. */
vs_node *vs_deformer_apply(vs_deformer *d, const struct vs_deform *corners, vs_ref child, vs_error *e);

#endif
