/* Tests, for rules, whether a scope touches the objects that the derivation has created so far, or lies inside them.
 *
 * A tree contains the bounds of the objects in the order of their creation. The objects of one rule are close together.
 * Sixteen consecutive objects therefore have a common box, sixteen such boxes a larger box, and so forth. Where bounds
 * overlap, the test is exact. A scope consists of convex pieces: one for a box, six tetrahedra for a hexahedron, a flat
 * piece for each triangle of a polygon or mesh and for each segment of a curve. A triangle of an object touches the
 * scope if a part of the triangle remains after it is cut by the planes of a piece. A scope that no triangle touches
 * lies completely inside or outside the object, so that testing one point suffices. The same is true of an object and a
 * scope that is a closed mesh. */
#include "bind/rules/surroundings.h"

#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/raise.h"
#include "bind/measures.h"
#include "bind/rules/derivation.h"

#include <stdlib.h>
#include <string.h>

#include "bind/state.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/ear_clipping.h"

enum { FAN = 16, LEVELS = 8, KEPT = 32 };

struct vs_surroundings {
  vs_bind *bind;
  struct {
    vs_bounds *at;
    size_t count, room;
  } level[LEVELS]; /* level[0] contains the bounds of each object, level[i + 1] the boxes around sixteen elements of
                    * level[i] */
  struct {
    vs_node *node;     /* node of the object, retained, or NULL */
    vs_node *resolved; /* the object after its sections and shadows were computed (solids/resolve.h), retained */
    vs_bend_leaves leaves;
  } kept[KEPT]; /* cache of objects with their triangles, indexed by the node's address */
};

static void drop_one(vs_surroundings *a, size_t i) {
  if (!a->kept[i].node) return;
  vs_bend_drop(&a->kept[i].leaves);
  vs_node_release(a->kept[i].node);
  vs_node_release(a->kept[i].resolved);
}

static void drop_kept(vs_surroundings *a) {
  for (int i = 0; i < KEPT; i++)
    drop_one(a, (size_t)i);
}

void vs_surroundings_free(vs_surroundings *a) {
  if (!a) return;
  vs_store *s = a->bind->store;
  for (int i = 0; i < LEVELS; i++) vs_store_realloc(s, a->level[i].at, a->level[i].room * sizeof *a->level[i].at, 0);
  drop_kept(a);
  vs_store_realloc(s, a, sizeof *a, 0);
}

static vs_surroundings *surroundings_of(vs_derivation *d) {
  vs_surroundings *a = d->around;
  if (a) return a;
  if (!(a = vs_store_realloc(d->store, NULL, 0, sizeof *a))) return (void)vs_fail_memory(d->vm), NULL;
  memset(a, 0, sizeof *a);
  a->bind = d->bind;
  return d->around = a;
}

/* ---- the scope as convex pieces ---- */

typedef struct {
  vs_vec3 normal;
  double at;
} half_space; /* contains the points p with normal · p <= at; the normal has unit length */
typedef struct {
  half_space side[6];
  int count, paired; /* count: number of half-spaces (sides) of the piece; the first `paired` sides are pairs with
                      * opposite normals */
  vs_vec3 triangle[3]; /* corners of the triangle, if the piece is flat */
} piece;
typedef struct {
  vs_store *store;
  vs_bounds bounds;
  vs_vec3 corner[8]; /* corners of the box around the scope */
  vs_vec3 point;     /* a point in the scope */
  double slack;      /* distances below this length count as 0 */
  piece own[6];
  piece *flat; /* flat pieces of a polygon, curve or mesh, which replace the pieces in `own`; owned by the store */
  size_t count, room;
  vs_node *solid; /* a closed mesh, whose inside belongs to the scope, or NULL */
} body;
static const piece *pieces_of(const body *b) { return b->flat ? b->flat : b->own; }
static void body_drop(body *b) {
  if (b->flat) vs_store_realloc(b->store, b->flat, b->room * sizeof *b->flat, 0);
  vs_node_release(b->solid);
}

static half_space half_space_of(vs_vec3 normal, vs_vec3 at) {
  return (half_space){ normal, vs_v3_dot(normal, at) };
}

