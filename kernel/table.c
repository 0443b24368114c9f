/* Owns the hash tables of points and planes.
 *
 * A point's key is its three fixed numbers, which depend on its place alone; where two points of one key have remainders, the
 * wide integers decide. So every point has one number from its birth, whichever edges and planes it was found from: nothing has to be united later. */
#include "kernel/table.h"

static uint64_t mix(uint64_t h, uint64_t x) {
  h = (h ^ x) * 0x9e3779b97f4a7c15u;
  return h ^ h >> 29;
}

uint64_t vs_points_hash(const int64_t f[3]) { return mix(mix(mix(1, (uint64_t)f[0]), (uint64_t)f[1]), (uint64_t)f[2]); }

/* Doubles the heads when `count` elements would fill them; the caller chains anew when *grown. */
static bool heads_grow(vs_kernel *k, uint32_t **heads, size_t *room, size_t *used, size_t count, bool *grown) {
  *grown = false;
  if (count < *used) return true;
  size_t want = *used ? *used * 2 : 256;
  while (want <= count) want *= 2;
  if (want > *room && !vs_kernel_grow(k, heads, room, want, sizeof **heads)) return false;
  *used = want;
  for (size_t i = 0; i < want; i++) (*heads)[i] = VS_NONE;
  *grown = true;
  return true;
}

static bool points_grow(vs_kernel *k, vs_points_table *t, size_t count) {
  bool grown;
  if (!heads_grow(k, &t->heads, &t->head_room, &t->head_count, count, &grown)) return false;
  if (grown)
    for (uint32_t i = 0; i < t->all.count; i++) {
      size_t slot = vs_points_hash(t->all.at[i].fixed) & (t->head_count - 1);
      t->all.at[i].next = t->heads[slot];
      t->heads[slot] = i;
    }
  return true;
}

static uint32_t points_find(const vs_points_table *t, uint64_t hash, const int64_t fixed[3], const vs_homogeneous *h) {
  if (!t->head_count) return VS_NONE;
  for (uint32_t i = t->heads[hash & (t->head_count - 1)]; i != VS_NONE; i = t->all.at[i].next) {
    const vs_point *p = &t->all.at[i];
    if (p->fixed[0] != fixed[0] || p->fixed[1] != fixed[1] || p->fixed[2] != fixed[2] || vs_point_exact(p) != (h == NULL)) continue;
    if (!h || vs_homogeneous_equal(h, &t->big.at[p->big])) return i;
  }
  return VS_NONE;
}

static bool points_insert(vs_kernel *k, vs_points_table *t, uint64_t hash, const int64_t fixed[3], const vs_homogeneous *h, uint32_t *id) {
  size_t slot = hash & (t->head_count - 1);
  vs_point p = { { fixed[0], fixed[1], fixed[2] }, VS_POINT_EXACT, t->heads[slot] };
  if (h) {
    p.big = (uint32_t)t->big.count;
    if (!VS_PUSH(k, t->big, *h)) return false;
  }
  *id = (uint32_t)t->all.count;
  if (*id >= VS_POINT_MORE / 2) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have more than a billion vertices");
  if (!VS_PUSH(k, t->all, p)) return false;
  t->heads[slot] = *id;
  return true;
}

bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h, uint32_t *id) {
  uint64_t hash = vs_points_hash(fixed);
  if (!points_grow(k, t, t->all.count)) return false;
  *id = points_find(t, hash, fixed, h);
  return *id != VS_NONE || points_insert(k, t, hash, fixed, h, id);
}

void vs_fresh_fill(vs_fresh_point *f) {
  f->exact = vs_homogeneous_fix(&f->at, f->fixed);
  f->hash = vs_points_hash(f->fixed);
}

/* Two loads of memory ahead of what is looked for: the chain's head, and then its first point. */
static void look_ahead(const vs_points_table *t, const vs_fresh_point *fresh, size_t i, size_t count) {
  enum { FAR = 16, NEAR = 8 };
  if (!t->head_count) return;
  if (i + FAR < count) __builtin_prefetch(&t->heads[fresh[i + FAR].hash & (t->head_count - 1)]);
  if (i + NEAR < count) {
    uint32_t head = t->heads[fresh[i + NEAR].hash & (t->head_count - 1)];
    if (head != VS_NONE) __builtin_prefetch(&t->all.at[head]);
  }
}

bool vs_points_expect(vs_kernel *k, vs_points_table *t, size_t more) { return points_grow(k, t, t->all.count + more); }

