/* Declares the triangles of a primitive: the mesh from geometry/, without overlaps. */
#ifndef VS_SOLIDS_PRIMITIVE_MESHES_H
#define VS_SOLIDS_PRIMITIVE_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "kernel/evaluate.h"
#include "model/store/cache.h"

/* Makes the mesh of a primitive, as vs_tessellate does, in an empty mesh. If a sweep, loft or surface overlaps itself,
 * the result is the solid of all space that it winds around more than 0 times. The error has no origin if geometry/
 * reports none. options may be NULL. */
bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e);

/* The destination of a primitive's mesh, and the cache in which the mesh is searched and stored. */
typedef struct {
  vs_cache *cache;         /* cache of meshes; NULL: there is no cache */
  vs_mesh *mesh;           /* mesh that receives the result, empty at first */
  const vs_cached **held;  /* *held: cache entry that contains the mesh's arrays, until the caller releases it; the mesh
                            * must not be changed or freed. NULL: the caller owns the mesh. */
} vs_kept_mesh;

/* Makes the mesh of primitive n as vs_primitive_mesh does, or finds it in the cache. */
bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e);
/* The two steps of vs_primitive_shared as separate functions. vs_primitive_find searches the cache, and leaves *held
 * NULL if it has no entry. vs_primitive_keep stores a new mesh. */
bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
/* Makes the mesh of the part of half-space n inside the box `reach`, or finds it in the cache. Returns false if memory
 * is out. */
bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach);

#endif
