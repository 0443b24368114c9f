/* Finds clusters that are copies of each other: clusters of the same parts in the same relative placement, with the
 * same role in the expression. */
#ifndef VS_KERNEL_CLUSTER_COPIES_H
#define VS_KERNEL_CLUSTER_COPIES_H

#include "kernel/problem.h"
#include "kernel/expression.h"
#include "kernel/distinct_meshes.h"

/* The leaves of a cluster: an array with their numbers in the problem, which the caller owns. */
typedef struct { const uint32_t *at; uint32_t count; } vs_group;

/* A cluster that equals no earlier cluster. Its key begins at the index `key` of the array `keys` and has `length`
 * elements. `next`: index of the next such cluster with the same place in the hash table. */
typedef struct { uint64_t hash; size_t key, length; vs_group leaves; uint32_t next; } vs_original;

/* Result of the search for an earlier cluster of which a cluster is a copy. */
typedef struct {
  uint32_t original;         /* index in `originals` of the earlier cluster; for a new original, its own index */
  bool is_new;               /* true if no earlier cluster is equal, so that the cluster was added to `originals` */
  vs_affine map;             /* map that moves the earlier cluster to the place of its copy; for a new original, the
                              * identity */
} vs_cluster_copy;

typedef struct {
  const vs_kernel_problem *problem;
  const vs_parts *parts;
  const vs_expression *expression;
  VS_LIST(vs_original) originals;
  VS_LIST(uint64_t) keys;    /* keys of all original clusters, one after another, and then the key of the current
                              * cluster */
  VS_LIST(uint32_t) heads;   /* heads[h]: index in `originals` of the first cluster in slot h of the hash table */
  VS_LIST(uint32_t) terms;   /* terms of the problem whose value depends on the cluster's leaves, in the order of first
                              * use */
  VS_LIST(uint32_t) number;  /* number[t]: index in `terms` of the problem's term t, or VS_NONE */
} vs_copies;

bool vs_copies_begin(vs_kernel *k, vs_copies *c, const vs_kernel_problem *p, const vs_parts *parts,
                     const vs_expression *e);
/* Finds the earlier cluster that the given cluster copies, or adds the given cluster as a new original. It has at least
 * one leaf; the array of its leaves must live as long as c. Returns false when memory is out. */
bool vs_copies_find(vs_kernel *k, vs_copies *c, vs_group leaves, vs_cluster_copy *out);
/* Appends to `keys` the terms through which the leaves influence the result, in the order of first use. Returns false
 * when memory is out. */
bool vs_copies_put_terms(vs_kernel *k, vs_copies *c, vs_group leaves);
void vs_copies_free(vs_kernel *k, vs_copies *c);

#endif
