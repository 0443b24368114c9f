/* Declares the triangles of a primitive: the mesh from geometry/, without overlaps. */
#ifndef VS_SOLIDS_PRIMITIVE_MESHES_H
#define VS_SOLIDS_PRIMITIVE_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "kernel/evaluate.h"
#include "model/store/cache.h"

/* Makes the mesh of a primitive, as vs_tessellate does, into an empty mesh. If a sweep, loft or surface overlaps
 * itself, the result is the solid that it winds around more than 0 times. The error has no origin if that of geometry/
 * has none. options may be NULL. */
bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e);

/* Where a mesh is put, and the cache in which it is searched for and stored. */
typedef struct {
  vs_cache *cache;         /* cache of meshes; NULL: there is no cache */
  vs_mesh *mesh;           /* mesh that receives the result, empty at first */
  const vs_cached **held;  /* cache entry that contains the mesh's arrays, until the caller releases it; the mesh must
                            * not be changed or freed. *held NULL: the caller owns the mesh. */
} vs_kept_mesh;

/* Makes the mesh of a primitive as vs_primitive_mesh does, or finds it in the cache. */
bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e);
/* Do the work of vs_primitive_shared in two steps. vs_primitive_find leaves *held NULL if the cache has no entry.
 * vs_primitive_keep stores a new mesh. */
bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
/* Makes, or finds in the cache, the mesh of the part of a half-space inside reach. Returns false if memory is out. */
bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach);

#endif
