/* Computes the keys of clusters and compares them. Clusters that are copies of each other have equal keys. A key
 * contains the part, tag and placement of each leaf, and then the terms between the leaves and the result. The
 * placement is relative to the first leaf. It is rounded to 2^-36 of that leaf's size, because rounding errors change
 * equal rotations and translations slightly. */
#include "kernel/cluster_copies.h"

#include <math.h>
#include <string.h>

bool vs_copies_begin(vs_kernel *k, vs_copies *c, const vs_kernel_problem *p, const vs_parts *parts,
                     const vs_expression *e) {
  enum { HEADS = 256 };
  c->problem = p;
  c->parts = parts;
  c->expression = e;
  if (!VS_ROOM(k, c->number.at, c->number.room, (size_t)p->term_count + 1) ||
      !VS_ROOM(k, c->heads.at, c->heads.room, HEADS))
    return false;
  c->heads.count = HEADS;
  for (size_t i = 0; i < HEADS; i++) c->heads.at[i] = VS_NONE;
  for (uint32_t i = 0; i <= p->term_count; i++) c->number.at[i] = VS_NONE;
  return true;
}

static bool put(vs_kernel *k, vs_copies *c, uint64_t x) { return VS_PUSH(k, c->keys, x); }

static uint64_t rounded(double x, double unit) { return (uint64_t)(int64_t)floor(x / unit + 0.5); }

static bool put_leaf(vs_kernel *k, vs_copies *c, uint32_t leaf, const vs_affine *back, double size) {
  const vs_kernel_leaf *l = &c->problem->leaves[leaf];
  vs_affine a = vs_affine_multiply(back, &l->placement);
  if (!put(k, c, (uint64_t)c->parts->of_leaf.at[leaf] << 1 | l->bare) ||
      !put(k, c, c->problem->paints ? c->problem->paints[l->tag] : l->tag))
    return false;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 4; j++) {
      double x = a.m[i][j], unit = j < 3 ? 0x1p-36 : size * 0x1p-36;
      if (!(fabs(x / unit) < 0x1p62)) return put(k, c, UINT64_MAX) && put(k, c, leaf); /* The coordinate x is too large
                                                                                        * to be rounded. The leaf's
                                                                                        * number is appended instead, so
                                                                                        * that this key equals no other
                                                                                        * key. */
      if (!put(k, c, rounded(x, unit))) return false;
    }
  return true;
}

/* Appends the number of a term within the key. Terms are numbered in the order in which this function first sees
 * them. */
static bool reach(vs_kernel *k, vs_copies *c, uint32_t term) {
  VS_ASSERT(term < c->problem->term_count);
  if (c->number.at[term] == VS_NONE) {
    c->number.at[term] = (uint32_t)c->terms.count;
    if (!VS_PUSH(k, c->terms, term)) return false;
  }
  return put(k, c, c->number.at[term]);
}

bool vs_copies_put_terms(vs_kernel *k, vs_copies *c, vs_group leaves) {
  const vs_expression *e = c->expression;
  bool ok = true;
  c->terms.count = 0;
  for (uint32_t i = 0; ok && i < leaves.count; i++) {
    uint32_t end = e->leaf_first.at[leaves.at[i] + 1];
    for (uint32_t j = e->leaf_first.at[leaves.at[i]]; ok && j <= end; j++)
      ok = j < end ? reach(k, c, e->leaf_terms.at[j]) : put(k, c, UINT64_MAX);
  }
  for (size_t i = 0; ok && i < c->terms.count; i++) { /* reach() appends to c->terms during the loop */
    uint32_t t = c->terms.at[i];
    ok = put(k, c, (uint64_t)e->need.at[t] << 32 | (uint64_t)e->kind.at[t] << 1 | (t == e->root));
    /* Clears the number of operands in the last element of the key, because the value of a union or leaf does not
     * depend on it. */
    if (e->kind.at[t] == VS_TERM_UNION || e->kind.at[t] == VS_TERM_LEAF) c->keys.at[c->keys.count - 1] &= UINT32_MAX;
    for (uint32_t j = e->user_first.at[t]; ok && j < e->user_first.at[t + 1]; j++)
      ok = reach(k, c, e->users.at[j] / 2) &&
           (c->keys.at[c->keys.count - 1] |= (uint64_t)(e->users.at[j] & 1) << 32, true);
    ok = ok && put(k, c, UINT64_MAX) && vs_kernel_poll(k, 0);
  }
  for (uint32_t i = 0; ok && i < e->gate_count; i++) ok = put(k, c, c->number.at[e->gates[i]]);
  for (size_t i = 0; i < c->terms.count; i++) c->number.at[c->terms.at[i]] = VS_NONE;
  return ok;
}

/* Appends the key of the cluster to c->keys, and sets *hash to the key's hash. Sets *comparable to false if the cluster
 * has no key and therefore equals no other cluster. */
