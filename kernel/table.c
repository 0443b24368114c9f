/* Owns the hash tables of points and planes.
 *
 * A point's key is its three fixed numbers, which depend on its place alone; where two points of one key have remainders, the
 * wide integers decide. So every point has one number from its birth, whichever edges and planes it was found from: nothing has to be united later. */
#include "kernel/table.h"

static uint64_t mix(uint64_t h, uint64_t x) {
  h = (h ^ x) * 0x9e3779b97f4a7c15u;
  return h ^ h >> 29;
}

static uint64_t hash_fixed(const int64_t f[3]) { return mix(mix(mix(1, (uint64_t)f[0]), (uint64_t)f[1]), (uint64_t)f[2]); }

static uint64_t hash_plane(const vs_plane *p) {
  uint64_t h = mix(mix(mix(1, (uint64_t)p->n[0]), (uint64_t)p->n[1]), (uint64_t)p->n[2]);
  return mix(mix(h, (uint64_t)(vs_u128)p->d), (uint64_t)((vs_u128)p->d >> 64));
}

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

bool vs_points_add_fixed(vs_kernel *k, vs_points_table *t, const int64_t fixed[3], const vs_homogeneous *h, uint32_t *id) {
  bool grown;
  if (!heads_grow(k, &t->heads, &t->head_room, &t->head_count, t->all.count, &grown)) return false;
  if (grown)
    for (uint32_t i = 0; i < t->all.count; i++) {
      size_t slot = hash_fixed(t->all.at[i].fixed) & (t->head_count - 1);
      t->all.at[i].next = t->heads[slot];
      t->heads[slot] = i;
    }
  size_t slot = hash_fixed(fixed) & (t->head_count - 1);
  for (uint32_t i = t->heads[slot]; i != VS_NONE; i = t->all.at[i].next) {
    const vs_point *p = &t->all.at[i];
    if (p->fixed[0] != fixed[0] || p->fixed[1] != fixed[1] || p->fixed[2] != fixed[2] || vs_point_exact(p) != (h == NULL)) continue;
    if (h && !vs_homogeneous_equal(h, &t->big.at[p->big])) continue;
    *id = i;
    return true;
  }
  vs_point p = { { fixed[0], fixed[1], fixed[2] }, VS_POINT_EXACT, t->heads[slot] };
  if (h) {
    p.big = (uint32_t)t->big.count;
    if (!VS_PUSH(k, t->big, *h)) return false;
  }
  *id = (uint32_t)t->all.count;
  if (*id >= VS_POINT_MORE) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have more than 2 billion vertices");
  if (!VS_PUSH(k, t->all, p)) return false;
  t->heads[slot] = *id;
  return true;
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
}

bool vs_planes_add(vs_kernel *k, vs_planes_table *t, const vs_plane *p, uint32_t *id) {
  bool grown;
  if (!heads_grow(k, &t->heads, &t->head_room, &t->head_count, t->all.count, &grown)) return false;
  if (grown)
    for (uint32_t i = 0; i < t->all.count; i++) {
      size_t slot = hash_plane(&t->all.at[i]) & (t->head_count - 1);
      t->next.at[i] = t->heads[slot];
      t->heads[slot] = i;
    }
  size_t slot = hash_plane(p) & (t->head_count - 1);
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
