/* Owns the triangles of one primitive as a good solid: what geometry/ makes of it, freed of its overlaps. */
#ifndef VS_SOLIDS_PRIMITIVE_MESHES_H
#define VS_SOLIDS_PRIMITIVE_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "kernel/evaluate.h"
#include "model/store/cache.h"

/* As vs_tessellate, into an empty mesh; where a sweep, loft or surface overlaps itself, it becomes what it winds around
 * more than 0 times. The error has no origin where geometry/ gave none. options may be NULL. */
bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e);

/* Meshes that are looked up in a cache and kept there. */
typedef struct {
  vs_cache *cache;         /* NULL: there is none */
  vs_mesh *mesh;           /* where it goes; empty at first */
  const vs_cached **held;  /* what the mesh's arrays lie in, until the caller lets it go: the mesh must be neither
                            * changed nor freed. *held NULL: the mesh is the caller's own. */
} vs_kept_mesh;

/* As vs_primitive_mesh. */
bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e);
/* The same in parts: is it kept, *held NULL where it is not; and keeping one that was made. */
bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
/* The same for the part of a half-space that is in reach. Fails when memory runs out. */
bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach);

#endif
