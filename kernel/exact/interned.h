/* Declares a cluster's tables of points and planes, in which equal items are stored once. Points are compared by their
 * exact position, planes by their exact equation. */
#ifndef VS_KERNEL_EXACT_INTERNED_H
#define VS_KERNEL_EXACT_INTERNED_H

#include "kernel/exact/exact.h"
#include "kernel/memory.h"

#define VS_NONE UINT32_MAX

/* A slot of a hash table with open addressing, which is at most three quarters full. The upper bits of the stored hash
 * select the slot, so a larger table keeps its items in the same order. */
typedef struct { uint32_t tag, item; } vs_slot; /* tag: upper half of the item's hash; item: number of the item, or
                                                 * VS_NONE if the slot is free */
typedef struct {
  vs_slot *at;
  size_t room, count; /* count: number of slots, a power of two or 0 */
  int shift;          /* number of bits by which a stored hash is shifted to the right to get its slot */
} vs_slots;

typedef struct {
  VS_LIST(vs_point) all;
  VS_LIST(vs_homogeneous) big;
  vs_slots slots; /* hash table that finds a point by its fixed-point coordinates */
} vs_points_table;

/* A computed point that has no number in a table of points yet. */
typedef struct {
  vs_homogeneous at;
  int64_t fixed[3];
  uint64_t hash; /* hash of the point's fixed-point coordinates */
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
/* Adds the points of the given vertices, whose positions are corners[v], and sets ids[v] to their numbers. Returns
 * false when memory is out. */
bool vs_points_add_corners(vs_kernel *k, vs_points_table *t, int32_t (*corners)[3], const uint32_t *vertices,
                           size_t count, uint32_t *ids);
/* Sets *id to the number of the point with the coordinates `fixed`. Adds the point if the table does not contain it. h:
 * exact coordinates, or NULL if the fixed-point numbers are exact. Returns false when memory is out. */
bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h,
                         uint32_t *id);
uint64_t vs_points_hash(const int64_t fixed[3]);
void vs_fresh_fill(vs_fresh_point *f); /* sets the members `fixed` and `hash` of the point from its exact position
                                        * `at` */
/* Sets ids to the numbers of many points, and adds the points that neither table contains to t. base: a table whose
 * points precede those of t and which does not change, or NULL. A point of t gets its index in t plus the number of
 * points in base. Returns false when memory is out. */
bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh,
                       size_t count, uint32_t *ids);
/* Appends the points of the table `more`, which was built with t as its base, to t. `more` is empty afterwards. If the
 * hash table of `more` was freed, later searches in t do not find these points. Returns false when memory is out. */
bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more);
void vs_points_forget(vs_kernel *k, vs_points_table *t); /* frees the hash table of t, after which points can no longer
                                                          * be searched */
/* Sets out to the position of point `id` of the table, in whole grid steps. */
void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]); /* the point must be a vertex of the
                                                                             * input */
void vs_points_free(vs_kernel *k, vs_points_table *t);

uint64_t vs_planes_hash(const vs_plane *p);
/* Sets *id to the number of plane p. Adds the plane if the table does not contain it. hash: hash of p. Returns false
 * when memory is out. */
bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id);
/* Reserves memory for `more` additional planes, so that adding them does not enlarge the table. Returns false when
 * memory is out. */
bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more);
bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more);
/* How far ahead a loop over many items prefetches memory of a hash table: the slot of the item VS_AHEAD_FAR steps
 * later, and the entry in the slot VS_AHEAD_NEAR steps later. */
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
void vs_planes_forget(vs_kernel *k, vs_planes_table *t); /* frees the hash table of t, after which planes can no longer
                                                          * be searched */
void vs_planes_free(vs_kernel *k, vs_planes_table *t);

#endif
