/* Owns the tables of a cluster that make equal things one: points by their exact place, planes by their exact
 * equation. */
#ifndef VS_KERNEL_EXACT_INTERNED_H
#define VS_KERNEL_EXACT_INTERNED_H

#include "kernel/exact/exact.h"
#include "kernel/memory.h"

#define VS_NONE UINT32_MAX

/* Finds numbers by hash: open places, of which three quarters are taken at most. A place is chosen by the upper bits of
 * what is kept of the hash, so that the next larger table has its entries in the same order, and one that is not the
 * same is mostly told without a look at what it stands for. */
typedef struct { uint32_t tag, item; } vs_slot; /* item: VS_NONE where it is free */
typedef struct {
  vs_slot *at;
  size_t room, count; /* count: a power of two, or 0 */
  int shift;          /* from a tag to its place */
} vs_slots;

typedef struct {
  VS_LIST(vs_point) all;
  VS_LIST(vs_homogeneous) big;
  vs_slots slots; /* by hash of the fixed numbers */
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
  vs_slots slots;
} vs_planes_table;

static inline vs_points_view vs_points_of(const vs_points_table *t) {
  return (vs_points_view){ t->all.at, t->big.at, NULL };
}

bool vs_points_integer(vs_kernel *k, vs_points_table *t, const int32_t at[3], uint32_t *id);
/* ids[v] of each of the vertices v, which lie at corners[v]. */
bool vs_points_add_corners(vs_kernel *k, vs_points_table *t, int32_t (*corners)[3], const uint32_t *vertices,
                           size_t count, uint32_t *ids);
/* The number of the point, an older one where it lies in the same place. h NULL: exact */
bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h,
                         uint32_t *id);
uint64_t vs_points_hash(const int64_t fixed[3]);
void vs_fresh_fill(vs_fresh_point *f); /* the rest from `at` */
/* The numbers of many, in order. base: a table that goes before it and stays as it is, or NULL: then what is not there
 * has base's count added. */
bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh,
                       size_t count, uint32_t *ids);
/* more was made on top of t, and is empty afterwards. If it had forgotten its points, they are not found in t. */
bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more);
void vs_points_forget(vs_kernel *k, vs_points_table *t); /* nothing is looked for any more: the slots go */
/* The point has a number in the table, and is exact. */
void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]); /* of an input vertex */
void vs_points_free(vs_kernel *k, vs_points_table *t);

uint64_t vs_planes_hash(const vs_plane *p);
/* The number of the plane, an older one where the table has it; hash is that of p. */
bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id);
/* Makes room for that many more: the tables need not grow on the way. */
bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more);
bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more);
/* Prefetches entries that are asked for soon: places far ahead, what they stand for near ahead. */
enum { VS_AHEAD_FAR = 16, VS_AHEAD_NEAR = 8 };
static inline const vs_slot *vs_slot_of(const vs_slots *s, uint64_t hash) {
  return &s->at[(uint32_t)(hash >> 32) >> s->shift];
}
VS_AHEAD vs_points_ahead(const vs_points_table *t, uint64_t hash, bool near) {
  const vs_slot *slot = vs_slot_of(&t->slots, hash);
  if (!near) __builtin_prefetch(slot);
  else if (slot->tag == (uint32_t)(hash >> 32) && slot->item != VS_NONE) __builtin_prefetch(&t->all.at[slot->item]);
}
VS_AHEAD vs_planes_ahead(const vs_planes_table *t, uint64_t hash, bool near) {
  const vs_slot *slot = vs_slot_of(&t->slots, hash);
  if (!near) __builtin_prefetch(slot);
  else if (slot->tag == (uint32_t)(hash >> 32) && slot->item != VS_NONE) __builtin_prefetch(&t->all.at[slot->item]);
}
void vs_planes_forget(vs_kernel *k, vs_planes_table *t); /* nothing is looked for any more: what finds it goes */
void vs_planes_free(vs_kernel *k, vs_planes_table *t);

#endif