bool vs_points_add_all(vs_kernel *k, vs_points_table *t, const vs_points_table *base, const vs_fresh_point *fresh, size_t count, uint32_t *ids) {
  for (size_t i = 0; i < count; i++) {
    const vs_fresh_point *f = &fresh[i];
    const vs_homogeneous *h = f->exact ? NULL : &f->at;
    if (!points_grow(k, t, t->all.count)) return false;
    if (base) look_ahead(base, fresh, i, count);
    look_ahead(t, fresh, i, count);
    ids[i] = base ? points_find(base, f->hash, f->fixed, h) : VS_NONE;
    if (ids[i] != VS_NONE) continue;
    ids[i] = points_find(t, f->hash, f->fixed, h);
    if (ids[i] == VS_NONE && !points_insert(k, t, f->hash, f->fixed, h, &ids[i])) return false;
    if (base) ids[i] += (uint32_t)base->all.count;
  }
  return true;
}

bool vs_points_append(vs_kernel *k, vs_points_table *t, vs_points_table *more) {
  uint32_t big = (uint32_t)t->big.count;
  bool ok = VS_ROOM(k, t->all.at, t->all.room, t->all.count + more->all.count + 1) && VS_ROOM(k, t->big.at, t->big.room, t->big.count + more->big.count + 1);
  for (size_t i = 0; ok && i < more->all.count; i++) { /* in no chain: nothing is looked for any more */
    vs_point p = more->all.at[i];
    if (p.big != VS_POINT_EXACT) p.big += big;
    p.next = VS_NONE;
    t->all.at[t->all.count++] = p;
  }
  for (size_t i = 0; ok && i < more->big.count; i++) t->big.at[t->big.count++] = more->big.at[i];
  vs_points_free(k, more);
  VS_FREE(k, t->heads, t->head_room);
  t->head_count = 0;
  return ok;
}

bool vs_points_integer(vs_kernel *k, vs_points_table *t, const int32_t at[3], uint32_t *id) {
  int64_t fixed[3];
  for (int i = 0; i < 3; i++) fixed[i] = (int64_t)at[i] * ((int64_t)1 << VS_FIXED_BITS);
  return vs_points_add_fixed(k, t, fixed, NULL, id);
}

bool vs_points_add(vs_kernel *k, vs_points_table *t, const vs_homogeneous *h, uint32_t *id) {
  int64_t fixed[3];
  bool exact = vs_homogeneous_fix(h, fixed);
  return vs_points_add_fixed(k, t, fixed, exact ? NULL : h, id);
}

void vs_points_grid(const vs_points_table *t, uint32_t id, int32_t out[3]) {
  for (int i = 0; i < 3; i++) out[i] = vs_point_grid(&t->all.at[id], i);
}

void vs_points_free(vs_kernel *k, vs_points_table *t) {
  VS_DROP(k, t->all);
  VS_DROP(k, t->big);
  VS_FREE(k, t->heads, t->head_room);
  t->head_count = 0;
}

uint64_t vs_planes_hash(const vs_plane *p) {
  uint64_t h = mix(mix(mix(1, (uint64_t)p->n[0]), (uint64_t)p->n[1]), (uint64_t)p->n[2]);
  return mix(mix(h, (uint64_t)(vs_u128)p->d), (uint64_t)((vs_u128)p->d >> 64));
}

/* Heads for so many, chained anew where there are more of them than before. */
static bool planes_grow(vs_kernel *k, vs_planes_table *t, size_t count) {
  bool grown;
  if (!heads_grow(k, &t->heads, &t->head_room, &t->head_count, count, &grown)) return false;
  if (grown)
    for (uint32_t i = 0; i < t->all.count; i++) {
      size_t slot = vs_planes_hash(&t->all.at[i]) & (t->head_count - 1);
      t->next.at[i] = t->heads[slot];
      t->heads[slot] = i;
    }
  return true;
}

bool vs_planes_expect(vs_kernel *k, vs_planes_table *t, size_t more) { return planes_grow(k, t, t->all.count + more); }

bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint64_t hash, uint32_t *id) {
  if (!planes_grow(k, t, t->all.count)) return false;
  size_t slot = hash & (t->head_count - 1);
  for (uint32_t i = t->heads[slot]; i != VS_NONE; i = t->next.at[i]) {
    const vs_plane *q = &t->all.at[i];
    if (q->n[0] == p->n[0] && q->n[1] == p->n[1] && q->n[2] == p->n[2] && q->d == p->d) {
      *id = i;
      return true;
    }
  }
  *id = (uint32_t)t->all.count;
  if (!VS_PUSH(k, t->all, *p) || !VS_PUSH(k, t->next, t->heads[slot])) return false;
  t->heads[slot] = *id;
  return true;
}

void vs_planes_free(vs_kernel *k, vs_planes_table *t) {
  VS_DROP(k, t->all);
  VS_DROP(k, t->next);
  VS_FREE(k, t->heads, t->head_room);
}
