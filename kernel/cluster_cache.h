/* Owns what the world cache (model/store/cache.h) knows of clusters: the key of one, its triangles as bytes, and
 * back. */
#ifndef VS_KERNEL_CLUSTER_CACHE_H
#define VS_KERNEL_CLUSTER_CACHE_H

#include "kernel/problem.h"
#include "kernel/cluster_copies.h"

typedef VS_LIST(uint32_t) vs_places;    /* of a number: its place in a list, or VS_NONE */

typedef struct {
  VS_LIST(uint64_t) words;
  VS_LIST(uint32_t) tags;               /* the cluster's tags in the order of its leaves: what stands for them in key
                                         * and bytes are their places here */
  vs_places tag_place, paint_place;     /* of a tag of the problem, of a paint */
  VS_LIST(uint32_t) paints;
  VS_LIST(uint32_t) scratch;
} vs_remember;

/* The key of the cluster: everything that decides its triangles. gate: what is left of space, NULL where that leaves
 * out nothing of the cluster. *known false: it cannot have one (a leaf's mesh has no number). words and tags are valid
 * until the next call. */
bool vs_remember_key(vs_kernel *k, vs_remember *r, vs_copies *c, vs_group leaves, const vs_bounds *gate, bool *known);
/* Appends the cluster with that key to out, whose tags are there; *found false: it is not known. */
bool vs_remember_find(vs_kernel *k, vs_remember *r, vs_mesh *out, bool *found);
/* Keeps what was appended to out from there on as the cluster with that key. */
bool vs_remember_keep(vs_kernel *k, vs_remember *r, const vs_mesh *out, size_t first_vertex, size_t first_triangle);
void vs_remember_free(vs_kernel *k, vs_remember *r);

#endif
