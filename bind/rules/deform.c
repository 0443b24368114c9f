/* Owns objects deformed by hexahedra (deform.h).
 *
 * Plan: the object is taken apart into leaves with their looks; each leaf is a mesh in the object's coordinates, which
 * bind/shapes/bending.c cuts and bends by the map of a hexahedron. */
#include "bind/rules/deform.h"

#include <stdlib.h>
#include <string.h>

#include "bind/rules/scope.h"
#include "bind/shapes/bending.h"
#include "model/store/array.h"

enum { PLACED = 256, HALVINGS = 6 };

typedef struct {
  int64_t key[24];
  vs_node *object, *node;
} placed; /* retained both; node NULL: free */

struct vs_deformer {
  vs_bind *bind;
  vs_node *object; /* whose leaves these are; retained */
  vs_bend_leaves leaves;
  placed at[PLACED];
};

static void leaves_drop(vs_deformer *d) {
  vs_bend_drop(&d->leaves);
  vs_node_release(d->object);
  d->object = NULL;
}

vs_deformer *vs_deformer_new(vs_bind *b) {
  vs_deformer *d = vs_store_realloc(b->store, NULL, 0, sizeof *d);
  if (d) memset(d, 0, sizeof *d), d->bind = b;
  return d;
}

void vs_deformer_free(vs_deformer *d) {
  if (!d) return;
  leaves_drop(d);
  for (int i = 0; i < PLACED; i++) vs_node_release(d->at[i].node), vs_node_release(d->at[i].object);
  vs_store_realloc(d->bind->store, d, sizeof *d, 0);
}

static bool take_apart(vs_deformer *d, vs_ref object) {
  leaves_drop(d);
  if (!vs_bend_take_apart(d->bind, object,
                          "a hexahedron deforms solids, surfaces and curves, not regions: do-extrude them", &d->leaves))
    return false;
  d->object = vs_node_retain(object.node);
  return true;
}

/* ---- the map ---- */

typedef struct {
  vs_vec3 corner[8];
  vs_bounds from;
  double tolerance;
} hexahedron;

static double part(double x, double low, double high) { return high > low ? (x - low) / (high - low) : 0; }
static vs_vec3 between(vs_vec3 a, vs_vec3 b, double t) { return vs_v3_add(a, vs_v3_scale(vs_v3_sub(b, a), t)); }

static vs_vec3 mapped(const hexahedron *h, vs_vec3 p) {
  double u = part(p.x, h->from.min.x, h->from.max.x), v = part(p.y, h->from.min.y, h->from.max.y);
  double w = part(p.z, h->from.min.z, h->from.max.z);
  const vs_vec3 *c = h->corner;
  return between(between(between(c[0], c[1], u), between(c[2], c[3], u), v),
                 between(between(c[4], c[5], u), between(c[6], c[7], u), v), w);
}

/* ---- nodes ---- */

static vs_node *leaf_node(vs_deformer *d, const hexahedron *h, const vs_bend_leaf *l, bool mirrored) {
  vs_bending *b = vs_bending_new(l, h->tolerance, INFINITY, HALVINGS);
  vs_vec3 *images = NULL;
  size_t room = 0, count;
  const vs_vec3 *at;
  bool ok = b != NULL;
  while (ok && (at = vs_bending_wanted(b, &count), count)) {
    ok = VS_GROW(images, room, count);
    for (size_t i = 0; ok && i < count; i++) images[i] = mapped(h, at[i]);
    ok = ok && vs_bending_give(b, images);
  }
  vs_node *n = NULL;
  if (ok) {
    vs_mesh *m = vs_bending_mesh(b);
    if (mirrored) vs_mesh_turn(m, 0);
    n = vs_bend_node(d->bind, l, m);
  }
  vs_bending_free(b);
  free(images);
  return n;
}

static vs_node *all_leaves(vs_deformer *d, const hexahedron *h, bool mirrored) {
  vs_store *s = d->bind->store;
  vs_ref *refs = malloc((d->leaves.count + 1) * sizeof *refs);
  size_t made = 0;
  for (; refs && made < d->leaves.count; made++)
    if (!(refs[made] = (vs_ref){ leaf_node(d, h, &d->leaves.at[made], mirrored), NULL }).node) break;
  vs_node *n = NULL;
  if (refs && made == d->leaves.count)
    n = made == 1 ? vs_node_retain(refs[0].node) : vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, refs, made);
  for (size_t i = 0; i < made; i++) vs_node_release(refs[i].node);
  free(refs);
  return n;
}

/* ---- the whole ---- */

