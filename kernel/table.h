/* Owns the tables of a cluster that make equal things one: points by their exact place, planes by their exact equation. */
#ifndef VS_KERNEL_TABLE_H
#define VS_KERNEL_TABLE_H

#include "kernel/exact.h"
#include "kernel/memory.h"

#define VS_NONE UINT32_MAX

typedef struct {
  VS_LIST(vs_point) all;
  VS_LIST(vs_homogeneous) big;
  uint32_t *heads; /* chains by hash of the fixed numbers; a power of two */
  size_t head_room, head_count;
} vs_points_table;

/* A point that somebody has found, and has no number yet. */
typedef struct {
  vs_homogeneous at;
  int64_t fixed[3];
  uint64_t hash; /* of fixed */
  bool exact;
} vs_fresh_point;

typedef struct {
  VS_LIST(vs_plane) all;
  VS_LIST(uint32_t) next;
  uint32_t *heads;
  size_t head_room, head_count;
} vs_planes_table;

static inline vs_points_view vs_points_of(const vs_points_table *t) { return (vs_points_view){ t->all.at, t->big.at, NULL }; }

bool vs_points_integer(vs_kernel *k, vs_points_table *t, const int32_t at[3], uint32_t *id);
/* The number of the point, an older one where it lies in the same place. */
bool vs_points_add(vs_kernel *k, vs_points_table *t, const vs_homogeneous *h, uint32_t *id);
bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h, uint32_t *id); /* h NULL: exact */
uint64_t vs_points_hash(const int64_t fixed[3]);
void vs_fresh_fill(vs_fresh_point *f); /* the rest from `at` */
/* The numbers of many, in order. base: a table that goes before it and stays as it is, or NULL: then what is not there has base's count added. */
bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh, size_t count, uint32_t *ids);
bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more); /* more was made on top of t, and is empty afterwards */
void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]); /* of an input vertex */
void vs_points_free(vs_kernel *k, vs_points_table *t);

uint64_t vs_planes_hash(const vs_plane *p);
bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id);
/* So many more may come: the tables need not grow on the way. */
bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more);
bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more);
/* What is asked for soon is better in the cache by then: heads far ahead, first elements near ahead. */
static inline void vs_planes_ahead(const vs_planes_table *t, uint64_t hash, bool near) {
  const uint32_t *head = &t->heads[hash & (t->head_count - 1)];
  if (!near) __builtin_prefetch(head);
  else if (*head != VS_NONE) __builtin_prefetch(&t->all.at[*head]);
}
void vs_planes_free(vs_kernel *k, vs_planes_table *t);

#endif
