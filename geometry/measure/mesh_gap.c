/* Implements the gap between two meshes (mesh_gap.h).
 *
 * Two trees of boxes are descended together. The first descent visits the pairs of triangles that touch, and clips
 * those in one plane against each other. If there are none, a second descent omits pairs of boxes that are farther
 * apart than the best distance so far. */
#include "geometry/measure/mesh_gap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/ray_tree.h"
#include "model/assert.h"
#include "model/store/array.h"

enum { PAIRS = 192, FACES_MOST = 400 /* PAIRS: size of the stack of pairs of boxes. FACES_MOST: for a mesh with more
                                      * triangles, no plane of a face is tried as a separating plane. */ };

typedef struct { vs_vec3 at[3], normal; } facet;

struct vs_gap_tree {
  vs_mesh mesh;
  vs_ray_tree tree;
  facet *facets; /* in the order of the tree's triangles */
};

void vs_gap_tree_free(vs_gap_tree *t) {
  if (!t) return;
  vs_ray_tree_free(&t->tree);
  vs_mesh_free(&t->mesh);
  free(t->facets);
  free(t);
}

vs_gap_tree *vs_gap_tree_new(vs_mesh *m, vs_store *store, vs_error *e) {
  vs_gap_tree *t = vs_zeros(1, sizeof *t);
  if (!t) return vs_error_memory(e, NULL), NULL;
  t->mesh = *m, *m = (vs_mesh){ 0 };
  if (!vs_ray_tree_make(&t->tree, store, &t->mesh, e)) return vs_gap_tree_free(t), NULL;
  if (!VS_FRESH(t->facets, t->mesh.triangle_count)) return vs_gap_tree_free(t), vs_error_memory(e, NULL), NULL;
  for (size_t i = 0; i < t->mesh.triangle_count; i++) {
    facet *f = &t->facets[i];
    for (int k = 0; k < 3; k++) f->at[k] = t->mesh.vertices[t->mesh.triangles[t->tree.order[i]][k]];
    f->normal = vs_v3_unit(vs_v3_cross(vs_v3_sub(f->at[1], f->at[0]), vs_v3_sub(f->at[2], f->at[0])));
  }
  return t;
}

/* ---- distances ---- */

static double along(vs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/* Returns the square of the distance between two boxes. */
static double boxes_apart(const vs_bounds *a, const vs_bounds *b) {
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    double below = along(a->min, k) - along(b->max, k), above = along(b->min, k) - along(a->max, k);
    double off = below > above ? below : above;
    if (off > 0) sum += off * off;
  }
  return sum;
}

typedef struct { double square; vs_vec3 at[2]; } nearest;

static void take(nearest *n, vs_vec3 p, vs_vec3 q, bool swapped) {
  vs_vec3 way = vs_v3_sub(q, p);
  double square = vs_v3_dot(way, way);
  if (!(square < n->square)) return;
  n->square = square, n->at[swapped] = p, n->at[!swapped] = q;
}

