/* Implements the checks of a solid for printing (print_checks.h).
 *
 * Walls and gaps: a tree of boxes finds pairs of facets that are near and opposite each other. The second facet is
 * projected on the first, along the normal of the first, and clipped by it. On the polygon that both share the distance
 * between them is linear, thus a corner has the smallest. A ray from the polygon's middle shows whether other facets
 * lie between. Shells of the mesh are pieces, or voids if their volume is negative. */
#include "solids/print_checks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/ray_tree.h"
#include "geometry/nets/mesh_edges.h"
#include "kernel/cluster.h"
#include "kernel/memory.h"
#include "kernel/mesh/shells.h"
#include "model/store/array.h"
#include "solids/near_boxes.h"

#define OPPOSITE (-0.8660254) /* cosine of the angle between normals of opposite facets: 150 degrees */
#define SMOOTH 0.76           /* cosine of the angle between normals of neighbours that make one fault */

enum { CORNERS = 8 /* room for the corners of a triangle that the three sides of another have clipped, at most six */ };

typedef struct {
  const vs_mesh *m;
  vs_mesh_edges edges;
  vs_ray_tree rays;
  vs_vec3 *normals;
  uint32_t *group;          /* union-find structure over the triangles; each set is a group of triangles that make one
                             * fault */
  bool *marked;             /* marked[t]: true if triangle t belongs to a fault of the kind that is searched now */
  vs_print_fault *faults;   /* faults[t]: the fault of the group whose union-find root is triangle t */
  const vs_kernel_options *options;
  vs_print_faults *out;
  vs_error *error;
  bool outside;             /* true while gaps between faces are searched, false while walls are searched */
  double limit;             /* faces opposite each other at a smaller distance than this are a fault */
} check;

static void corners_of(const check *c, uint32_t t, vs_vec3 at[3]) {
  for (int k = 0; k < 3; k++) at[k] = c->m->vertices[c->m->triangles[t][k]];
}

static bool keep(check *c, const vs_print_fault *f) {
  if (!VS_GROW(c->out->at, c->out->room, c->out->count + 1)) return vs_error_memory(c->error, NULL);
  c->out->at[c->out->count++] = *f;
  return true;
}

/* ---- groups of triangles ---- */

static void begin_groups(check *c) {
  uint32_t n = (uint32_t)c->m->triangle_count;
  vs_disjoint(c->group, n);
  memset(c->marked, 0, n * sizeof *c->marked);
  memset(c->faults, 0, n * sizeof *c->faults);
}

/* Keeps one fault for each group of connected triangles with faults: the fault with the smallest value, or with the
 * largest if `largest` is true. */
static bool end_groups(check *c, bool largest) {
  for (size_t i = 0; i < c->edges.edge_count; i++) {
    const uint32_t *s = c->edges.edges[i].side;
    if (s[0] == VS_MESH_NONE || s[1] == VS_MESH_NONE || !c->marked[s[0]] || !c->marked[s[1]]) continue;
    if (vs_v3_dot(c->normals[s[0]], c->normals[s[1]]) > SMOOTH) vs_unite(c->group, s[0], s[1]);
  }
  for (uint32_t t = 0; t < c->m->triangle_count; t++) {
    uint32_t g = vs_find(c->group, t);
    vs_print_fault *f = &c->faults[g], own = c->faults[t];
    if (!c->marked[t] || g == t) continue;
    double area = f->area + own.area;
    if (own.area > 0 && (!(f->area > 0) || (largest ? own.value > f->value : own.value < f->value))) *f = own;
    f->area = area;
  }
  for (uint32_t t = 0; t < c->m->triangle_count; t++)
    if (c->marked[t] && vs_find(c->group, t) == t && c->faults[t].area > 0 && !keep(c, &c->faults[t])) return false;
  return true;
}

/* ---- walls and gaps ---- */

/* Clips the polygon `at` of n corners to the inner side of the edge from p to q of a triangle. normal: the triangle's
 * normal. Returns the number of corners that remain. */
static int clip(vs_vec3 *at, int n, vs_vec3 p, vs_vec3 q, vs_vec3 normal) {
  vs_vec3 out[CORNERS], inwards = vs_v3_cross(normal, vs_v3_sub(q, p));
  int m = 0;
  for (int i = 0; i < n; i++) {
    vs_vec3 a = at[i], b = at[(i + 1) % n];
    double d = vs_v3_dot(vs_v3_sub(a, p), inwards), e = vs_v3_dot(vs_v3_sub(b, p), inwards);
    if (d >= 0 && m < CORNERS) out[m++] = a;
    if (((d > 0 && e < 0) || (d < 0 && e > 0)) && m < CORNERS)
      out[m++] = vs_v3_add(a, vs_v3_scale(vs_v3_sub(b, a), d / (d - e)));
  }
  memcpy(at, out, (size_t)m * sizeof *at);
  return m;
}

