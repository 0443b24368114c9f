/* Declares a cluster's tables of distinct points and planes: points by their exact position, planes by their exact
 * equation. */
#ifndef VS_KERNEL_EXACT_INTERNED_H
#define VS_KERNEL_EXACT_INTERNED_H

#include "kernel/exact/exact.h"
#include "kernel/memory.h"

#define VS_NONE UINT32_MAX

/* Finds numbers by hash: a table with open addressing, at most three quarters full. The upper bits of the stored hash
 * choose the place. Therefore the next larger table has its entries in the same order, and a stored hash mostly
 * distinguishes different items without a look at the item. */
typedef struct { uint32_t tag, item; } vs_slot; /* item: VS_NONE if the slot is free */
typedef struct {
  vs_slot *at;
  size_t room, count; /* count: a power of two, or 0 */
  int shift;          /* shifts a tag to its place */
} vs_slots;

typedef struct {
  VS_LIST(vs_point) all;
  VS_LIST(vs_homogeneous) big;
  vs_slots slots; /* by hash of the fixed numbers */
} vs_points_table;

/* A new point without a number. */
typedef struct {
  vs_homogeneous at;
  int64_t fixed[3];
  uint64_t hash; /* of the fixed numbers */
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
/* Fills ids[v] for each of the vertices v, whose positions are corners[v]. */
bool vs_points_add_corners(vs_kernel *k, vs_points_table *t, int32_t (*corners)[3], const uint32_t *vertices,
                           size_t count, uint32_t *ids);
/* Returns in *id the number of the point: the old one if the table has the position. h NULL: the fixed numbers are
 * exact. */
bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h,
                         uint32_t *id);
uint64_t vs_points_hash(const int64_t fixed[3]);
void vs_fresh_fill(vs_fresh_point *f); /* fills the other members from `at` */
/* Returns the numbers of many points, in order. base: a table that comes before this one and does not change, or NULL;
 * numbers of points that base lacks have its count added. */
bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh,
                       size_t count, uint32_t *ids);
/* Appends `more`, which was built on top of t; it is empty afterwards. If its slots were forgotten, t does not find its
 * points. */
bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more);
void vs_points_forget(vs_kernel *k, vs_points_table *t); /* frees the slots when no further point is looked up */
/* The point has a number in the table, and is exact. */
void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]); /* for a vertex of the input */
void vs_points_free(vs_kernel *k, vs_points_table *t);

uint64_t vs_planes_hash(const vs_plane *p);
/* Returns in *id the number of the plane: the old one if the table has it; hash is the hash of p. */
bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id);
/* Makes room for `more` planes: the tables do not grow meanwhile. */
bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more);
bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more);
/* Prefetches entries that are needed soon: slots far ahead, their items near ahead. */
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
void vs_planes_forget(vs_kernel *k, vs_planes_table *t); /* frees the slots when no further plane is looked up */
void vs_planes_free(vs_kernel *k, vs_planes_table *t);

#endif
