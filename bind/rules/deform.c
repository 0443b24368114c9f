/* Owns objects deformed by hexahedra (deform.h).
 *
 * Plan: the object is taken apart into leaves with their looks; each leaf is a mesh in the object's coordinates. For a
 * hexahedron its edges are cut in half where the middle would lie further from the chord than the tolerance, decided by
 * the edge's ends alone, so that neighbours agree; then corners are mapped, and corners that became one are joined. */
#include "bind/rules/deform.h"

#include <stdlib.h>
#include <string.h>

#include "bind/rules/derivation.h"
#include "geometry/files/polyface.h"
#include "model/store/array.h"
#include "solids/solid_meshes.h"

enum { LOOKS = 8, PLACED = 256, HALVINGS = 6, CORNERS_MOST = 4000000 };

typedef struct {
  vs_mesh mesh; /* a curve has its points alone */
  bool curve, closed;
  vs_node *looks[LOOKS]; /* outermost first; retained */
  int look_count;
} leaf;

typedef struct {
  int64_t key[24];
  vs_node *object, *node;
} placed; /* retained both; node NULL: free */

struct vs_deformer {
  vs_bind *bind;
  vs_node *object; /* whose leaves these are; retained */
  leaf *leaves;
  size_t count, room;
  placed at[PLACED];
};

static void leaves_drop(vs_deformer *d) {
  for (size_t i = 0; i < d->count; i++) {
    vs_mesh_free(&d->leaves[i].mesh);
    for (int k = 0; k < d->leaves[i].look_count; k++) vs_node_release(d->leaves[i].looks[k]);
  }
  d->count = 0;
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
  free(d->leaves);
  for (int i = 0; i < PLACED; i++) vs_node_release(d->at[i].node), vs_node_release(d->at[i].object);
  vs_store_realloc(d->bind->store, d, sizeof *d, 0);
}

/* ---- the object's leaves ---- */

typedef struct {
  vs_ref ref;
  vs_affine map;
  vs_node *looks[LOOKS];
  int look_count;
} open_node;

static bool fail(vs_bind *b, const vs_error *e) {
  if (e->kind == VS_ERROR_INTERRUPT) return false;
  if (e->kind == VS_ERROR_MEMORY) return vs_fail_memory(b->vm);
  return vs_fail(b->vm, b->vm->sym.error, "%s", e->message);
}

static bool mesh_leaf(vs_deformer *d, vs_ref ref, const vs_affine *map, leaf *l) {
  vs_bind *b = d->bind;
  vs_node *n = ref.node;
  vs_error e = { 0 };
  vs_facets facets = vs_rules_facets(b, n);
  bool ok = true;
  if (n->class_ == VS_SOLID) {
    vs_solid solid = { 0 };
    vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
    if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e)) return fail(b, &e);
    l->mesh = solid.mesh, l->closed = true;
    solid.mesh = (vs_mesh){ 0 };
    vs_solid_free(&solid);
  } else if (n->class_ == VS_SURFACE) {
    if (!vs_tessellate(n, &facets, &l->mesh, &e)) return fail(b, &e);
  } else if (n->class_ == VS_CURVE) {
    vs_polyline p = { 0 };
    if (!vs_curve_sample(n, &facets, &p, &e)) return fail(b, &e);
    l->curve = true, l->closed = p.closed;
    for (size_t i = 0; ok && i < p.count; i++) ok = vs_mesh_add_vertex(&l->mesh, p.at[i], NULL);
    vs_polyline_free(&p);
  } else {
    return vs_fail(b->vm, b->vm->sym.type,
                   "a hexahedron deforms solids, surfaces and curves, not regions: do-extrude them");
  }
  if (!ok) return vs_fail_memory(b->vm);
  vs_mesh_transform(&l->mesh, map);
  return true;
}