static bool put_key(vs_kernel *k, vs_copies *c, vs_group leaves, uint64_t *hash, bool *comparable) {
  size_t start = c->keys.count;
  vs_affine back;
  VS_ASSERT(leaves.count > 0);
  const vs_part *first = &c->parts->all.at[c->parts->of_leaf.at[leaves.at[0]]];
  *hash = 0;
  *comparable = (uint64_t)leaves.count * 2 <= c->problem->leaf_count && first->outer > 0 &&
                vs_affine_invert(&c->problem->leaves[leaves.at[0]].placement, &back);
  if (!*comparable) return true;
  int exponent;
  frexp(first->outer, &exponent);
  if (!put(k, c, leaves.count)) return false;
  for (uint32_t i = 0; i < leaves.count; i++)
    if (!put_leaf(k, c, leaves.at[i], &back, ldexp(1, exponent))) return false;
  if (!vs_copies_put_terms(k, c, leaves)) return false;
  for (size_t i = start; i < c->keys.count; i++) {
    *hash = (*hash ^ c->keys.at[i]) * 0x9e3779b97f4a7c15u;
    *hash ^= *hash >> 29;
  }
  return true;
}

/* Enlarges the hash table of clusters if it has no room for one more. */
static bool heads_grow(vs_kernel *k, vs_copies *c) {
  if (c->originals.count < c->heads.count) return true;
  size_t want = c->heads.count * 4;
  if (!VS_ROOM(k, c->heads.at, c->heads.room, want)) return false;
  c->heads.count = want;
  for (size_t i = 0; i < want; i++) c->heads.at[i] = VS_NONE;
  for (uint32_t i = 0; i < c->originals.count; i++) {
    uint32_t *head = &c->heads.at[c->originals.at[i].hash & (want - 1)];
    c->originals.at[i].next = *head;
    *head = i;
  }
  return true;
}

/* Computes the map that moves a leaf from the placement `from` to the placement `to`. Both placements are of one part,
 * whose middle is `middle`. Returns false if `from` cannot be inverted. */
static bool map_between(const vs_affine *from, const vs_affine *to, vs_vec3 middle, vs_affine *map) {
  vs_affine back;
  if (!vs_affine_invert(from, &back)) return false;
  *map = vs_affine_multiply(to, &back);
  for (int r = 0; r < 3; r++) /* replaces entries that differ from whole numbers only by rounding errors, as in
                               * translations and quarter turns, by the whole numbers */
    for (int j = 0; j < 3; j++) {
      double whole = floor(map->m[r][j] + 0.5);
      if (fabs(map->m[r][j] - whole) < 1e-14) map->m[r][j] = whole;
    }
  vs_vec3 there = vs_affine_point(to, middle), at = vs_affine_point(from, middle);
  vs_vec3 off = vs_v3_sub(there, vs_affine_vector(map, at));
  map->m[0][3] = off.x;
  map->m[1][3] = off.y;
  map->m[2][3] = off.z;
  if (vs_affine_is_translation(map))
    for (int r = 0; r < 3; r++) map->m[r][3] = to->m[r][3] - from->m[r][3];
  return true;
}

bool vs_copies_find(vs_kernel *k, vs_copies *c, vs_group leaves, vs_cluster_copy *out) {
  size_t start = c->keys.count;
  uint64_t hash;
  bool comparable;
  *out = (vs_cluster_copy){ (uint32_t)c->originals.count, true, vs_affine_identity() };
  if (!put_key(k, c, leaves, &hash, &comparable) || !heads_grow(k, c)) return false;
  const vs_kernel_leaf *first = &c->problem->leaves[leaves.at[0]];
  vs_vec3 middle = c->parts->all.at[c->parts->of_leaf.at[leaves.at[0]]].middle;
  size_t length = c->keys.count - start;
  uint32_t *head = &c->heads.at[hash & (c->heads.count - 1)];
  for (uint32_t i = *head; comparable && i != VS_NONE; i = c->originals.at[i].next) {
    const vs_original *o = &c->originals.at[i];
    if (o->hash != hash || o->length != length ||
        memcmp(c->keys.at + o->key, c->keys.at + start, length * sizeof *c->keys.at) != 0)
      continue;
    if (!map_between(&c->problem->leaves[o->leaves.at[0]].placement, &first->placement, middle, &out->map)) continue;
    out->original = i;
    out->is_new = false;
    c->keys.count = start;
    return true;
  }
  vs_original made = { hash, start, length, leaves, *head };
  if (comparable) *head = out->original;
  return VS_PUSH(k, c->originals, made);
}

void vs_copies_free(vs_kernel *k, vs_copies *c) {
  VS_DROP(k, c->originals);
  VS_DROP(k, c->keys);
  VS_DROP(k, c->heads);
  VS_DROP(k, c->terms);
  VS_DROP(k, c->number);
}
