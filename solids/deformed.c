/* Implements deformed objects (deformed.h). */
#include "solids/deformed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "geometry/plane/curve.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"
#include "model/store/array.h"
#include "model/store/nodemap.h"
#include "solids/overlaps.h"

/* HALVINGS: greatest number of times that an edge is halved. USUAL: a hexahedron's diagonal divided by this is the
 * default tolerance. FINEST: divided by this, it is the least tolerance. */
enum { HALVINGS = 6, FINEST = 1000, USUAL = 200 };

/* ---- leaves ---- */

typedef struct {
  vs_ref ref;
  vs_affine map;
  vs_node *looks[VS_BEND_LOOKS];
  int look_count;
} open_node;

/* Makes the mesh of the node of o, with its placement; for a curve, the mesh has only vertices. no_regions: error
 * message for a region; NULL: regions are allowed. Returns false on failure. */
static bool mesh_leaf(const open_node *o, const vs_fineness *asked, const vs_kernel_options *options,
                      const char *no_regions, vs_bend_leaf *l, vs_error *e) {
  vs_ref ref = o->ref;
  vs_node *n = ref.node;
  vs_fineness facets = *asked;
  vs_bounds b;
  bool ok = true;
  if (facets.tolerance <= 0 && vs_node_bounds(n, &b, NULL)) facets.tolerance = vs_fineness_tolerance(&b);
  if (!(facets.tolerance > 0)) facets.tolerance = 1;
  if (n->class_ == VS_SOLID) {
    vs_solid solid = { 0 };
    if (!vs_solid_evaluate(&ref, 1, &facets, options, &solid, e)) return false;
    l->mesh = solid.mesh, l->closed = true;
    solid.mesh = (vs_mesh){ 0 };
    vs_solid_free(&solid);
  } else if (n->class_ == VS_SURFACE || (n->class_ == VS_REGION_CLASS && !no_regions)) {
    if (!vs_tessellate(n, &facets, &l->mesh, e)) return false;
  } else if (n->class_ == VS_CURVE) {
    vs_polyline p = { 0 };
    if (!vs_curve_sample(n, &facets, &p, e)) return false;
    l->curve = true, l->closed = p.closed;
    for (size_t i = 0; ok && i < p.count; i++) ok = vs_mesh_add_vertex(&l->mesh, p.at[i], NULL);
    vs_polyline_free(&p);
  } else {
    return vs_error_set(e, VS_ERROR_MODEL, ref.origin, "%s", no_regions ? no_regions : "this is no object in space");
  }
  if (!ok) return vs_error_memory(e, ref.origin);
  vs_mesh_transform(&l->mesh, &o->map);
  return true;
}

/* Stores wrapper n, a material or layer, as the look of o. An inner material replaces an outer one, and an inner layer
 * an outer layer. */
static void put_look(open_node *o, vs_node *n) {
  int i = 0;
  while (i < o->look_count && o->looks[i]->kind != n->kind) i++;
  o->looks[i] = n;
  if (i == o->look_count) o->look_count++;
}

bool vs_take_apart(vs_ref object, const vs_fineness *facets, const vs_kernel_options *options, const char *no_regions,
                   vs_bend_leaves *out, vs_error *e) {
  open_node *stack = NULL;
  size_t count = 0, room = 0;
  *out = (vs_bend_leaves){ 0 };
  bool ok = VS_GROW(stack, room, 1) || vs_error_memory(e, object.origin);
  if (ok) stack[count++] = (open_node){ .ref = object, .map = vs_affine_identity() };
  while (ok && count) {
    open_node o = stack[--count];
    vs_node *n = o.ref.node;
    if (n->class_ == VS_NOTHING) continue;
    if (n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n)) {
      if (n->kind == VS_TRANSFORM) o.map = vs_affine_multiply(&o.map, &VS_AS(transform, n)->matrix);
      if (n->kind == VS_MATERIAL || n->kind == VS_LAYER) put_look(&o, n);
      ok = VS_GROW(stack, room, count + n->child_count) || vs_error_memory(e, object.origin);
      for (uint32_t i = n->child_count; ok && i-- > 0;) o.ref = n->children[i], stack[count++] = o;
      continue;
    }
    ok = VS_GROW(out->at, out->room, out->count + 1) || vs_error_memory(e, object.origin);
    if (!ok) break;
    vs_bend_leaf *l = &out->at[out->count++];
    *l = (vs_bend_leaf){ .origin = o.ref.origin };
    ok = mesh_leaf(&o, facets, options, no_regions, l, e);
    for (; ok && l->look_count < o.look_count; l->look_count++)
      l->looks[l->look_count] = vs_node_retain(o.looks[l->look_count]);
  }
  free(stack);
  if (!ok) vs_bend_drop(out);
  return ok;
}

