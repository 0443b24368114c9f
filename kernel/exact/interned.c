/* Implements the hash tables of points and planes.
 *
 * The key of a point is its three fixed-point numbers, which depend only on its position. If two points have the same
 * key and fractions, wide integers decide whether they are equal. Therefore a point has a single number from the start,
 * even if it is computed from different edges and planes. No later step unites points. */
#include "kernel/exact/interned.h"

#include <string.h>

static uint64_t mix(uint64_t h, uint64_t x) {
  h = (h ^ x) * 0x9e3779b97f4a7c15u;
  return h ^ h >> 29;
}

uint64_t vs_points_hash(const int64_t f[3]) { return mix(mix(mix(1, (uint64_t)f[0]), (uint64_t)f[1]), (uint64_t)f[2]); }

/* Enlarges the hash table so that it has room for `count` items. */
static bool slots_grow(vs_kernel *k, vs_slots *s, size_t count) {
  if (count < s->count / 4 * 3) return true;
  vs_slots more = { .count = s->count ? s->count * 2 : 256 };
  while (count >= more.count / 4 * 3) more.count *= 2;
  more.shift = __builtin_clzll(more.count) - 31;
  if (more.shift < 0) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many vertices");
  if (!VS_ROOM(k, more.at, more.room, more.count)) return false;
  memset(more.at, 0xff, more.count * sizeof *more.at);
  for (size_t i = 0; i < s->count; i++) {
    if (s->at[i].item == VS_NONE) continue;
    size_t to = s->at[i].tag >> more.shift;
    while (more.at[to].item != VS_NONE) to = (to + 1) & (more.count - 1);
    more.at[to] = s->at[i];
  }
  VS_FREE(k, s->at, s->room);
  *s = more;
  return true;
}

static void slots_free(vs_kernel *k, vs_slots *s) {
  VS_FREE(k, s->at, s->room);
  s->count = 0;
}

/* Returns the next item whose stored hash is `tag`. The search begins at slot *at. Sets *at to the item's slot. If
 * there is no such item, returns VS_NONE, and *at is a free slot. The number of slots is a power of two. */
static inline uint32_t slots_next(const vs_slots *s, uint32_t tag, size_t *at) {
  VS_ASSERT(s->count > 0 && (s->count & (s->count - 1)) == 0 && *at < s->count);
  for (;; *at = (*at + 1) & (s->count - 1))
    if (s->at[*at].item == VS_NONE || s->at[*at].tag == tag) return s->at[*at].item;
}

/* A point to find in the table or to add to it. */
typedef struct {
  uint64_t hash;           /* hash of `fixed`, the fixed-point coordinates */
  const int64_t *fixed;    /* three coordinates of the point, as fixed-point numbers */
  const vs_homogeneous *h; /* exact coordinates of the point; NULL: the fixed-point numbers are exact */
} point_key;

/* Returns the number of the point, or VS_NONE if the table lacks it. *slot is then the slot in which to store the
 * point. */
static uint32_t points_find(const vs_points_table *t, point_key key, size_t *slot) {
  const int64_t *fixed = key.fixed;
  const vs_homogeneous *h = key.h;
  uint32_t tag = (uint32_t)(key.hash >> 32), i;
  if (!t->slots.count) return *slot = 0, VS_NONE;
  for (*slot = tag >> t->slots.shift; (i = slots_next(&t->slots, tag, slot)) != VS_NONE;
       *slot = (*slot + 1) & (t->slots.count - 1)) {
    const vs_point *p = &t->all.at[i];
    if (p->fixed[0] != fixed[0] || p->fixed[1] != fixed[1] || p->fixed[2] != fixed[2] ||
        vs_point_exact(p) != (h == NULL))
      continue;
    if (!h || vs_homogeneous_equal(h, &t->big.at[p->big])) break;
  }
  return i;
}

/* Adds a point in the free slot that points_find has found, and sets *id to its number. */
static bool points_insert(vs_kernel *k, vs_points_table *t, point_key key, size_t slot, uint32_t *id) {
  vs_point p = { { key.fixed[0], key.fixed[1], key.fixed[2] }, VS_POINT_EXACT, VS_NONE };
  VS_ASSERT(slot < t->slots.count && t->slots.at[slot].item == VS_NONE);
  if (key.h) {
    p.big = (uint32_t)t->big.count;
    if (!VS_PUSH(k, t->big, *key.h)) return false;
  }
  *id = (uint32_t)t->all.count;
  if (*id >= VS_POINT_MORE / 2)
    return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have more than a billion vertices");
  if (!VS_PUSH(k, t->all, p)) return false;
  t->slots.at[slot] = (vs_slot){ (uint32_t)(key.hash >> 32), *id };
  return true;
}

bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h,
                         uint32_t *id) {
  const point_key key = { vs_points_hash(fixed), fixed, h };
  size_t slot;
  if (!slots_grow(k, &t->slots, t->all.count)) return false;
  *id = points_find(t, key, &slot);
  return *id != VS_NONE || points_insert(k, t, key, slot, id);
}

void vs_fresh_fill(vs_fresh_point *f) {
  f->exact = vs_homogeneous_fix(&f->at, f->fixed);
  f->hash = vs_points_hash(f->fixed);
}

bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more) {
  return slots_grow(k, &t->slots, t->all.count + more);
}

bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh,
                       size_t count, uint32_t *ids) {
  for (size_t i = 0; i < count; i++) {
    const vs_fresh_point *f = &fresh[i];
    const point_key key = { f->hash, f->fixed, f->exact ? NULL : &f->at };
    size_t slot = 0;
    if (!slots_grow(k, &t->slots, t->all.count)) return false;
    for (int table = base && base->slots.count ? 0 : 1; table < 2; table++) {
      if (i + VS_AHEAD_FAR < count) vs_points_ahead(table ? t : base, f[VS_AHEAD_FAR].hash, false);
      if (i + VS_AHEAD_NEAR < count) vs_points_ahead(table ? t : base, f[VS_AHEAD_NEAR].hash, true);
    }
    ids[i] = base ? points_find(base, key, &slot) : VS_NONE;
    if (ids[i] != VS_NONE) continue;
    ids[i] = points_find(t, key, &slot);
    if (ids[i] == VS_NONE && !points_insert(k, t, key, slot, &ids[i])) return false;
    if (base) ids[i] += (uint32_t)base->all.count;
  }
  return true;
}

bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more) {
  uint32_t big = (uint32_t)t->big.count, all = (uint32_t)t->all.count;
  bool ok = VS_ROOM(k, t->all.at, t->all.room, t->all.count + more->all.count + 1) &&
            VS_ROOM(k, t->big.at, t->big.room, t->big.count + more->big.count + 1) &&
            (!more->slots.count || slots_grow(k, &t->slots, t->all.count + more->all.count));
  for (size_t i = 0; ok && i < more->slots.count; i++) {
    vs_slot from = more->slots.at[i];
    if (from.item == VS_NONE) continue;
    size_t to = from.tag >> t->slots.shift;
    while (t->slots.at[to].item != VS_NONE) to = (to + 1) & (t->slots.count - 1);
    t->slots.at[to] = (vs_slot){ from.tag, all + from.item };
  }
  for (size_t i = 0; ok && i < more->all.count; i++) {
    vs_point p = more->all.at[i];
    if (p.big != VS_POINT_EXACT) p.big += big;
    p.next = VS_NONE;
    t->all.at[t->all.count++] = p;
  }
  for (size_t i = 0; ok && i < more->big.count; i++) t->big.at[t->big.count++] = more->big.at[i];
  vs_points_free(k, more);
  return ok;
}

void vs_points_forget(vs_kernel *k, vs_points_table *t) { slots_free(k, &t->slots); }

bool vs_points_integer(vs_kernel *k, vs_points_table *t, const int32_t at[3], uint32_t *id) {
  int64_t fixed[3];
  for (int i = 0; i < 3; i++) fixed[i] = (int64_t)at[i] * ((int64_t)1 << VS_FIXED_BITS);
  return vs_points_add_fixed(k, t, fixed, NULL, id);
}

bool vs_points_add_corners(vs_kernel *k, vs_points_table *t, int32_t (*corners)[3], const uint32_t *vertices,
                           size_t count, uint32_t *ids) {
  enum { BLOCK = 64 };
  for (size_t begin = 0; begin < count; begin += BLOCK) {
    size_t n = count - begin < BLOCK ? count - begin : BLOCK, slot = 0;
    int64_t fixed[BLOCK][3];
    uint64_t hash[BLOCK];
    if (!slots_grow(k, &t->slots, t->all.count + n)) return false;
    for (size_t i = 0; i < n; i++) {
      for (int a = 0; a < 3; a++)
        fixed[i][a] = (int64_t)corners[vertices[begin + i]][a] * ((int64_t)1 << VS_FIXED_BITS);
      hash[i] = vs_points_hash(fixed[i]);
      vs_points_ahead(t, hash[i], false);
    }
    for (size_t i = 0; i < n; i++) {
      uint32_t *id = &ids[vertices[begin + i]];
      const point_key key = { hash[i], fixed[i], NULL };
      *id = points_find(t, key, &slot);
      if (*id == VS_NONE && !points_insert(k, t, key, slot, id)) return false;
    }
  }
  return true;
}

void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]) {
  VS_ASSERT(id < t->all.count && vs_point_exact(&t->all.at[id]));
  for (int i = 0; i < 3; i++) out[i] = vs_point_grid(&t->all.at[id], i);
}

void vs_points_free(vs_kernel *k, vs_points_table *t) {
  VS_DROP(k, t->all);
  VS_DROP(k, t->big);
  slots_free(k, &t->slots);
}

uint64_t vs_planes_hash(const vs_plane *p) {
  uint64_t h = mix(mix(mix(1, (uint64_t)p->n[0]), (uint64_t)p->n[1]), (uint64_t)p->n[2]);
  return mix(mix(h, (uint64_t)(vs_u128)p->d), (uint64_t)((vs_u128)p->d >> 64));
}

bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more) {
  return slots_grow(k, &t->slots, t->all.count + more);
}

bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id) {
  VS_ASSERT(hash == vs_planes_hash(p));
  if (!slots_grow(k, &t->slots, t->all.count)) return false;
  uint32_t tag = (uint32_t)(hash >> 32);
  size_t slot = tag >> t->slots.shift;
  for (; (*id = slots_next(&t->slots, tag, &slot)) != VS_NONE; slot = (slot + 1) & (t->slots.count - 1)) {
    const vs_plane *q = &t->all.at[*id];
    if (q->n[0] == p->n[0] && q->n[1] == p->n[1] && q->n[2] == p->n[2] && q->d == p->d) return true;
  }
  *id = (uint32_t)t->all.count;
  t->slots.at[slot] = (vs_slot){ tag, *id };
  return VS_PUSH(k, t->all, *p);
}

void vs_planes_forget(vs_kernel *k, vs_planes_table *t) { slots_free(k, &t->slots); }

void vs_planes_free(vs_kernel *k, vs_planes_table *t) {
  VS_DROP(k, t->all);
  slots_free(k, &t->slots);
}
