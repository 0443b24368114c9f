/* Declares the triangles of a primitive: the mesh from geometry/, without overlaps. */
#ifndef VS_SOLIDS_PRIMITIVE_MESHES_H
#define VS_SOLIDS_PRIMITIVE_MESHES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "kernel/evaluate.h"
#include "model/store/cache.h"

/* Makes the mesh of a primitive in out, which must be empty, as vs_tessellate does. If the mesh overlaps itself
 * (sweeps, lofts, surfaces), it becomes the solid of all space around which it winds more than 0 times. options may be
 * NULL. Returns false and sets e on failure; e has no origin if geometry/ gives none. */
bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e);

/* The destination of a primitive's mesh, and the cache in which the mesh is searched and stored. */
typedef struct {
  vs_cache *cache;         /* cache in which meshes are searched and stored; NULL: there is none */
  vs_mesh *mesh;           /* mesh that receives the result; it must be empty at the call */
  const vs_cached **held;  /* If *held is set to a cache entry, this entry contains the mesh's arrays until the caller
                            * releases it; the mesh must not be changed or freed. If *held is NULL, the caller owns the
                            * mesh. */
} vs_kept_mesh;

/* Finds the mesh of primitive n in the cache, or makes it as vs_primitive_mesh does. Returns false and sets e on
 * failure. */
bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e);
/* vs_primitive_find only searches the cache for the mesh of n, and sets *held to NULL if it is not there.
 * vs_primitive_keep stores a mesh that the caller has made. */
bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f);
/* Finds the mesh of a part of half-space n in the cache, or makes it: the part inside the box `reach`. Returns false if
 * memory is out. */
bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach);

#endif
