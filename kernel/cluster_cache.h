/* Stores clusters in the world cache (model/store/cache.h): computes the key of a cluster, and converts its triangles
 * to bytes and back. */
#ifndef VS_KERNEL_CLUSTER_CACHE_H
#define VS_KERNEL_CLUSTER_CACHE_H

#include "kernel/problem.h"
#include "kernel/cluster_copies.h"

typedef VS_LIST(uint32_t) vs_places;    /* array that has, for each tag or each paint, its index in a list; VS_NONE if
                                         * it is not in the list */

typedef struct {
  VS_LIST(uint64_t) words;
  VS_LIST(uint32_t) tags;               /* the cluster's tags in the order in which its leaves use them; the key and the
                                         * stored bytes contain indices of this list */
  vs_places tag_place, paint_place;     /* tag_place, paint_place: for each tag and each paint of the problem, its index
                                         * in the order in which the cluster's leaves use them */
  VS_LIST(uint32_t) paints;
  VS_LIST(uint32_t) scratch;
} vs_remember;

/* Computes the key of the cluster: all data that determine its triangles. gate: bounds outside of which the result is
 * empty, or NULL if the whole cluster lies within them. Sets *known to false if the cluster has no key because a leaf's
 * mesh has no serial number. Returns false when memory is out. */
bool vs_remember_key(vs_kernel *k, vs_remember *r, vs_copies *c, vs_group leaves, const vs_bounds *gate, bool *known);
/* Searches the cache for the cluster whose key was computed last, and appends its triangles with their tags to out.
 * Sets *found to false if the cache does not contain the cluster. Returns false when memory is out. */
bool vs_remember_find(vs_kernel *k, vs_remember *r, vs_mesh *out, bool *found);
/* Stores a cluster in the cache under the key that was computed last: the triangles of out beginning with index
 * first_triangle, and its vertices beginning with first_vertex. Returns false when memory is out. */
bool vs_remember_keep(vs_kernel *k, vs_remember *r, const vs_mesh *out, size_t first_vertex, size_t first_triangle);
void vs_remember_free(vs_kernel *k, vs_remember *r);

#endif
