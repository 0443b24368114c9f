/* Owns what a rule may ask of its surroundings: does its scope touch what was made so far, does it lie inside of it.
 *
 * Plan. The bounds of what was made lie in a tree over the order in which it was made: what one rule makes lies close
 * together, so sixteen neighbours share a box, sixteen such boxes the next, and so on. Where bounds meet, the question
 * is answered exactly: the scope is one convex piece, or six tetrahedra where it is a hexahedron; a triangle of the
 * object touches it where something is left of it when it is cut by the planes of a piece. A scope that no triangle
 * touches lies wholly inside or outside, which one point decides. */
#include "bind/rules/surroundings.h"

#include "bind/rules/derivation.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"

enum { FAN = 16, LEVELS = 8, KEPT = 32 };

struct vs_surroundings {
  vs_bind *bind;
  struct {
    vs_bounds *at;
    size_t count, room;
  } level[LEVELS]; /* 0: of each thing made */
  struct {
    vs_node *node;     /* retained, or NULL */
    vs_node *resolved; /* the same without nodes that await their mesh (solids/resolve.h); retained */
    vs_bend_leaves leaves;
  } kept[KEPT]; /* objects taken apart, by address */
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
  if (!(a = vs_store_realloc(d->bind->store, NULL, 0, sizeof *a))) return (void)vs_fail_memory(d->bind->vm), NULL;
  memset(a, 0, sizeof *a);
  a->bind = d->bind;
  return d->around = a;
}

/* ---- the scope as convex pieces ---- */

typedef struct {
  vs_vec3 normal;
  double at;
} half_space; /* normal · p <= at; unit normal */
typedef struct {
  half_space side[6];
  int count;
} piece;
typedef struct {
  vs_bounds bounds;
  vs_vec3 corner[8];
  double slack; /* lengths that are as good as none */
  piece piece[6];
  int count;
} body;

static half_space half_space_of(vs_vec3 normal, vs_vec3 at) {
  return (half_space){ normal, vs_v3_dot(normal, at) };
}

/* The frame's own box: also where it has no size along an axis. */
static void box_piece(body *b, const vs_scope *s) {
  vs_affine m = vs_scope_frame(s);
  piece *p = &b->piece[b->count++];
  for (int a = 0; a < 3; a++) {
    vs_vec3 along = vs_affine_column(&m, a);
    vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_affine_column(&m, (a + 1) % 3), vs_affine_column(&m, (a + 2) % 3)));
    if (vs_v3_dot(n, along) < 0) n = vs_v3_scale(n, -1);
    p->side[p->count++] = half_space_of(n, b->corner[7]);
    p->side[p->count++] = half_space_of(vs_v3_scale(n, -1), b->corner[0]);
  }
}

/* The tetrahedra of a hexahedron about its diagonal from corner 0 to 7; flat ones are left out. */
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
    if (thick) b->piece[b->count++] = tetrahedron;
  }
}

static body body_of(const vs_scope *s) {
  body b = { .bounds = vs_bounds_empty() };
  vs_scope_corners(s, b.corner);
  for (int i = 0; i < 8; i++) vs_bounds_add(&b.bounds, b.corner[i]);
  double reach = vs_v3_length(b.bounds.min) + vs_v3_length(b.bounds.max);
  b.slack = 1e-9 * (reach > 0 ? reach : 1);
  if (s->class_ == VS_SCOPE_FFD || s->class_ == VS_SCOPE_TURTLE) tetrahedra(&b);
  if (!b.count) box_piece(&b, s);
  return b;
}

/* Is something left of the triangle within the piece? Its sides go out by slack; a negative one moves them in, but for
 * pairs that have no room between them. */