/* ---- the map ---- */

typedef struct {
  vs_vec3 corner[8]; /* corner[i]: position to which corner i of the child's bounds is mapped; bits 0, 1 and 2 of i
                      * select the high end along x, y and z */
  vs_bounds from;
  double tolerance;
} hexahedron;

static void corners_of(const struct vs_deform *d, vs_vec3 out[8]) {
  const vs_vec3 at[8] = { d->c000, d->c100, d->c010, d->c110, d->c001, d->c101, d->c011, d->c111 };
  memcpy(out, at, sizeof at);
}

static double part(double x, double low, double high) { return high > low ? (x - low) / (high - low) : 0; }
static vs_vec3 between(vs_vec3 a, vs_vec3 b, double t) { return vs_v3_add(a, vs_v3_scale(vs_v3_sub(b, a), t)); }

static vs_vec3 mapped(const hexahedron *h, vs_vec3 p) {
  double u = part(p.x, h->from.min.x, h->from.max.x), v = part(p.y, h->from.min.y, h->from.max.y);
  double w = part(p.z, h->from.min.z, h->from.max.z);
  const vs_vec3 *c = h->corner;
  return between(between(between(c[0], c[1], u), between(c[2], c[3], u), v),
                 between(between(c[4], c[5], u), between(c[6], c[7], u), v), w);
}

static double size_of(const vs_vec3 c[8]) {
  vs_bounds all = vs_bounds_empty();
  for (int i = 0; i < 8; i++) vs_bounds_add(&all, c[i]);
  return vs_bounds_diagonal(&all);
}

bool vs_deform_is_affine(const struct vs_deform *d, const vs_bounds *bounds, vs_affine *out) {
  vs_vec3 c[8];
  corners_of(d, c);
  double size = size_of(c);
  vs_vec3 x = vs_v3_sub(c[1], c[0]), y = vs_v3_sub(c[2], c[0]), z = vs_v3_sub(c[4], c[0]);
  for (int i = 0; i < 8; i++) {
    vs_vec3 at = c[0];
    if (i & 1) at = vs_v3_add(at, x);
    if (i & 2) at = vs_v3_add(at, y);
    if (i & 4) at = vs_v3_add(at, z);
    if (vs_v3_length(vs_v3_sub(at, c[i])) > 1e-9 * size) return false;
  }
  if (!(fabs(vs_v3_dot(vs_v3_cross(x, y), z)) > 1e-12 * size * size * size)) return false;
  vs_vec3 e = vs_v3_sub(bounds->max, bounds->min);
  *out = vs_affine_columns(vs_v3_scale(x, e.x > 0 ? 1 / e.x : 1), vs_v3_scale(y, e.y > 0 ? 1 / e.y : 1),
                           vs_v3_scale(z, e.z > 0 ? 1 / e.z : 1), vs_v3(0, 0, 0));
  vs_vec3 at = vs_v3_sub(c[0], vs_affine_vector(out, bounds->min));
  out->m[0][3] = at.x, out->m[1][3] = at.y, out->m[2][3] = at.z;
  return true;
}

/* ---- the cache of deformed shapes ---- */

typedef struct {
  vs_bounds bounds;
  vs_bend_leaves leaves;
  bool apart; /* true if the object to deform has already been divided into leaves */
} subject;

typedef struct {
  int64_t key[24];
  size_t subject;
  vs_node *node; /* deformed node, to which the entry holds a reference; NULL: the slot is free */
} shape;

struct vs_deformer {
  vs_store *store;
  const vs_fineness *facets;
  const vs_kernel_options *options;
  vs_nodemap children; /* maps a child to its number in the list of objects to deform, plus 1 */
  subject *subjects;
  vs_node **held; /* nodes of the objects to deform; the deformer holds a reference to each */
  size_t subject_count, subject_room, held_room;
  shape *shapes; /* hash table of the deformed shapes; its number of slots is a power of two */
  size_t shape_count, shape_room;
};

vs_deformer *vs_deformer_new(vs_store *s, const vs_fineness *facets, const vs_kernel_options *options) {
  vs_deformer *d = NULL;
  size_t room = 0;
  if (!VS_GROW(d, room, 1)) return NULL;
  *d = (vs_deformer){ .store = s, .facets = facets, .options = options, .children = { .store = s } };
  return d;
}