/* Is the hexahedron a parallelepiped? Then the map is affine. */
static bool is_affine(const vs_vec3 c[8], double size) {
  vs_vec3 x = vs_v3_sub(c[1], c[0]), y = vs_v3_sub(c[2], c[0]), z = vs_v3_sub(c[4], c[0]);
  for (int i = 0; i < 8; i++) {
    vs_vec3 at = c[0];
    if (i & 1) at = vs_v3_add(at, x);
    if (i & 2) at = vs_v3_add(at, y);
    if (i & 4) at = vs_v3_add(at, z);
    if (vs_v3_length(vs_v3_sub(at, c[i])) > 1e-9 * size) return false;
  }
  return fabs(vs_v3_dot(vs_v3_cross(x, y), z)) > 1e-12 * size * size * size;
}

static vs_vec3 axis_of(const vs_vec3 c[8], int bit) {
  vs_vec3 sum = vs_v3(0, 0, 0);
  for (int i = 0; i < 8; i++)
    if (!(i & bit)) sum = vs_v3_add(sum, vs_v3_sub(c[i | bit], c[i]));
  return sum;
}

static vs_node *move_node(vs_store *s, const vs_affine *m, vs_node *n) {
  return n ? vs_node_new(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = *m }, &(vs_ref){ n, NULL }, 1) : NULL;
}

static vs_node *finish(vs_deformer *d, vs_node *n) {
  if (!n) vs_fail_memory(d->bind->vm);
  return n;
}

vs_node *vs_deformer_apply(vs_deformer *d, const vs_vec3 corner[8], vs_ref object, const vs_bounds *bounds) {
  vs_store *s = d->bind->store;
  vs_bounds all = vs_bounds_empty();
  for (int i = 0; i < 8; i++) vs_bounds_add(&all, corner[i]);
  double size = vs_bounds_diagonal(&all);
  vs_vec3 sx = axis_of(corner, 1), sy = axis_of(corner, 2), sz = axis_of(corner, 4);
  if (is_affine(corner, size)) {
    vs_vec3 e = vs_v3_sub(bounds->max, bounds->min);
    vs_vec3 x = vs_v3_sub(corner[1], corner[0]), y = vs_v3_sub(corner[2], corner[0]),
            z = vs_v3_sub(corner[4], corner[0]);
    vs_affine m = vs_affine_columns(vs_v3_scale(x, e.x > 0 ? 1 / e.x : 1), vs_v3_scale(y, e.y > 0 ? 1 / e.y : 1),
                                    vs_v3_scale(z, e.z > 0 ? 1 / e.z : 1), vs_v3(0, 0, 0));
    vs_vec3 at = vs_v3_sub(corner[0], vs_affine_vector(&m, bounds->min));
    m.m[0][3] = at.x, m.m[1][3] = at.y, m.m[2][3] = at.z;
    return finish(d, vs_node_new(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = m }, &object, 1));
  }
  /* A frame of the hexahedron's own, so that copies of it elsewhere have the same numbers in it. */
  vs_vec3 fx = vs_v3_unit(sx), fz = vs_v3_unit(vs_v3_cross(sx, sy));
  vs_affine frame, back;
  if (vs_v3_length(fx) == 0 || vs_v3_length(fz) == 0)
    frame = vs_affine_translation(corner[0]);
  else
    frame = vs_affine_columns(fx, vs_v3_cross(fz, fx), fz, corner[0]);
  if (!vs_affine_invert(&frame, &back)) frame = vs_affine_translation(corner[0]), vs_affine_invert(&frame, &back);
  hexahedron h = { .from = *bounds, .tolerance = vs_bind_tolerance(d->bind) };
  if (!(h.tolerance > 0)) h.tolerance = size / 200;
  placed want = { { 0 }, object.node, NULL };
  double step = size > 0 ? pow(10, floor(log10(size)) - 9) : 1;
  uint64_t hash = object.node->hash;
  for (int i = 0; i < 8; i++) {
    vs_vec3 q = h.corner[i] = vs_affine_point(&back, corner[i]);
    const double at[3] = { q.x, q.y, q.z };
    for (int k = 0; k < 3; k++) {
      int64_t n = want.key[3 * i + k] = (int64_t)floor(at[k] / step + .5);
      hash = vs_scope_mix(hash, (uint64_t)n);
    }
  }
  placed *slot = &d->at[hash % PLACED];
  if (slot->node && slot->object == object.node && !memcmp(slot->key, want.key, sizeof want.key))
    return finish(d, move_node(s, &frame, slot->node));
  if (d->object != object.node && !take_apart(d, object)) return NULL;
  want.node = all_leaves(d, &h, vs_v3_dot(vs_v3_cross(sx, sy), sz) < 0);
  if (!want.node) return finish(d, NULL);
  vs_node_retain(want.object);
  vs_node_release(slot->node), vs_node_release(slot->object);
  *slot = want;
  return finish(d, move_node(s, &frame, slot->node));
}