/* Adds a piece for the box of the scope's frame, which may have size 0 along an axis. */
static void box_piece(body *b, const vs_scope *s) {
  vs_affine m = vs_scope_frame(s);
  piece *p = &b->own[b->count++];
  p->paired = 6;
  for (int a = 0; a < 3; a++) {
    vs_vec3 along = vs_affine_column(&m, a);
    vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_affine_column(&m, (a + 1) % 3), vs_affine_column(&m, (a + 2) % 3)));
    if (vs_v3_dot(n, along) < 0) n = vs_v3_scale(n, -1);
    p->side[p->count++] = half_space_of(n, b->corner[7]);
    p->side[p->count++] = half_space_of(vs_v3_scale(n, -1), b->corner[0]);
  }
}

/* Adds pieces for a hexahedron: the six tetrahedra that have the diagonal from corner 0 to corner 7 in common. Omits
 * flat tetrahedra. */
static void tetrahedra(body *b) {
  static const int way[6][2] = { { 1, 3 }, { 1, 5 }, { 2, 3 }, { 2, 6 }, { 4, 5 }, { 4, 6 } };
  for (int t = 0; t < 6; t++) {
    const vs_vec3 p[4] = { b->corner[0], b->corner[way[t][0]], b->corner[way[t][1]], b->corner[7] };
    piece tetrahedron = { .count = 0 };
    bool thick = true;
    for (int i = 0; i < 4; i++) {
      vs_vec3 q = p[(i + 1) % 4];
      vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_v3_sub(p[(i + 2) % 4], q), vs_v3_sub(p[(i + 3) % 4], q)));
      double height = vs_v3_dot(n, vs_v3_sub(p[i], q));
      if (fabs(height) <= b->slack) thick = false;
      tetrahedron.side[tetrahedron.count++] = half_space_of(height > 0 ? vs_v3_scale(n, -1) : n, q);
    }
    if (thick) b->own[b->count++] = tetrahedron;
  }
}

/* Adds a flat piece: a triangle, or a segment if two of its corners are equal. */
static bool add_flat(body *b, const vs_vec3 t[3]) {
  vs_vec3 x = vs_v3_sub(t[1], t[0]), z = vs_v3_cross(x, vs_v3_sub(t[2], t[0]));
  bool line = vs_v3_length(z) <= b->slack * b->slack;
  if (line && vs_v3_length(x) == 0) x = vs_v3_sub(t[2], t[0]);
  if (line && vs_v3_length(x) == 0) return true;
  if (!vs_store_grow(b->store, &b->flat, &b->room, b->count + 1, sizeof *b->flat)) return false;
  piece *p = &b->flat[b->count++];
  *p = (piece){ .triangle = { t[0], t[1], t[2] } };
  vs_vec3 ux = vs_v3_unit(x);
  if (line) { /* a segment has two pairs of sides parallel to it, and a pair across its ends */
    vs_vec3 away = fabs(ux.x) < .6 ? vs_v3(1, 0, 0) : vs_v3(0, 1, 0), uy = vs_v3_unit(vs_v3_cross(ux, away));
    vs_vec3 uz = vs_v3_cross(ux, uy), end = vs_v3_length(vs_v3_sub(t[1], t[0])) > 0 ? t[1] : t[2];
    const vs_vec3 across[2] = { uy, uz };
    for (int k = 0; k < 2; k++) {
      p->side[p->count++] = half_space_of(across[k], t[0]);
      p->side[p->count++] = half_space_of(vs_v3_scale(across[k], -1), t[0]);
    }
    p->side[p->count++] = half_space_of(ux, end);
    p->side[p->count++] = half_space_of(vs_v3_scale(ux, -1), t[0]);
    p->paired = 6;
    return true;
  }
  vs_vec3 n = vs_v3_unit(z);
  p->side[p->count++] = half_space_of(n, t[0]);
  p->side[p->count++] = half_space_of(vs_v3_scale(n, -1), t[0]);
  p->paired = 2;
  for (int k = 0; k < 3; k++)
    p->side[p->count++] = half_space_of(vs_v3_unit(vs_v3_cross(vs_v3_sub(t[(k + 1) % 3], t[k]), n)), t[k]);
  return true;
}