static bool take_apart(vs_deformer *d, vs_ref object) {
  open_node *stack = NULL;
  size_t count = 0, room = 0;
  bool ok = VS_GROW(stack, room, 1) || vs_fail_memory(d->bind->vm);
  if (ok) stack[count++] = (open_node){ .ref = object, .map = vs_affine_identity() };
  leaves_drop(d);
  while (ok && count) {
    open_node o = stack[--count];
    vs_node *n = o.ref.node;
    if (n->class_ == VS_NOTHING) continue;
    if (n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_dress(n)) {
      if (n->kind == VS_TRANSFORM) o.map = vs_affine_multiply(&o.map, &VS_AS(transform, n)->matrix);
      bool look = n->kind == VS_MATERIAL || n->kind == VS_LAYER;
      if (look && o.look_count < LOOKS) o.looks[o.look_count++] = n;
      ok = VS_GROW(stack, room, count + n->child_count) || vs_fail_memory(d->bind->vm);
      for (uint32_t i = n->child_count; ok && i-- > 0;) o.ref = n->children[i], stack[count++] = o;
      continue;
    }
    ok = VS_GROW(d->leaves, d->room, d->count + 1) || vs_fail_memory(d->bind->vm);
    if (!ok) break;
    leaf *l = &d->leaves[d->count++];
    *l = (leaf){ 0 };
    ok = mesh_leaf(d, o.ref, &o.map, l);
    for (; ok && l->look_count < o.look_count; l->look_count++)
      l->looks[l->look_count] = vs_node_retain(o.looks[l->look_count]);
  }
  free(stack);
  if (ok)
    d->object = vs_node_retain(object.node);
  else
    leaves_drop(d);
  return ok;
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

/* ---- cutting edges in half ---- */

typedef struct {
  uint64_t edge;
  uint32_t middle;
} half; /* edge 0: free; middle UINT32_MAX: the edge stays */

static half *half_of(half *table, size_t size, uint64_t edge) {
  size_t k = (size_t)((edge * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (size - 1);
  while (table[k].edge && table[k].edge != edge) k = (k + 1) & (size - 1);
  return &table[k];
}

/* The middle of an edge, made where it is wanted. False: out of memory. */
static bool middle_of(const hexahedron *h, vs_mesh *m, half *table, size_t size, uint32_t a, uint32_t b,
                      uint32_t *out) {
  uint64_t edge = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a; /* never 0: a and b differ */
  half *at = half_of(table, size, edge);
  if (!at->edge) {
    vs_vec3 p = m->vertices[a], q = m->vertices[b], r = vs_v3_scale(vs_v3_add(p, q), .5);
    vs_vec3 chord = vs_v3_scale(vs_v3_add(mapped(h, p), mapped(h, q)), .5);
    at->edge = edge, at->middle = UINT32_MAX;
    if (vs_v3_length(vs_v3_sub(mapped(h, r), chord)) > h->tolerance && !vs_mesh_add_vertex(m, r, &at->middle))
      return false;
  }
  *out = at->middle;
  return true;
}

/* One round: every triangle with edges to be cut becomes two, three or four. *cut: was there any? */
static bool halve(const hexahedron *h, vs_mesh *m, bool *cut) {
  size_t size = 64, n = m->triangle_count;
  *cut = false;
  while (size < 6 * n) size *= 2;
  half *table = calloc(size, sizeof *table);
  bool ok = table != NULL;
  for (size_t i = 0; ok && i < n; i++) {
    uint32_t t[3], e[3];
    memcpy(t, m->triangles[i], sizeof t);
    for (int k = 0; ok && k < 3; k++) ok = middle_of(h, m, table, size, t[k], t[(k + 1) % 3], &e[k]);
    if (!ok) break;
    int cuts = (e[0] != UINT32_MAX) + (e[1] != UINT32_MAX) + (e[2] != UINT32_MAX);
    if (!cuts) continue;
    *cut = true;
    while ((cuts == 1 && e[0] == UINT32_MAX) ||
           (cuts == 2 && e[2] != UINT32_MAX)) { /* 1: edge 0 is cut; 2: edge 2 is not */
      uint32_t t0 = t[0], e0 = e[0];
      t[0] = t[1], t[1] = t[2], t[2] = t0;
      e[0] = e[1], e[1] = e[2], e[2] = e0;
    }
    uint32_t *self = m->triangles[i];
    if (cuts == 1) {
      self[0] = t[0], self[1] = e[0], self[2] = t[2];
      ok = vs_mesh_add_triangle(m, e[0], t[1], t[2]);
    } else if (cuts == 2) {
      self[0] = e[0], self[1] = t[1], self[2] = e[1];
      ok = vs_mesh_add_triangle(m, t[0], e[0], e[1]) && vs_mesh_add_triangle(m, t[0], e[1], t[2]);
    } else {
      self[0] = e[0], self[1] = e[1], self[2] = e[2];
      ok = vs_mesh_add_triangle(m, t[0], e[0], e[2]) && vs_mesh_add_triangle(m, e[0], t[1], e[1]) &&
           vs_mesh_add_triangle(m, e[2], e[1], t[2]);
    }
  }
  free(table);
  return ok;
}

static bool copy_mesh(const vs_mesh *from, vs_mesh *to) {
  if (!vs_mesh_reserve(to, from->vertex_count, from->triangle_count)) return false;
  memcpy(to->vertices, from->vertices, from->vertex_count * sizeof *to->vertices);
  if (from->triangle_count) memcpy(to->triangles, from->triangles, from->triangle_count * sizeof *to->triangles);
  to->vertex_count = from->vertex_count, to->triangle_count = from->triangle_count;
  return true;
}

/* ---- nodes ---- */

static vs_node *mesh_node(vs_bind *b, const vs_mesh *m, bool closed) {
  vs_store *s = b->store;
  uint32_t *place = malloc((m->vertex_count + 1) * sizeof *place), *number = NULL, *start = NULL, *corner = NULL;
  vs_vec3 *kept = NULL;
  vs_node *n = NULL;
  size_t faces = 0, points = 0;
  vs_points *p = NULL;
  vs_faces *f = NULL;
  if (!place || !vs_polyface_merge(m->vertices, m->vertex_count, place)) goto done;
  number = malloc((m->vertex_count + 1) * sizeof *number);
  start = malloc((m->triangle_count + 1) * sizeof *start);
  corner = malloc((3 * m->triangle_count + 1) * sizeof *corner);
  kept = malloc((m->vertex_count + 1) * sizeof *kept);
  if (!number || !start || !corner || !kept) goto done;
  memset(number, 0xFF, (m->vertex_count + 1) * sizeof *number);
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    uint32_t c[3] = { place[t[0]], place[t[1]], place[t[2]] };
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (int k = 0; k < 3; k++) {
      if (number[c[k]] == UINT32_MAX) number[c[k]] = (uint32_t)points, kept[points++] = m->vertices[c[k]];
      corner[3 * faces + (size_t)k] = number[c[k]];
    }
    faces++;
  }
  for (size_t i = 0; i <= faces; i++) start[i] = (uint32_t)(3 * i);
  if (!faces) {
    n = vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
    goto done;
  }
  p = vs_points_new(s, kept, points);
  f = p ? vs_faces_new(s, start, faces, corner, 3 * faces) : NULL;
  if (f)
    n = vs_node_new(s, VS_POLYFACE_MESH, &(struct vs_polyface_mesh){ .points = p, .faces = f, .closed = closed }, NULL,
                    0);
done:
  if (f) vs_faces_release(s, f);
  if (p) vs_points_release(s, p);
  free(place), free(number), free(start), free(corner), free(kept);
  return n;
}

static vs_node *leaf_node(vs_deformer *d, const hexahedron *h, const leaf *l, bool mirrored) {
  vs_store *s = d->bind->store;
  vs_mesh m = { 0 };
  bool cut = true, ok = copy_mesh(&l->mesh, &m);
  for (int i = 0; ok && cut && i < HALVINGS && m.vertex_count < CORNERS_MOST; i++) ok = halve(h, &m, &cut);
  for (size_t i = 0; ok && i < m.vertex_count; i++) m.vertices[i] = mapped(h, m.vertices[i]);
  if (ok && mirrored) vs_mesh_turn(&m, 0);
  vs_node *n = NULL;
  if (ok && l->curve) {
    vs_points *p = vs_points_new(s, m.vertices, m.vertex_count);
    if (p)
      n = vs_node_new(s, VS_LINE, &(struct vs_line){ .points = p, .closed = l->closed }, NULL, 0),
      vs_points_release(s, p);
  } else if (ok) {
    n = mesh_node(d->bind, &m, l->closed);
  }
  vs_mesh_free(&m);
  for (int i = l->look_count; n && i-- > 0;) {
    vs_ref child = { n, NULL };
    vs_node *dressed = vs_node_new(s, (vs_kind)l->looks[i]->kind, vs_node_data(l->looks[i]), &child, 1);
    vs_node_release(n);
    n = dressed;
  }
  return n;
}

static vs_node *all_leaves(vs_deformer *d, const hexahedron *h, bool mirrored) {
  vs_store *s = d->bind->store;
  vs_ref *refs = malloc((d->count + 1) * sizeof *refs);
  size_t made = 0;
  for (; refs && made < d->count; made++)
    if (!(refs[made] = (vs_ref){ leaf_node(d, h, &d->leaves[made], mirrored), NULL }).node) break;
  vs_node *n = NULL;
  if (refs && made == d->count)
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
