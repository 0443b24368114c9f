/* Owns the clusters in the world cache (model/store/cache.h): the key of a cluster, and its triangles to bytes and
 * back. */
#ifndef VS_KERNEL_CLUSTER_CACHE_H
#define VS_KERNEL_CLUSTER_CACHE_H

#include "kernel/problem.h"
#include "kernel/cluster_copies.h"

typedef VS_LIST(uint32_t) vs_places;    /* of each number: its place in a list, or VS_NONE */

typedef struct {
  VS_LIST(uint64_t) words;
  VS_LIST(uint32_t) tags;               /* the cluster's tags in the order of its leaves: the key and the bytes contain
                                         * their places here */
  vs_places tag_place, paint_place;     /* of the problem's tags; of its paints */
  VS_LIST(uint32_t) paints;
  VS_LIST(uint32_t) scratch;
} vs_remember;

/* Makes the key of the cluster: all data that its triangles depend on. gate: the bounds outside of which the result is
 * empty, or NULL if they contain the whole cluster. *known false: the cluster has no key, since a leaf's mesh has no
 * number. words and tags are valid until the next call. */
bool vs_remember_key(vs_kernel *k, vs_remember *r, vs_copies *c, vs_group leaves, const vs_bounds *gate, bool *known);
/* Appends the cached cluster with that key, and its tags, to out; *found false: the cache does not have it. */
bool vs_remember_find(vs_kernel *k, vs_remember *r, vs_mesh *out, bool *found);
/* Stores the triangles of out from first_triangle on, and its vertices from first_vertex on, as the cluster with that
 * key. */
bool vs_remember_keep(vs_kernel *k, vs_remember *r, const vs_mesh *out, size_t first_vertex, size_t first_triangle);
void vs_remember_free(vs_kernel *k, vs_remember *r);

#endif