static bool polygon_pieces(body *b, const vs_scope *s) {
  const vs_scope_loops *l = s->loops;
  vs_affine back;
  vs_mesh m = { 0 };
  size_t n = l->points->count;
  vs_vec2 *flat = vs_store_realloc(b->store, NULL, 0, n * sizeof *flat);
  size_t *sizes = vs_store_realloc(b->store, NULL, 0, l->count * sizeof *sizes);
  uint32_t *index = vs_store_realloc(b->store, NULL, 0, n * sizeof *index);
  bool ok = flat && sizes && index && vs_affine_invert(&s->as.box.frame, &back);
  for (uint32_t i = 0; ok && i < n; i++) {
    vs_vec3 p = vs_affine_point(&back, l->points->at[i]);
    flat[i] = (vs_vec2){ p.x, p.y }, index[i] = i;
  }
  for (uint32_t i = 0; ok && i < l->count; i++) sizes[i] = l->start[i + 1] - l->start[i];
  ok = ok && vs_triangulate(flat, sizes, l->count, &m, index, false);
  for (size_t i = 0; ok && i < m.triangle_count; i++) {
    vs_vec3 t[3];
    for (int k = 0; k < 3; k++) t[k] = l->points->at[m.triangles[i][k]];
    ok = add_flat(b, t);
  }
  vs_mesh_free(&m);
  if (flat) vs_store_realloc(b->store, flat, n * sizeof *flat, 0);
  if (sizes) vs_store_realloc(b->store, sizes, l->count * sizeof *sizes, 0);
  if (index) vs_store_realloc(b->store, index, n * sizeof *index, 0);
  return ok;
}

static bool curve_pieces(body *b, const vs_scope *s) {
  size_t n = s->loops->points->count;
  const vs_vec3 *at = s->loops->points->at;
  bool ok = true;
  for (size_t i = 0; ok && i + (s->closed ? 0 : 1) < n; i++) {
    const vs_vec3 t[3] = { at[i], at[(i + 1) % n], at[(i + 1) % n] };
    ok = add_flat(b, t);
  }
  return ok;
}

/* Adds pieces for the faces of the object of a mesh or surface scope. If it fails, returns false, and sets *set to true
 * if the VM's error is set. */
static bool object_pieces(vs_bind *bind, body *b, const vs_scope *s, bool *set) {
  vs_bend_leaves leaves;
  vs_ref object = { vs_node_retain(s->object.node), s->object.origin };
  bool ok = vs_bend_resolve(bind->vm, &object) && vs_bend_take_apart(bind->vm, object, NULL, &leaves);
  *set = !ok;
  for (size_t i = 0; ok && i < leaves.count; i++)
    for (size_t k = 0; ok && k < leaves.at[i].mesh.triangle_count; k++) {
      const vs_mesh *m = &leaves.at[i].mesh;
      const uint32_t *c = m->triangles[k];
      const vs_vec3 t[3] = { m->vertices[c[0]], m->vertices[c[1]], m->vertices[c[2]] };
      ok = add_flat(b, t);
    }
  if (!*set) vs_bend_drop(&leaves);
  if (ok && object.node->class_ == VS_SOLID) b->solid = object.node;
  else vs_node_release(object.node);
  return ok;
}

/* Sets *b to the pieces of a scope; the caller frees them. If it fails, sets the error and returns false. */
static bool body_of(vs_bind *bind, const vs_scope *s, body *b) {
  *b = (body){ .store = bind->store, .bounds = vs_bounds_empty() };
  vs_scope_corners(s, b->corner);
  for (int i = 0; i < 8; i++) vs_bounds_add(&b->bounds, b->corner[i]);
  double reach = vs_v3_length(b->bounds.min) + vs_v3_length(b->bounds.max);
  b->slack = 1e-9 * (reach > 0 ? reach : 1);
  bool ok = true, set = false;
  if (s->class_ == VS_SCOPE_FFD || s->class_ == VS_SCOPE_TURTLE) tetrahedra(b);
  if (s->class_ == VS_SCOPE_POLYGON || s->class_ == VS_SCOPE_TRIANGLE) ok = polygon_pieces(b, s);
  if (s->class_ == VS_SCOPE_CURVE) ok = curve_pieces(b, s);
  if (s->class_ == VS_SCOPE_MESH || s->class_ == VS_SCOPE_SURFACE) ok = object_pieces(bind, b, s, &set);
  if (ok && !b->count) box_piece(b, s);
  b->point = b->flat ? b->flat[0].triangle[0] : b->corner[0];
  if (!ok) body_drop(b);
  return ok || set ? ok : vs_fail_memory(bind->vm);
}