static bool triangle_meets(const piece *p, const vs_vec3 triangle[3], double slack) {
  vs_vec3 corner[2][16];
  size_t n = 3;
  int from = 0;
  memcpy(corner[0], triangle, 3 * sizeof *triangle);
  for (int k = 0; k < p->count && n; k++) {
    const half_space *h = &p->side[k];
    bool flat = p->count == 6 && h->at + p->side[k ^ 1].at <= fabs(slack);
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
  for (int i = 0; i < b->count; i++)
    if (triangle_meets(&b->piece[i], triangle, slack)) return true;
  return false;
}

static bool body_holds(const body *b, vs_vec3 p) {
  const vs_vec3 point[3] = { p, p, p };
  return body_meets(b, point, b->slack);
}

bool vs_scopes_touch(const vs_scope *x, const vs_scope *y) {
  body a = body_of(x), b = body_of(y);
  double slack = fmax(a.slack, b.slack);
  if (!vs_bounds_overlap(&a.bounds, &b.bounds, slack)) return false;
  if (body_holds(&a, b.corner[0]) || body_holds(&b, a.corner[0])) return true;
  static const int face[6][4] = { { 0, 1, 3, 2 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                  { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 3, 7, 5 } };
  for (int i = 0; i < 6; i++)
    for (int k = 0; k < 2; k++) { /* the diagonals from 0 and 7, as the tetrahedra's */
      const vs_vec3 t[3] = { b.corner[face[i][0]], b.corner[face[i][1 + k]], b.corner[face[i][2 + k]] };
      if (body_meets(&a, t, slack)) return true;
    }
  return false;
}

/* ---- one object ---- */

static const vs_bend_leaves *taken_apart(vs_surroundings *a, vs_ref object, vs_node **resolved) {
  size_t i = (size_t)(((uintptr_t)object.node >> 4) * UINT64_C(0x9E3779B97F4A7C15) >> 32) % KEPT;
  *resolved = a->kept[i].resolved;
  if (a->kept[i].node == object.node) return &a->kept[i].leaves;
  vs_bend_leaves leaves;
  vs_ref plain = { vs_node_retain(object.node), object.origin };
  if (!vs_bend_resolve(a->bind, &plain) || !vs_bend_take_apart(a->bind, plain, NULL, &leaves))
    return vs_node_release(plain.node), NULL;
  drop_one(a, i);
  a->kept[i].node = vs_node_retain(object.node), a->kept[i].leaves = leaves;
  *resolved = a->kept[i].resolved = plain.node;
  return &a->kept[i].leaves;
}

/* Does a triangle or a stretch of a curve meet the body, its sides out by slack? */
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

typedef struct {
  vs_frame *f;
  body body;
  bool inside; /* the question is whether it lies inside; else whether it touches */
  const char *flag;
  bool failed;
} question;

static bool holds(question *q, const vs_node *n, vs_vec3 p) {
  bool in = false;
  vs_error e = { 0 };
  if (n->class_ != VS_SOLID || q->failed) return false;
  if (!vs_inside_cached(&q->f->bind->inside, n, p, &in, &e)) q->failed = true, vs_bind_error(q->f, &e);
  return in;
}

/* Does the answer hold for this object? */
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
  if (!q->inside) return meets || (!flat && holds(q, resolved, vs_affine_point(&back, q->body.corner[0])));
  for (int i = 0; i < 8 && !meets; i++)
    meets = flat || !holds(q, resolved, vs_affine_point(&back, q->body.corner[i]));
  return !meets && !q->failed;
}

/* ---- all that was made ---- */

/* Brings the tree up to what has been made since. */
static bool catch_up(vs_derivation *d, vs_surroundings *a) {
  vs_error e = { 0 };
  for (size_t i = a->level[0].count; i < d->made_count; i++) {
    vs_bounds box;
    if (!vs_node_bounds(d->made[i].node, &box, &e))
      return vs_fail(d->bind->vm, d->bind->vm->sym.error, "%s", e.message);
    for (size_t level = 0, at = i; level < LEVELS; level++, at /= FAN) {
      if (at >= a->level[level].count) {
        if (!vs_store_grow(d->bind->store, &a->level[level].at, &a->level[level].room, at + 1, sizeof box))
          return vs_fail_memory(d->bind->vm);
        a->level[level].at[at] = vs_bounds_empty(), a->level[level].count = at + 1;
      }
      vs_bounds_unite(&a->level[level].at[at], &box);
    }
    if (!vs_poll_turn(d->bind->vm, i, 40)) return false;
  }
  return true;
}

static bool any_answers(question *q, vs_derivation *d) {
  vs_surroundings *a = surroundings_of(d);
  if (!a || !catch_up(d, a)) return q->failed = true, false;
  int level = LEVELS - 1;
  size_t at = 0;
  /* In order: down into a box that meets, else on to the next, or up where there is none left beside it. */
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
    if (q->failed || !vs_poll(d->bind->vm, 20)) return q->failed = true, false;
    for (at++; level < LEVELS - 1 && at % FAN == 0; at /= FAN) level++;
    while (level < LEVELS - 1 && at >= a->level[level].count) level++, at = at / FAN + 1;
  }
  return false;
}

