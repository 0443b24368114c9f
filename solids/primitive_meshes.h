/* Owns the triangles of one primitive as a good solid: the mesh from geometry/, without overlaps. */
#ifndef VS_SOLIDS_PRIMITIVE_MESHES_H
#define VS_SOLIDS_PRIMITIVE_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "kernel/evaluate.h"
#include "model/store/cache.h"

/* Like vs_tessellate, into an empty mesh. If a sweep, loft or surface overlaps itself, the result is the solid that it
 * winds around more than 0 times. The error has no origin if geometry/ gave none. options may be NULL. */
bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e);

/* The cache in which meshes are looked up and stored. */
typedef struct {
  vs_cache *cache;         /* NULL: there is no cache */
  vs_mesh *mesh;           /* the target; empty at first */
  const vs_cached **held;  /* the cache entry with the mesh's arrays, until the caller releases it: the mesh must not be
                            * changed or freed. *held NULL: the caller owns the mesh. */
} vs_kept_mesh;

/* Like vs_primitive_mesh. */
bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e);
/* The same in two steps: a lookup, which leaves *held NULL if the cache has no entry; and the storing of a new mesh. */
bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
/* The same for the part of a half-space within reach. Returns false when memory is out. */
bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach);

#endif