/* Returns true if a part of the triangle lies in the piece. The sides of the piece are first moved outwards by slack
 * (inwards if slack is negative). Pairs of sides that are too close to each other are not moved inwards. */
static bool triangle_meets(const piece *p, const vs_vec3 triangle[3], double slack) {
  vs_vec3 corner[2][16];
  size_t n = 3;
  int from = 0;
  memcpy(corner[0], triangle, 3 * sizeof *triangle);
  for (int k = 0; k < p->count && n; k++) {
    const half_space *h = &p->side[k];
    bool flat = k < p->paired && h->at + p->side[k ^ 1].at <= fabs(slack);
    double at = h->at + (flat ? fabs(slack) : slack), d[16];
    size_t left = 0;
    const vs_vec3 *in = corner[from];
    vs_vec3 *out = corner[1 - from];
    for (size_t i = 0; i < n; i++) d[i] = vs_v3_dot(h->normal, in[i]) - at;
    for (size_t i = 0; i < n; i++) {
      size_t next = (i + 1) % n;
      if (d[i] <= 0) out[left++] = in[i];
      if ((d[i] < 0 && d[next] > 0) || (d[i] > 0 && d[next] < 0))
        out[left++] = vs_v3_add(in[i], vs_v3_scale(vs_v3_sub(in[next], in[i]), d[i] / (d[i] - d[next])));
    }
    n = left, from = 1 - from;
  }
  return n > 0;
}

static bool body_meets(const body *b, const vs_vec3 triangle[3], double slack) {
  vs_bounds t = vs_bounds_empty();
  for (int i = 0; i < 3; i++) vs_bounds_add(&t, triangle[i]);
  if (!vs_bounds_overlap(&t, &b->bounds, fabs(slack))) return false;
  const piece *p = pieces_of(b);
  for (size_t i = 0; i < b->count; i++)
    if (triangle_meets(&p[i], triangle, slack)) return true;
  return false;
}

static bool body_holds(const body *b, vs_vec3 p) {
  const vs_vec3 point[3] = { p, p, p };
  return body_meets(b, point, b->slack);
}

