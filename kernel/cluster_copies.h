/* Owns the search for clusters that are copies of each other: the same parts, placed alike among themselves, in the
 * same role. */
#ifndef VS_KERNEL_CLUSTER_COPIES_H
#define VS_KERNEL_CLUSTER_COPIES_H

#include "kernel/problem.h"
#include "kernel/expression.h"
#include "kernel/distinct_meshes.h"

/* leaves: the caller's, who keeps them */
typedef struct { uint64_t hash; size_t key, length; const uint32_t *leaves; uint32_t count, next; } vs_original;

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
/* *original: which of the originals the cluster is a copy of, with the map from that to this; or a new one's number,
 * and *is_new. A cluster has at least one leaf. */
bool vs_copies_find(vs_kernel *k, vs_copies *c, const uint32_t *leaves, uint32_t count, uint32_t *original,
                    bool *is_new, vs_affine *map);
/* Appends to keys what says in which way the leaves make the result: the terms that they reach, by the order they are
 * reached in. */
bool vs_copies_put_terms(vs_kernel *k, vs_copies *c, const uint32_t *leaves, uint32_t count);
void vs_copies_free(vs_kernel *k, vs_copies *c);

#endif