void vs_deformer_free(vs_deformer *d) {
  if (!d) return;
  for (size_t i = 0; i < d->subject_count; i++) vs_bend_drop(&d->subjects[i].leaves), vs_node_release(d->held[i]);
  for (size_t i = 0; i < d->shape_room; i++) vs_node_release(d->shapes[i].node);
  vs_nodemap_free(&d->children);
  free(d->subjects), free(d->held), free(d->shapes);
  free(d);
}

/* Returns the number of the child in the list of objects to deform, or SIZE_MAX on failure, with e set. */
static size_t subject_of(vs_deformer *d, vs_ref child, vs_error *e) {
  const uint64_t *known = vs_nodemap_get(&d->children, child.node);
  if (known) return (size_t)*known - 1;
  size_t i = d->subject_count;
  vs_bounds bounds;
  if (!vs_node_bounds(child.node, &bounds, e)) return SIZE_MAX;
  uint64_t *place = NULL;
  if (VS_GROW(d->subjects, d->subject_room, i + 1) && VS_GROW(d->held, d->held_room, i + 1))
    place = vs_nodemap_put(&d->children, child.node, NULL);
  if (!place) return vs_error_memory(e, child.origin), SIZE_MAX;
  d->subjects[i] = (subject){ .bounds = bounds };
  d->held[i] = vs_node_retain(child.node);
  *place = ++d->subject_count;
  return i;
}

static uint64_t key_hash(const shape *s) {
  uint64_t h = s->subject + 1;
  for (int i = 0; i < 24; i++) {
    h = (h ^ (uint64_t)s->key[i]) * UINT64_C(0x9E3779B97F4A7C15);
    h ^= h >> 29;
  }
  return h;
}

static shape *shape_slot(shape *table, size_t room, const shape *want) {
  size_t k = (size_t)key_hash(want) & (room - 1);
  while (table[k].node && (table[k].subject != want->subject || memcmp(table[k].key, want->key, sizeof want->key)))
    k = (k + 1) & (room - 1);
  return &table[k];
}

static bool shape_room(vs_deformer *d) {
  if (2 * (d->shape_count + 1) < d->shape_room) return true;
  size_t room = d->shape_room ? 2 * d->shape_room : 64, grown = 0;
  shape *table = NULL;
  if (!vs_room_grow(&table, &grown, room, sizeof *table)) return false;
  memset(table, 0, room * sizeof *table);
  for (size_t i = 0; i < d->shape_room; i++)
    if (d->shapes[i].node) *shape_slot(table, room, &d->shapes[i]) = d->shapes[i];
  free(d->shapes);
  d->shapes = table, d->shape_room = room;
  return true;
}

/* ---- nodes ---- */

static vs_node *leaf_node(const vs_deformer *d, const hexahedron *h, const vs_bend_leaf *l, bool mirrored,
                          vs_error *e) {
  vs_bending *b = vs_bending_new(l, h->tolerance, INFINITY, HALVINGS);
  vs_vec3 *images = NULL;
  size_t room = 0, count;
  const vs_vec3 *at;
  vs_node *n = NULL;
  bool ok = b != NULL || vs_error_memory(e, l->origin);
  while (ok && (at = vs_bending_wanted(b, &count), count)) {
    ok = vs_store_going(d->store, (uint32_t)(count < 1000000 ? 64 * count : 64000000), e);
    if (!ok) break;
    ok = VS_GROW(images, room, count);
    for (size_t i = 0; ok && i < count; i++) images[i] = mapped(h, at[i]);
    ok = (ok && vs_bending_give(b, images)) || vs_error_memory(e, l->origin);
  }
  if (ok) {
    vs_mesh *m = vs_bending_mesh(b);
    bool solid = l->closed && !l->curve;
    if (mirrored) vs_mesh_turn(m, 0);
    ok = !solid || vs_mesh_without_overlaps(m, d->options, e); /* a hexahedron may be folded, so the deformed mesh may
                                                                * overlap itself; these overlaps are removed */
    if (ok && !(n = vs_bend_node(d->store, l, m))) vs_error_memory(e, l->origin);
  }
  vs_bending_free(b);
  free(images);
  return n;
}