/* Measures the part of triangle a that lies opposite triangle b. *f: the smallest distance to b, where it is, and the
 * area of the part. Returns false if there is no such part within the limit, or another facet lies between. */
static bool opposite(check *c, uint32_t a, uint32_t b, vs_print_fault *f) {
  vs_vec3 p[3], at[CORNERS], normal = c->normals[a], middle = { 0, 0, 0 }, low = { 0, 0, 0 };
  double sign = c->outside ? 1 : -1, least = INFINITY, most = 0, area = 0, slope = vs_v3_dot(normal, c->normals[b]);
  int n = 3;
  corners_of(c, a, p), corners_of(c, b, at);
  vs_vec3 plane = at[0];
  for (int k = 0; k < 3; k++)
    at[k] = vs_v3_sub(at[k], vs_v3_scale(normal, vs_v3_dot(vs_v3_sub(at[k], p[0]), normal)));
  for (int k = 0; k < 3 && n > 2; k++) n = clip(at, n, p[k], p[(k + 1) % 3], normal);
  for (int k = 0; k < n; k++) {
    double h = sign * vs_v3_dot(vs_v3_sub(plane, at[k]), c->normals[b]) / slope;
    if (h < least) least = h, low = at[k];
    most = fmax(most, h);
  }
  for (int k = 2; k < n; k++) {
    double part = vs_v3_length(vs_v3_cross(vs_v3_sub(at[k - 1], at[0]), vs_v3_sub(at[k], at[0]))) / 2;
    area += part;
    middle = vs_v3_add(middle, vs_v3_scale(vs_v3_add(vs_v3_add(at[0], at[k - 1]), at[k]), part / 3));
  }
  if (n < 3 || !(area > 0) || !(least >= 0) || !(least < c->limit) || !(most > 0)) return false;
  middle = vs_v3_scale(middle, 1 / area);
  double h = sign * vs_v3_dot(vs_v3_sub(plane, middle), c->normals[b]) / slope;
  vs_vec3 way = vs_v3_scale(normal, sign * h);
  if (most - least < 1e-3 * most) low = middle;
  *f = (vs_print_fault){ c->outside ? VS_PRINT_GAP : VS_PRINT_WALL,
                         vs_v3_add(low, vs_v3_scale(normal, sign * least / 2)), least, area };
  double met;
  vs_vec3 start = vs_v3_add(middle, vs_v3_scale(way, 1e-6));
  return vs_ray_tree_meet(&c->rays, start, way, 1 - 1e-5, true, &met) == c->m->triangle_count;
}

static bool examine(void *context, uint32_t a, uint32_t b) {
  check *c = context;
  vs_print_fault f;
  if (!(vs_v3_dot(c->normals[a], c->normals[b]) < OPPOSITE)) return true;
  if (!opposite(c, a, b, &f) && !opposite(c, b, a, &f)) return true;
  c->marked[a] = c->marked[b] = true;
  uint32_t t = c->faults[a].area > 0 || !(c->faults[b].area > 0) ? a : b;
  double area = c->faults[t].area + f.area;
  if (!(c->faults[t].area > 0) || f.value < c->faults[t].value) c->faults[t] = f;
  c->faults[t].area = area;
  vs_unite(c->group, a, b);
  return true;
}

/* Finds all walls that are thinner than the limit, or if c->outside is true, all gaps that are narrower. */
static bool find_opposite(check *c) {
  uint32_t n = (uint32_t)c->m->triangle_count;
  vs_bounds all = vs_mesh_bounds(c->m), *boxes = vs_fresh(n, sizeof *boxes);
  if (!boxes) return vs_error_memory(c->error, NULL);
  for (uint32_t i = 0; i < n; i++) {
    vs_vec3 p[3];
    corners_of(c, i, p);
    boxes[i] = vs_bounds_empty();
    for (int j = 0; j < 3; j++) vs_bounds_add(&boxes[i], p[j]);
  }
  begin_groups(c);
  bool ok = vs_near_boxes(boxes, n, fmin(c->limit, vs_bounds_diagonal(&all)), c->options, examine, c, c->error);
  free(boxes);
  return ok && end_groups(c, false);
}

/* ---- overhangs ---- */