/* Scopes that wait count as what will be made of them. */
static bool any_waits(const question *q, const vs_derivation *d, const vs_scope *s) {
  for (size_t i = 0; i < d->waiting_count && !q->inside; i++) {
    const vs_scope *c = d->waiting[i].task->child[0];
    if ((!q->flag || vs_scope_has_flag(c, q->flag)) && vs_scopes_touch(s, c)) return true;
  }
  return false;
}

static vs_status ask(vs_frame *f, bool inside, vs_value *out) {
  const vs_scope *s = f->arg[0].scope;
  question q = { .f = f, .body = body_of(s), .inside = inside };
  bool yes = false;
  if (f->key[0].given && !(q.flag = vs_store_text(f->bind->store, f->key[0].text.at, f->key[0].text.length)))
    return vs_fail_memory(f->vm);
  if (f->key[1].given) {
    vs_surroundings a = { .bind = f->bind };
    yes = answers(&q, &a, f->key[1].ref);
    drop_kept(&a);
  } else
    for (vs_derivation *d = f->bind->growing; d && !yes && !q.failed; d = d->outer)
      yes = any_waits(&q, d, s) || any_answers(&q, d);
  *out = vs_bool(yes);
  return q.failed ? VS_ERROR : VS_OK;
}

vs_status vs_p_scope_touches(vs_frame *f, vs_value *out) { return ask(f, false, out); }
vs_status vs_p_scope_is_inside(vs_frame *f, vs_value *out) { return ask(f, true, out); }

/* (scope-overlap s other): the part of s's box that the other's bounds along s's own axes take: two points in s's own
 * coordinates, or #f. */
vs_status vs_p_scope_overlap(vs_frame *f, vs_value *out) {
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
  if (!vs_bind_point(f, high, &r[0]) || !vs_cons(f->vm, r[0], VS_NIL, &r[0]) || !vs_bind_point(f, low, &r[1]) ||
      !vs_cons(f->vm, r[1], r[0], &r[0]))
    return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (scope-detail s #:width): how many pixels long the scope's diagonal is on a picture of that width that the drawing's
 * camera takes, where the scope is nearest; +inf where the camera is in it, or there is none yet. */
vs_status vs_p_scope_detail(vs_frame *f, vs_value *out) {
  const vs_scene *scene = &f->bind->scene;
  vs_vec3 corner[8], middle = { 0, 0, 0 };
  double width = f->key[0].given ? f->key[0].real : 640, reach = 0;
  vs_scope_corners(f->arg[0].scope, corner);
  for (int i = 0; i < 8; i++) middle = vs_v3_add(middle, vs_v3_scale(corner[i], .125));
  for (int i = 0; i < 8; i++) reach = fmax(reach, vs_v3_length(vs_v3_sub(corner[i], middle)));
  double distance = vs_v3_length(vs_v3_sub(middle, scene->eye)) - reach;
  if (scene->view != VS_VIEW_CAMERA || distance <= 0) return vs_bind_real(f, INFINITY, out);
  return vs_bind_real(f, 2 * reach / distance * (scene->lens / 36) * width, out);
}