static bool surfaces_touch(const body *a, const body *b) {
  double slack = fmax(a->slack, b->slack);
  if (!vs_bounds_overlap(&a->bounds, &b->bounds, slack)) return false;
  if (body_holds(a, b->point) || body_holds(b, a->point)) return true;
  for (size_t i = 0; b->flat && i < b->count; i++)
    if (body_meets(a, b->flat[i].triangle, slack)) return true;
  static const int face[6][4] = { { 0, 1, 3, 2 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                  { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 3, 7, 5 } };
  for (int i = 0; i < 6 && !b->flat; i++)
    for (int k = 0; k < 2; k++) { /* k = 0, 1: the two triangles into which corner 0 divides a face of the hexahedron */
      const vs_vec3 t[3] = { b->corner[face[i][0]], b->corner[face[i][1 + k]], b->corner[face[i][2 + k]] };
      if (body_meets(a, t, slack)) return true;
    }
  return false;
}

/* Sets *in to true if the point p lies inside the closed mesh of b. If it fails, sets the error and returns false. */
static bool solid_holds(vs_bind *bind, const body *b, vs_vec3 p, bool *in) {
  vs_error e = { 0 };
  if (!b->solid || vs_inside_cached(&bind->inside, b->solid, p, in, &e)) return true;
  return e.kind == VS_ERROR_INTERRUPT ? false : vs_fail(bind->vm, bind->vm->sym.error, "%s", e.message);
}

/* Sets *touch to true if the scopes a and b have a common point. If it fails, sets the error and returns false. */
static bool bodies_touch(vs_bind *bind, const body *a, const body *b, bool *touch) {
  *touch = surfaces_touch(a, b);
  if (*touch || !vs_bounds_overlap(&a->bounds, &b->bounds, fmax(a->slack, b->slack))) return true;
  return solid_holds(bind, a, b->point, touch) && (*touch || solid_holds(bind, b, a->point, touch));
}

bool vs_scopes_touch(vs_bind *bind, const vs_scope *x, const vs_scope *y, bool *touch) {
  body a, b;
  if (!body_of(bind, x, &a)) return false;
  if (!body_of(bind, y, &b)) return body_drop(&a), false;
  bool ok = bodies_touch(bind, &a, &b, touch);
  body_drop(&a), body_drop(&b);
  return ok;
}

/* ---- tests with one object ---- */

static const vs_bend_leaves *taken_apart(vs_surroundings *a, vs_ref object, vs_node **resolved) {
  size_t i = (size_t)(((uintptr_t)object.node >> 4) * UINT64_C(0x9E3779B97F4A7C15) >> 32) % KEPT;
  *resolved = a->kept[i].resolved;
  if (a->kept[i].node == object.node) return &a->kept[i].leaves;
  vs_bend_leaves leaves;
  vs_ref plain = { vs_node_retain(object.node), object.origin };
  if (!vs_bend_resolve(a->bind->vm, &plain) || !vs_bend_take_apart(a->bind->vm, plain, NULL, &leaves))
    return vs_node_release(plain.node), NULL;
  drop_one(a, i);
  a->kept[i].node = vs_node_retain(object.node), a->kept[i].leaves = leaves;
  *resolved = a->kept[i].resolved = plain.node;
  return &a->kept[i].leaves;
}

/* Returns true if a triangle of the object's part l, or a segment of its curve, touches the scope b. The sides of b are
 * first moved outwards by slack. */
static bool leaf_meets(const vs_bend_leaf *l, const vs_affine *map, const body *b, double slack) {
  const vs_mesh *m = &l->mesh;
  size_t count = !l->curve ? m->triangle_count : m->vertex_count - (l->closed ? 0 : m->vertex_count > 0);
  for (size_t i = 0; i < count; i++) {
    vs_vec3 t[3];
    for (size_t k = 0; k < 3; k++) {
      size_t corner = !l->curve ? m->triangles[i][k] : (i + (k > 0)) % m->vertex_count;
      t[k] = vs_affine_point(map, m->vertices[corner]);
    }
    if (body_meets(b, t, slack)) return true;
  }
  return false;
}

static bool leaf_point(const vs_bend_leaf *l, const vs_affine *map, vs_vec3 *out) {
  if (!l->mesh.vertex_count) return false;
  *out = vs_affine_point(map, l->mesh.vertices[0]);
  return true;
}

typedef struct {
  vs_args *f;
  body body;
  bool inside; /* true: the rule asks whether the scope lies inside an object; false: whether the scope touches an
                * object */
  const char *flag;
  bool failed;
} question;

static bool holds(question *q, const vs_node *n, vs_vec3 p) {
  bool in = false;
  vs_error e = { 0 };
  if (n->class_ != VS_SOLID || q->failed) return false;
  if (!vs_inside_cached(&q->f->bind->inside, n, p, &in, &e)) q->failed = true, vs_bind_error(q->f->vm, &e);
  return in;
}

/* Returns true if the object n contains all the points. Each point is first moved a little towards their mean, since a
 * scope may lie on the object's faces. */
static bool holds_all(question *q, const vs_node *n, const vs_affine *back, const vs_vec3 *at, int count) {
  vs_vec3 middle = vs_v3(0, 0, 0);
  for (int i = 0; i < count; i++) middle = vs_v3_add(middle, vs_v3_scale(at[i], 1.0 / count));
  bool all = true;
  for (int i = 0; i < count && all; i++) {
    vs_vec3 in = vs_v3_scale(vs_v3_unit(vs_v3_sub(middle, at[i])), 2 * q->body.slack);
    all = holds(q, n, vs_affine_point(back, vs_v3_add(at[i], in)));
  }
  return all;
}

/* Returns true if the answer is yes for this object: the scope lies inside it, or touches it, as q->inside says. */
static bool answers(question *q, vs_surroundings *a, vs_ref object) {
  vs_affine map = vs_affine_identity();
  vs_ref base = object;
  while (base.node->kind == VS_TRANSFORM) {
    map = vs_affine_multiply(&map, &VS_AS(transform, base.node)->matrix);
    base = base.node->children[0];
  }
  if (base.node->class_ == VS_NOTHING) return false;
  vs_node *resolved;
  vs_affine back;
  const vs_bend_leaves *leaves = taken_apart(a, base, &resolved);
  if (!leaves) return q->failed = true, false;
  bool flat = !vs_affine_invert(&map, &back);
  double slack = q->inside ? -q->body.slack : q->body.slack;
  bool meets = false;
  for (size_t i = 0; i < leaves->count && !meets; i++) meets = leaf_meets(&leaves->at[i], &map, &q->body, slack);
  if (!q->inside) {
    meets = meets || (!flat && holds(q, resolved, vs_affine_point(&back, q->body.point)));
    vs_vec3 at;
    for (size_t i = 0; i < leaves->count && !meets && q->body.solid; i++)
      meets = leaf_point(&leaves->at[i], &map, &at) && holds(q, q->body.solid, at);
    return meets;
  }
  for (size_t i = 0; q->body.flat && i < q->body.count && !meets; i++)
    meets = flat || !holds_all(q, resolved, &back, q->body.flat[i].triangle, 3);
  if (!q->body.flat && !meets) meets = flat || !holds_all(q, resolved, &back, q->body.corner, 8);
  return !meets && !q->failed;
}

/* ---- tests with all objects ---- */

/* Adds the objects that were created since the previous question to the tree of bounds. */
static bool catch_up(vs_derivation *d, vs_surroundings *a) {
  vs_error e = { 0 };
  for (size_t i = a->level[0].count; i < d->made_count; i++) {
    vs_bounds box;
    if (!vs_bind_bounds(d->vm, d->made[i], &box, &e))
      return vs_fail(d->vm, d->vm->sym.error, "%s", e.message);
    for (size_t level = 0, at = i; level < LEVELS; level++, at /= FAN) {
      if (at >= a->level[level].count) {
        if (!vs_store_grow(d->store, &a->level[level].at, &a->level[level].room, at + 1, sizeof box))
          return vs_fail_memory(d->vm);
        a->level[level].at[at] = vs_bounds_empty(), a->level[level].count = at + 1;
      }
      vs_bounds_unite(&a->level[level].at[at], &box);
    }
    if (!vs_poll_turn(d->vm, i, 40)) return false;
  }
  return true;
}

static bool any_answers(question *q, vs_derivation *d) {
  vs_surroundings *a = surroundings_of(d);
  if (!a || !catch_up(d, a)) return q->failed = true, false;
  int level = LEVELS - 1;
  size_t at = 0;
  /* Visits the tree in order. If the bounds of a box overlap those of the scope, enters the box. Otherwise continues
   * with the next box or, after the last box of a level, with the next box of the parent's level. */
  while (at < a->level[level].count) {
    const vs_bounds *box = &a->level[level].at[at];
    bool meet = !vs_bounds_is_empty(box) && vs_bounds_overlap(box, &q->body.bounds, q->body.slack);
    if (meet && level > 0) {
      level--, at *= FAN;
      continue;
    }
    if (meet && (!q->flag || (at < d->flags_room && vs_scope_flags_have(d->made_flags[at], q->flag))) &&
        answers(q, a, d->made[at]))
      return true;
    if (q->failed || !vs_poll(d->vm, 20)) return q->failed = true, false;
    for (at++; level < LEVELS - 1 && at % FAN == 0; at /= FAN) level++;
    while (level < LEVELS - 1 && at >= a->level[level].count) level++, at = at / FAN + 1;
  }
  return false;
}

/* Returns true if the scope touches a scope that waits for signals. Such a scope counts as an object, since it will
 * create objects at its place. */
static bool any_waits(question *q, const vs_derivation *d) {
  bool touch = false;
  for (size_t i = 0; i < d->waiting_count && !q->inside && !touch && !q->failed; i++) {
    const vs_scope *c = d->waiting[i].task->child[0];
    body other;
    if (q->flag && !vs_scope_has_flag(c, q->flag)) continue;
    if (!body_of(d->bind, c, &other)) return q->failed = true, false;
    q->failed = !bodies_touch(d->bind, &q->body, &other, &touch);
    body_drop(&other);
  }
  return touch;
}

static vs_status ask(vs_args *f, bool inside, vs_value *out) {
  question q = { .f = f, .inside = inside };
  bool yes = false;
  if (f->key[0].given && !(q.flag = vs_store_text(f->store, f->key[0].text.at, f->key[0].text.length)))
    return vs_fail_memory(f->vm);
  if (!body_of(f->bind, f->arg[0].scope, &q.body)) return VS_ERROR;
  if (f->key[1].given) {
    vs_surroundings a = { .bind = f->bind };
    yes = answers(&q, &a, f->key[1].ref);
    drop_kept(&a);
  } else
    for (vs_derivation *d = f->bind->growing; d && !yes && !q.failed; d = d->outer)
      yes = any_waits(&q, d) || (!q.failed && any_answers(&q, d));
  body_drop(&q.body);
  *out = vs_bool(yes);
  return q.failed ? VS_ERROR : VS_OK;
}

vs_status vs_p_scope_touches(vs_args *f, vs_value *out) { return ask(f, false, out); }
vs_status vs_p_scope_is_inside(vs_args *f, vs_value *out) { return ask(f, true, out); }

/* (scope-overlap s other): returns #f, or two points in the coordinates of s. They are opposite corners of a box: the
 * intersection of the box of s with the bounds of `other` along the axes of s. */
vs_status vs_p_scope_overlap(vs_args *f, vs_value *out) {
  vs_affine frame = vs_scope_frame(f->arg[0].scope), back;
  vs_vec3 size = vs_scope_size(f->arg[0].scope), corner[8];
  vs_bounds b = vs_bounds_empty();
  VS_ROOTS(f->vm, r, 2);
  *out = VS_FALSE;
  if (!vs_affine_invert(&frame, &back)) return VS_OK;
  vs_scope_corners(f->arg[1].scope, corner);
  for (int i = 0; i < 8; i++) vs_bounds_add(&b, vs_affine_point(&back, corner[i]));
  double slack = 1e-9 * (vs_v3_length(size) + vs_bounds_diagonal(&b));
  if (!vs_bounds_overlap(&b, &(vs_bounds){ { 0, 0, 0 }, size }, slack)) return VS_OK;
  vs_vec3 low = vs_v3(fmin(fmax(b.min.x, 0), size.x), fmin(fmax(b.min.y, 0), size.y), fmin(fmax(b.min.z, 0), size.z));
  vs_vec3 high = vs_v3(fmin(fmax(b.max.x, 0), size.x), fmin(fmax(b.max.y, 0), size.y), fmin(fmax(b.max.z, 0), size.z));
  if (!vs_bind_give_point(f, high, &r[0]) || !vs_cons(f->vm, r[0], VS_NIL, &r[0]) ||
      !vs_bind_give_point(f, low, &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0]))
    return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (scope-detail s #:width): returns how long the scope's diagonal is in pixels, in a picture of this width by the
 * drawing's camera. The diagonal is taken to be at the scope's nearest point. Returns +inf if the camera is in the
 * scope, or if there is no camera. */
vs_status vs_p_scope_detail(vs_args *f, vs_value *out) {
  const vs_scene *scene = &f->bind->scene;
  vs_vec3 corner[8], middle = { 0, 0, 0 };
  double width = f->key[0].given ? f->key[0].real : 640, reach = 0;
  vs_scope_corners(f->arg[0].scope, corner);
  for (int i = 0; i < 8; i++) middle = vs_v3_add(middle, vs_v3_scale(corner[i], .125));
  for (int i = 0; i < 8; i++) reach = fmax(reach, vs_v3_length(vs_v3_sub(corner[i], middle)));
  double distance = vs_v3_length(vs_v3_sub(middle, scene->eye)) - reach;
  if (scene->view != VS_VIEW_CAMERA || distance <= 0) return vs_bind_give_real(f, INFINITY, out);
  return vs_bind_give_real(f, 2 * reach / distance * (scene->lens / 36) * width, out);
}