static bool find_overhangs(check *c, double angle) {
  vs_bounds all = vs_mesh_bounds(c->m);
  double plate = all.min.z + 1e-7 * vs_bounds_diagonal(&all);
  begin_groups(c);
  for (uint32_t t = 0; t < c->m->triangle_count; t++) {
    vs_vec3 p[3];
    corners_of(c, t, p);
    double own = asin(fmin(fmax(-c->normals[t].z, -1), 1));
    double area = vs_v3_length(vs_v3_cross(vs_v3_sub(p[1], p[0]), vs_v3_sub(p[2], p[0]))) / 2;
    if (!(own > angle + 1e-6) || !(area > 0) || (p[0].z <= plate && p[1].z <= plate && p[2].z <= plate)) continue;
    c->marked[t] = true;
    c->faults[t] = (vs_print_fault){ VS_PRINT_OVERHANG, vs_v3_scale(vs_v3_add(vs_v3_add(p[0], p[1]), p[2]), 1 / 3.),
                                     own, area };
  }
  return end_groups(c, true);
}

/* ---- voids and pieces ---- */

/* Adds a fault for each void (closed cavity), and for each separate piece except the largest. */
static bool find_shells(check *c) {
  vs_shells shells = { 0 };
  vs_vec3 *moment = NULL;
  uint32_t largest = 0;
  bool ok = vs_shells_find(c->m, &shells) && (moment = vs_zeros(shells.count, sizeof *moment)) != NULL;
  for (uint32_t t = 0; ok && t < c->m->triangle_count; t++) {
    vs_vec3 p[3];
    corners_of(c, t, p);
    uint32_t s = shells.of[c->m->triangles[t][0]];
    for (int k = 0; k < 3; k++) p[k] = vs_v3_sub(p[k], shells.at[s].from);
    double volume = vs_v3_dot(p[0], vs_v3_cross(p[1], p[2])) / 6;
    moment[s] = vs_v3_add(moment[s], vs_v3_scale(vs_v3_add(vs_v3_add(p[0], p[1]), p[2]), volume / 4));
  }
  for (uint32_t i = 1; ok && i < shells.count; i++)
    if (shells.at[i].volume > shells.at[largest].volume) largest = i;
  if (!ok) vs_error_memory(c->error, NULL);
  for (uint32_t i = 0; ok && i < shells.count; i++) {
    const vs_shell *s = &shells.at[i];
    if (i == largest || s->volume == 0) continue;
    vs_print_fault f = { s->volume < 0 ? VS_PRINT_VOID : VS_PRINT_PIECE,
                         vs_v3_add(s->from, vs_v3_scale(moment[i], 1 / s->volume)), fabs(s->volume), s->area };
    ok = keep(c, &f);
  }
  free(moment);
  vs_shells_free(&shells);
  return ok;
}

static bool prepare(check *c, vs_store *store) {
  size_t n = c->m->triangle_count;
  if (!vs_mesh_edges_make(&c->edges, c->m) || !VS_FRESH(c->normals, n) || !VS_FRESH(c->group, n) ||
      !VS_FRESH(c->marked, n) || !VS_FRESH(c->faults, n))
    return vs_error_memory(c->error, NULL);
  for (uint32_t t = 0; t < n; t++) {
    vs_vec3 p[3];
    corners_of(c, t, p);
    c->normals[t] = vs_v3_unit(vs_v3_cross(vs_v3_sub(p[1], p[0]), vs_v3_sub(p[2], p[0])));
  }
  return vs_ray_tree_make(&c->rays, store, c->m, c->error);
}

static int by_kind(const void *p, const void *q) {
  const vs_print_fault *a = p, *b = q;
  if (a->kind != b->kind) return a->kind < b->kind ? -1 : 1;
  bool rising = a->kind == VS_PRINT_WALL || a->kind == VS_PRINT_GAP;
  if (a->value != b->value) return (a->value < b->value) == rising ? -1 : 1;
  const double x[3] = { a->place.x, a->place.y, a->place.z }, y[3] = { b->place.x, b->place.y, b->place.z };
  for (int k = 0; k < 3; k++)
    if (x[k] != y[k]) return x[k] < y[k] ? -1 : 1;
  return 0;
}

bool vs_print_check(const vs_mesh *m, vs_store *store, const vs_print_rule *rule, const vs_kernel_options *options,
                    vs_print_faults *out, vs_error *e) {
  check c = { .m = m, .options = options, .out = out, .error = e };
  if (!m->triangle_count) return true;
  bool ok = prepare(&c, store);
  if (ok && rule->wall > 0) c.limit = rule->wall * (1 - 1e-9), ok = find_opposite(&c);
  if (ok && rule->gap > 0) c.limit = rule->gap * (1 - 1e-9), c.outside = true, ok = find_opposite(&c);
  ok = ok && find_overhangs(&c, rule->overhang) && find_shells(&c);
  if (ok && out->count) qsort(out->at, out->count, sizeof *out->at, by_kind);
  vs_ray_tree_free(&c.rays);
  vs_mesh_edges_free(&c.edges);
  free(c.normals), free(c.group), free(c.marked), free(c.faults);
  return ok;
}