static vs_node *all_leaves(const vs_deformer *d, const hexahedron *h, const vs_bend_leaves *leaves, bool mirrored,
                           vs_error *e) {
  vs_ref *refs = NULL;
  size_t made = 0, room = 0;
  bool ok = VS_GROW(refs, room, leaves->count + 1) || vs_error_memory(e, NULL);
  for (; ok && made < leaves->count; made++) {
    refs[made] = (vs_ref){ leaf_node(d, h, &leaves->at[made], mirrored, e), leaves->at[made].origin };
    if (!refs[made].node) ok = false, made--;
  }
  vs_node *n = NULL;
  if (ok && !(n = made == 1 ? vs_node_retain(refs[0].node)
                            : vs_node_new(d->store, VS_UNION, &(struct vs_union){ 0 }, refs, made)))
    vs_error_memory(e, NULL);
  for (size_t i = 0; i < made; i++) vs_node_release(refs[i].node);
  free(refs);
  return n;
}

/* Returns a frame that moves and rotates with the hexahedron of the corners c. sx, sy: its sides along x and y. If a
 * hexahedron is a moved or rotated copy of another, both have the same coordinates in their frames. */
static vs_affine frame_of(const vs_vec3 c[8], vs_vec3 sx, vs_vec3 sy) {
  vs_vec3 fx = vs_v3_unit(sx), fz = vs_v3_unit(vs_v3_cross(sx, sy));
  vs_affine back, frame = vs_affine_columns(fx, vs_v3_cross(fz, fx), fz, c[0]);
  bool flat = vs_v3_length(fx) == 0 || vs_v3_length(fz) == 0 || !vs_affine_invert(&frame, &back);
  return flat ? vs_affine_translation(c[0]) : frame;
}

static vs_vec3 axis_of(const vs_vec3 c[8], int bit) {
  vs_vec3 sum = vs_v3(0, 0, 0);
  for (int i = 0; i < 8; i++)
    if (!(i & bit)) sum = vs_v3_add(sum, vs_v3_sub(c[i | bit], c[i]));
  return sum;
}

static vs_node *placed(vs_deformer *d, const vs_affine *m, vs_ref ref, vs_error *e) {
  vs_node *n = vs_node_new(d->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = *m }, &ref, 1);
  if (!n) vs_error_memory(e, ref.origin);
  return n;
}

vs_node *vs_deformer_apply(vs_deformer *d, const struct vs_deform *deform, vs_ref child, vs_error *e) {
  size_t number = subject_of(d, child, e);
  if (number == SIZE_MAX) return NULL;
  subject *sub = &d->subjects[number];
  hexahedron h = { .from = sub->bounds };
  vs_affine frame, back;
  vs_vec3 at[8];
  if (vs_bounds_is_empty(&sub->bounds)) return vs_node_retain(child.node);
  if (vs_deform_is_affine(deform, &sub->bounds, &frame)) return placed(d, &frame, child, e);
  corners_of(deform, at);
  vs_vec3 sx = axis_of(at, 1), sy = axis_of(at, 2), sz = axis_of(at, 4);
  frame = frame_of(at, sx, sy);
  vs_affine_invert(&frame, &back);
  double size = size_of(at), asked = d->facets->tolerance;
  h.tolerance = asked > 0 ? fmax(asked, size / FINEST) : size / USUAL;
  shape want = { .subject = number };
  double step = size > 0 ? pow(10, floor(log10(size)) - 9) : 1;
  for (int i = 0; i < 8; i++) {
    vs_vec3 q = h.corner[i] = vs_affine_point(&back, at[i]);
    want.key[3 * i] = (int64_t)floor(q.x / step + .5), want.key[3 * i + 1] = (int64_t)floor(q.y / step + .5);
    want.key[3 * i + 2] = (int64_t)floor(q.z / step + .5);
  }
  if (!shape_room(d)) return vs_error_memory(e, child.origin), NULL;
  shape *slot = shape_slot(d->shapes, d->shape_room, &want);
  if (!slot->node) {
    vs_fineness own = { .segments = d->facets->segments };
    if (!sub->apart && !vs_take_apart(child, &own, d->options,
                                      "a hexahedron deforms solids, surfaces and curves, not regions: do-extrude them",
                                      &sub->leaves, e))
      return NULL;
    sub->apart = true;
    want.node = all_leaves(d, &h, &sub->leaves, vs_v3_dot(vs_v3_cross(sx, sy), sz) < 0, e);
    if (!want.node) return NULL;
    *slot = want;
    d->shape_count++;
  }
  return placed(d, &frame, (vs_ref){ slot->node, child.origin }, e);
}