static double unit(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

/* Updates the nearest pair of points n with the nearest points of two segments: from p to p + u, and from q to q + v
 * (C. Ericson, Real-Time Collision Detection, 5.1.9). */
static void take_edges(nearest *n, vs_vec3 p, vs_vec3 u, vs_vec3 q, vs_vec3 v) {
  vs_vec3 w = vs_v3_sub(p, q);
  double a = vs_v3_dot(u, u), e = vs_v3_dot(v, v), b = vs_v3_dot(u, v), c = vs_v3_dot(u, w), f = vs_v3_dot(v, w);
  double det = a * e - b * b, s = det > 1e-14 * a * e ? unit((b * f - c * e) / det) : 0,
         t = e > 0 ? (b * s + f) / e : 0;
  if (t < 0 || t > 1) t = unit(t), s = a > 0 ? unit((b * t - c) / a) : 0;
  take(n, vs_v3_add(p, vs_v3_scale(u, s)), vs_v3_add(q, vs_v3_scale(v, t)), false);
}

/* Updates the nearest pair of points n with p and its projection onto the plane of facet f, if this lies in the
 * facet. */
static void take_foot(nearest *n, const facet *f, vs_vec3 p, bool swapped) {
  double h = vs_v3_dot(vs_v3_sub(p, f->at[0]), f->normal);
  if (!(h * h < n->square)) return;
  vs_vec3 foot = vs_v3_sub(p, vs_v3_scale(f->normal, h));
  for (int k = 0; k < 3; k++) {
    vs_vec3 side = vs_v3_sub(f->at[(k + 1) % 3], f->at[k]);
    if (vs_v3_dot(vs_v3_cross(side, vs_v3_sub(foot, f->at[k])), f->normal) < 0) return;
  }
  take(n, p, foot, swapped);
}

static void take_facets(nearest *n, const facet *a, const facet *b) {
  for (int i = 0; i < 3; i++) take_foot(n, b, a->at[i], false), take_foot(n, a, b->at[i], true);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      take_edges(n, a->at[i], vs_v3_sub(a->at[(i + 1) % 3], a->at[i]), b->at[j],
                 vs_v3_sub(b->at[(j + 1) % 3], b->at[j]));
}

/* ---- faces that touch ---- */

typedef struct { double area; vs_vec3 moment; double touching; } contact;

/* Clips the polygon at[0 .. n - 1] by the line from p to q, and keeps the part on its left, as seen against the normal.
 * Returns the number of corners, at most n + 1. */
static int clip(vs_vec3 *at, int n, vs_vec3 p, vs_vec3 q, vs_vec3 normal) {
  vs_vec3 out[10], inwards = vs_v3_cross(normal, vs_v3_sub(q, p));
  int m = 0;
  VS_ASSERT(n <= 9);
  for (int i = 0; i < n; i++) {
    vs_vec3 a = at[i], b = at[(i + 1) % n];
    double d = vs_v3_dot(vs_v3_sub(a, p), inwards), e = vs_v3_dot(vs_v3_sub(b, p), inwards);
    if (d >= 0 && m < 10) out[m++] = a;
    if ((d > 0) != (e > 0) && d != 0 && e != 0 && m < 10)
      out[m++] = vs_v3_add(a, vs_v3_scale(vs_v3_sub(b, a), d / (d - e)));
  }
  memcpy(at, out, (size_t)m * sizeof *at);
  return m;
}

/* Adds the area in which the facets a and b lie on each other to c. */
static void touch(contact *c, const facet *a, const facet *b) {
  if (vs_v3_dot(a->normal, b->normal) > -1 + 1e-9) return;
  for (int k = 0; k < 3; k++)
    if (fabs(vs_v3_dot(vs_v3_sub(b->at[k], a->at[0]), a->normal)) > c->touching) return;
  vs_vec3 at[10] = { b->at[0], b->at[1], b->at[2] };
  int n = 3;
  for (int k = 0; k < 3 && n > 2; k++) n = clip(at, n, a->at[k], a->at[(k + 1) % 3], a->normal);
  for (int k = 2; k < n; k++) {
    vs_vec3 sum = vs_v3_add(vs_v3_add(at[0], at[k - 1]), at[k]);
    double area = fabs(vs_v3_dot(vs_v3_cross(vs_v3_sub(at[k - 1], at[0]), vs_v3_sub(at[k], at[0])), a->normal)) / 2;
    c->area += area, c->moment = vs_v3_add(c->moment, vs_v3_scale(sum, area / 3));
  }
}

/* ---- the descents ---- */

typedef struct { uint32_t a, b; } both;

static double pair_apart(const vs_gap_tree *a, const vs_gap_tree *b, both p) {
  return boxes_apart(&a->tree.nodes[p.a].box, &b->tree.nodes[p.b].box);
}

/* Pushes two pairs of boxes onto the stack: the children of the longer box of pair p, each with the other box of p.
 * Returns the new number of pairs. */
static int open_pair(const vs_gap_tree *a, const vs_gap_tree *b, both p, both *stack, int todo) {
  const vs_ray_node *x = &a->tree.nodes[p.a], *y = &b->tree.nodes[p.b];
  bool first = !x->count && (y->count || vs_bounds_diagonal(&x->box) >= vs_bounds_diagonal(&y->box));
  both near = first ? (both){ p.a + 1, p.b } : (both){ p.a, p.b + 1 };
  both far = first ? (both){ x->first, p.b } : (both){ p.a, y->first };
  bool swapped = pair_apart(a, b, near) > pair_apart(a, b, far);
  VS_ASSERT(todo + 2 <= PAIRS);
  stack[todo++] = swapped ? near : far;
  stack[todo++] = swapped ? far : near; /* the pair of boxes at the smaller distance is visited first */
  return todo;
}

/* Visits the pairs of facets whose boxes are nearer than the best distance so far; if c is not NULL, the pairs that
 * touch. */
static void descend(const vs_gap_tree *a, const vs_gap_tree *b, nearest *n, contact *c) {
  both stack[PAIRS] = { { 0, 0 } };
  for (int todo = 1; todo;) {
    both p = stack[--todo];
    const vs_ray_node *x = &a->tree.nodes[p.a], *y = &b->tree.nodes[p.b];
    double apart = pair_apart(a, b, p);
    if (c ? apart > c->touching * c->touching : apart >= n->square) continue;
    if (!x->count || !y->count) {
      todo = open_pair(a, b, p, stack, todo);
      continue;
    }
    for (uint32_t i = x->first; i < x->first + x->count; i++)
      for (uint32_t j = y->first; j < y->first + y->count; j++)
        if (c) touch(c, &a->facets[i], &b->facets[j]);
        else take_facets(n, &a->facets[i], &b->facets[j]);
  }
}

bool vs_mesh_gap_find(const vs_gap_tree *a, const vs_gap_tree *b, double limit, double touching, vs_mesh_gap *out) {
  nearest n = { (limit > touching ? limit : touching) * (1 + 1e-12), { { 0, 0, 0 }, { 0, 0, 0 } } };
  contact c = { .touching = touching };
  *out = (vs_mesh_gap){ .distance = INFINITY };
  if (!a->mesh.triangle_count || !b->mesh.triangle_count) return false;
  descend(a, b, NULL, &c);
  out->area = c.area;
  if (c.area > 0) {
    out->distance = 0, out->centre = out->at[0] = out->at[1] = vs_v3_scale(c.moment, 1 / c.area);
    return true;
  }
  double most = n.square *= n.square;
  descend(a, b, &n, NULL);
  if (!(n.square < most)) return false;
  out->distance = sqrt(n.square), out->at[0] = n.at[0], out->at[1] = n.at[1];
  return true;
}

/* Returns true if the plane of some facet of a separates the two meshes: all of b in front of it, and all of a behind
 * it. */
static bool divides(const vs_gap_tree *a, const vs_gap_tree *b, double slack) {
  for (size_t i = 0; i < a->mesh.triangle_count; i++) {
    const facet *f = &a->facets[i];
    bool clear = vs_v3_length(f->normal) > 0;
    for (size_t k = 0; clear && k < b->mesh.vertex_count; k++)
      clear = vs_v3_dot(vs_v3_sub(b->mesh.vertices[k], f->at[0]), f->normal) >= -slack;
    for (size_t k = 0; clear && k < a->mesh.vertex_count; k++)
      clear = vs_v3_dot(vs_v3_sub(a->mesh.vertices[k], f->at[0]), f->normal) <= slack;
    if (clear) return true;
  }
  return false;
}

bool vs_mesh_gap_separated(const vs_gap_tree *a, const vs_gap_tree *b, double slack) {
  size_t faces = a->mesh.triangle_count, others = b->mesh.triangle_count;
  if (!faces || !others) return true;
  const vs_bounds *x = &a->tree.nodes[0].box, *y = &b->tree.nodes[0].box;
  for (int k = 0; k < 3; k++)
    if (along(x->max, k) <= along(y->min, k) + slack || along(y->max, k) <= along(x->min, k) + slack) return true;
  return faces <= FACES_MOST && others <= FACES_MOST && (divides(a, b, slack) || divides(b, a, slack));
}
