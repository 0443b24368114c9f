/* Owns the search for clusters that are copies of each other: the same parts, placed alike among themselves, in the
 * same role. */
#ifndef VS_KERNEL_CLUSTER_COPIES_H
#define VS_KERNEL_CLUSTER_COPIES_H

#include "kernel/problem.h"
#include "kernel/expression.h"
#include "kernel/distinct_meshes.h"

/* The leaves of a cluster, by their numbers in the problem; borrowed. */
typedef struct { const uint32_t *at; uint32_t count; } vs_group;

/* A cluster that is like no other before it: where its key begins among keys, and the next of its hash. */
typedef struct { uint64_t hash; size_t key, length; vs_group leaves; uint32_t next; } vs_original;

/* A cluster as the copy of an original. */
typedef struct {
  uint32_t original;         /* its number */
  bool is_new;               /* it is that original itself */
  vs_affine map;             /* from the original; the identity of a new one */
} vs_cluster_copy;

typedef struct {
  const vs_kernel_problem *problem;
  const vs_parts *parts;
  const vs_expression *expression;
  VS_LIST(vs_original) originals;
  VS_LIST(uint64_t) keys;    /* of the originals, one after the other; behind them the one at hand */
  VS_LIST(uint32_t) heads;   /* chains of originals by hash */
  VS_LIST(uint32_t) terms;   /* reached from the cluster's leaves */
  VS_LIST(uint32_t) number;  /* of a term among them; VS_NONE else */
} vs_copies;

bool vs_copies_begin(vs_kernel *k, vs_copies *c, const vs_kernel_problem *p, const vs_parts *parts,
                     const vs_expression *e);
/* Finds the original of a cluster, or makes it one, whose leaves the caller keeps. A cluster has at least one leaf. */
bool vs_copies_find(vs_kernel *k, vs_copies *c, vs_group leaves, vs_cluster_copy *out);
/* Appends to keys what says in which way the leaves make the result: the terms that they reach, by the order they are
 * reached in. */
bool vs_copies_put_terms(vs_kernel *k, vs_copies *c, vs_group leaves);
void vs_copies_free(vs_kernel *k, vs_copies *c);

#endif
