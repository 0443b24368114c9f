/* Implements the gap between two meshes (mesh_gap.h).
 *
 * Two trees of boxes are descended together. The first descent visits the pairs of triangles that touch, and clips
 * those in one plane against each other. If there are none, a second descent omits pairs of boxes that are farther
 * apart than the best distance so far. */
#include "geometry/measure/mesh_gap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/assert.h"
#include "model/store/array.h"

enum { LEAF = 2, PAIRS = 192, FACES_MOST = 400 /* LEAF: most triangles in a leaf of the tree. PAIRS: size of the stack
                                                * of pairs of boxes. FACES_MOST: for a mesh with more triangles, no
                                                * plane of a face is tried as a separating plane. */ };

typedef struct { vs_vec3 at[3], normal; } facet;
typedef struct {
  vs_bounds bounds;
  uint32_t first, count; /* first, count: range of facets in a leaf of the tree; count 0: the node is no leaf, and its
                          * children have the indices first and first + 1 */
} box;

struct vs_gap_tree {
  facet *facets;
  box *boxes;
  vs_vec3 *vertices;
  size_t count, box_count, vertex_count;
};

void vs_gap_tree_free(vs_gap_tree *t) {
  if (!t) return;
  free(t->facets), free(t->boxes), free(t->vertices);
  free(t);
}

static vs_bounds bounds_of(const facet *f, size_t count) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) vs_bounds_add(&b, f[i].at[k]);
  return b;
}

static double along(vs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
static double middle(const facet *f, int axis) {
  return along(f->at[0], axis) + along(f->at[1], axis) + along(f->at[2], axis);
}

/* Moves facets below the mean along the axis to the front of the array. Returns their number, or half of all if the
 * mean does not divide the facets. */
static uint32_t divide(facet *f, uint32_t n, int axis) {
  double sum = 0;
  uint32_t low = 0;
  for (uint32_t i = 0; i < n; i++) sum += middle(&f[i], axis);
  for (uint32_t i = 0; i < n; i++)
    if (middle(&f[i], axis) < sum / n) {
      facet t = f[i];
      f[i] = f[low], f[low++] = t;
    }
  return low > n / 4 && low < n - n / 4 ? low : n / 2;
}

static void plant(vs_gap_tree *t) {
  t->boxes[t->box_count++] = (box){ bounds_of(t->facets, t->count), 0, (uint32_t)t->count };
  for (size_t i = 0; i < t->box_count; i++) {
    box *b = &t->boxes[i];
    uint32_t first = b->first, n = b->count;
    if (n <= LEAF) continue;
    vs_vec3 size = vs_v3_sub(b->bounds.max, b->bounds.min);
    uint32_t low = divide(t->facets + first, n, size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2);
    b->first = (uint32_t)t->box_count, b->count = 0;
    t->boxes[t->box_count++] = (box){ bounds_of(t->facets + first, low), first, low };
    t->boxes[t->box_count++] = (box){ bounds_of(t->facets + first + low, n - low), first + low, n - low };
  }
}

vs_gap_tree *vs_gap_tree_new(const vs_mesh *m) {
  vs_gap_tree *t = vs_zeros(1, sizeof *t);
  if (!t) return NULL;
  bool ok = VS_FRESH(t->facets, m->triangle_count) && VS_FRESH(t->boxes, 2 * m->triangle_count + 1) &&
            VS_FRESH(t->vertices, m->vertex_count);
  if (!ok) return vs_gap_tree_free(t), NULL;
  for (size_t i = 0; i < m->triangle_count; i++) {
    facet f;
    for (int k = 0; k < 3; k++) f.at[k] = m->vertices[m->triangles[i][k]];
    f.normal = vs_v3_unit(vs_v3_cross(vs_v3_sub(f.at[1], f.at[0]), vs_v3_sub(f.at[2], f.at[0])));
    t->facets[t->count++] = f;
  }
  if (m->vertex_count) memcpy(t->vertices, m->vertices, m->vertex_count * sizeof *m->vertices);
  t->vertex_count = m->vertex_count;
  plant(t);
  return t;
}

/* ---- distances ---- */

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

/* Pushes two pairs of boxes onto the stack: the children of the longer box of pair p, each with the other box of p.
 * Returns the new number of pairs. */
static int open_pair(const vs_gap_tree *a, const vs_gap_tree *b, both p, both *stack, int todo) {
  const box *x = &a->boxes[p.a], *y = &b->boxes[p.b];
  bool first = !x->count && (y->count || vs_bounds_diagonal(&x->bounds) >= vs_bounds_diagonal(&y->bounds));
  VS_ASSERT(todo + 2 <= PAIRS);
  for (uint32_t k = 0; k < 2; k++)
    stack[todo++] = first ? (both){ x->first + k, p.b } : (both){ p.a, y->first + k };
  if (boxes_apart(&a->boxes[stack[todo - 1].a].bounds, &b->boxes[stack[todo - 1].b].bounds) >
      boxes_apart(&a->boxes[stack[todo - 2].a].bounds, &b->boxes[stack[todo - 2].b].bounds)) {
    both t = stack[todo - 1];
    stack[todo - 1] = stack[todo - 2], stack[todo - 2] = t; /* the pair of boxes at the smaller distance is on top of
                                                             * the stack, and is visited first */
  }
  return todo;
}

/* Visits the pairs of facets whose boxes are nearer than the best distance so far; if c is not NULL, the pairs that
 * touch. */
static void descend(const vs_gap_tree *a, const vs_gap_tree *b, nearest *n, contact *c) {
  both stack[PAIRS] = { { 0, 0 } };
  for (int todo = 1; todo;) {
    both p = stack[--todo];
    const box *x = &a->boxes[p.a], *y = &b->boxes[p.b];
    double apart = boxes_apart(&x->bounds, &y->bounds);
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
  if (!a->count || !b->count) return false;
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
  for (size_t i = 0; i < a->count; i++) {
    const facet *f = &a->facets[i];
    bool clear = vs_v3_length(f->normal) > 0;
    for (size_t k = 0; clear && k < b->vertex_count; k++)
      clear = vs_v3_dot(vs_v3_sub(b->vertices[k], f->at[0]), f->normal) >= -slack;
    for (size_t k = 0; clear && k < a->vertex_count; k++)
      clear = vs_v3_dot(vs_v3_sub(a->vertices[k], f->at[0]), f->normal) <= slack;
    if (clear) return true;
  }
  return false;
}

bool vs_mesh_gap_separated(const vs_gap_tree *a, const vs_gap_tree *b, double slack) {
  const vs_bounds *x = &a->boxes[0].bounds, *y = &b->boxes[0].bounds;
  if (!a->count || !b->count) return true;
  for (int k = 0; k < 3; k++)
    if (along(x->max, k) <= along(y->min, k) + slack || along(y->max, k) <= along(x->min, k) + slack) return true;
  return a->count <= FACES_MOST && b->count <= FACES_MOST && (divides(a, b, slack) || divides(b, a, slack));
}
