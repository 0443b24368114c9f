/* Owns deformed objects: it divides objects into leaves, and replaces VS_DEFORM nodes, which map their child's bounds
 * trilinearly onto eight corners.
 *
 * If the corners are those of a parallelepiped, the map is affine, and the child becomes a placement. Else each leaf is
 * meshed, once for each child, cut where the map bends it (geometry/shapes/bending.h), and mapped, once for each set of
 * corners up to a movement. A hexahedron that is a moved or turned copy of an earlier one gets the earlier mesh,
 * placed. */
#ifndef VS_SOLIDS_DEFORMED_H
#define VS_SOLIDS_DEFORMED_H

#include "geometry/shapes/bending.h"
#include "solids/solid_meshes.h"

/* Divides an object into leaves with their looks and origins, each a mesh in the object's coordinates. If facets has no
 * tolerance, each leaf has its default. The string no_regions is the error message for a region, or NULL: regions
 * become surfaces. The object is resolved (solids/resolve.h). */
bool vs_take_apart(vs_ref object, const vs_fineness *facets, const vs_kernel_options *options, const char *no_regions,
                   vs_bend_leaves *out, vs_error *e);

/* Returns true if the deformation of an object with these bounds is affine; *out is then its map. */
bool vs_deform_is_affine(const struct vs_deform *d, const vs_bounds *bounds, vs_affine *out);

typedef struct vs_deformer vs_deformer;

/* facets without tolerance: a two-hundredth of each hexahedron. All three arguments must outlive the deformer. Returns
 * NULL when memory is out. */
vs_deformer *vs_deformer_new(vs_store *s, const vs_fineness *facets, const vs_kernel_options *options);
void vs_deformer_free(vs_deformer *d); /* NULL is allowed */
/* Returns the deformed child, as placements and meshes; the child is resolved. Returns NULL and sets e on failure. */
vs_node *vs_deformer_apply(vs_deformer *d, const struct vs_deform *corners, vs_ref child, vs_error *e);

#endif
