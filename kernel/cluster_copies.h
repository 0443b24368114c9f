/* Owns the search for clusters that are copies of each other: the same parts in the same relative placement, with the
 * same role in the expression. */
#ifndef VS_KERNEL_CLUSTER_COPIES_H
#define VS_KERNEL_CLUSTER_COPIES_H

#include "kernel/problem.h"
#include "kernel/expression.h"
#include "kernel/distinct_meshes.h"

/* The leaves of a cluster, by their numbers in the problem; borrowed. */
typedef struct { const uint32_t *at; uint32_t count; } vs_group;

/* A cluster that equals no earlier one: the start and length of its key in `keys`; next: the next original with its
 * hash. */
typedef struct { uint64_t hash; size_t key, length; vs_group leaves; uint32_t next; } vs_original;

/* A cluster as the copy of an original. */
typedef struct {
  uint32_t original;         /* the original's number */
  bool is_new;               /* the cluster is the original */
  vs_affine map;             /* from the original to the copy; the identity for a new original */
} vs_cluster_copy;

typedef struct {
  const vs_kernel_problem *problem;
  const vs_parts *parts;
  const vs_expression *expression;
  VS_LIST(vs_original) originals;
  VS_LIST(uint64_t) keys;    /* keys of the originals, one after the other; the key of the current cluster follows */
  VS_LIST(uint32_t) heads;   /* chains of originals by hash */
  VS_LIST(uint32_t) terms;   /* terms that the cluster's leaves reach */
  VS_LIST(uint32_t) number;  /* of each term: its index in `terms`, or VS_NONE */
} vs_copies;

bool vs_copies_begin(vs_kernel *k, vs_copies *c, const vs_kernel_problem *p, const vs_parts *parts,
                     const vs_expression *e);
/* Finds the original of a cluster, or makes the cluster one; the caller keeps its leaves. A cluster has at least one
 * leaf. Returns false when memory is out. */
bool vs_copies_find(vs_kernel *k, vs_copies *c, vs_group leaves, vs_cluster_copy *out);
/* Appends to `keys` the way in which the leaves make the result: the terms that they reach, in that order. Returns
 * false when memory is out. */
bool vs_copies_put_terms(vs_kernel *k, vs_copies *c, vs_group leaves);
void vs_copies_free(vs_kernel *k, vs_copies *c);

#endif
