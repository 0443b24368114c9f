/* Implements smoothing.h by cubic triangles (A. Vlachos, J. Peters, C. Boyd, J. Mitchell, 2001). The normal at a
 * triangle's corner is the mean normal of all triangles that are connected with it around the corner without a sharp
 * edge. The control points of an edge have such distances from its ends that points on a circle give nearly a
 * circle. */
#include "geometry/shapes/smoothing.h"

#include <stdlib.h>

#include "model/store/array.h"
#include "model/store/disjoint.h"

enum { PARTS_MOST = 24, TRIANGLES_MOST = 2000000 };

typedef struct {
  const vs_mesh_edges *s;
  bool *sharp;         /* sharp[e]: true if edge e of the mesh is sharp */
  uint32_t *up;        /* union-find structure of the triangles' corners; corners in one set have one normal; corner k
                        * of triangle t is element 3 t + k */
  vs_vec3 *normal;     /* normal[i]: for the root i of a set in `up`, the common normal of its corners, not of length
                        * 1 */
  uint32_t *creases;   /* creases[v]: number of sharp edges at vertex v */
  vs_vec3 *along;      /* along[v]: for a vertex v with two sharp edges, the tangent of the curve that they form */
  vs_vec3 (*handle)[2]; /* handle[e]: control points of edge e, the first near its end a, the second near its end b */
  uint32_t *first;     /* first[e]: index of the first new vertex on edge e; the others follow, from a to b */
} smoothing;

static int corner_at(const vs_mesh_edges *s, uint32_t t, uint32_t v) {
  return vs_mesh_edges_corner(s, t, 0) == v ? 0 : vs_mesh_edges_corner(s, t, 1) == v ? 1 : 2;
}

static vs_vec3 normal_of(const vs_mesh_edges *s, uint32_t t) {
  vs_vec3 a = vs_mesh_edges_place(s, t, 0), b = vs_mesh_edges_place(s, t, 1), c = vs_mesh_edges_place(s, t, 2);
  return vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)));
}

static void find_normals(smoothing *w, double sharp) {
  const vs_mesh_edges *s = w->s;
  const vs_vec3 *p = s->m->vertices;
  for (uint32_t i = 0; i < 3 * s->m->triangle_count; i++) w->up[i] = i, w->normal[i] = vs_v3(0, 0, 0);
  for (uint32_t v = 0; v < s->m->vertex_count; v++) w->creases[v] = 0, w->along[v] = vs_v3(0, 0, 0);
  for (size_t e = 0; e < s->edge_count; e++) {
    const vs_mesh_edge *g = &s->edges[e];
    uint32_t t = g->side[0], u = g->side[1], ends[2] = { g->a, g->b };
    w->sharp[e] = u == VS_MESH_NONE || vs_v3_dot(normal_of(s, t), normal_of(s, u)) < cos(sharp);
    for (int k = 0; k < 2; k++) {
      if (!w->sharp[e]) {
        vs_unite(w->up, 3 * t + (uint32_t)corner_at(s, t, ends[k]), 3 * u + (uint32_t)corner_at(s, u, ends[k]));
        continue;
      }
      vs_vec3 d = vs_v3_unit(vs_v3_sub(p[ends[!k]], p[ends[k]]));
      w->along[ends[k]] = w->creases[ends[k]]++ ? vs_v3_sub(w->along[ends[k]], d) : d;
    }
  }
  for (uint32_t i = 0; i < 3 * s->m->triangle_count; i++) {
    int k = (int)(i % 3);
    vs_vec3 at = vs_mesh_edges_place(s, i / 3, k), u = vs_v3_sub(vs_mesh_edges_place(s, i / 3, (k + 1) % 3), at),
            v = vs_v3_sub(vs_mesh_edges_place(s, i / 3, (k + 2) % 3), at), n = vs_v3_cross(u, v);
    uint32_t r = vs_find(w->up, i);
    w->normal[r] = vs_v3_add(w->normal[r], vs_v3_scale(vs_v3_unit(n), atan2(vs_v3_length(n), vs_v3_dot(u, v))));
  }
}

/* Returns the control point of edge e that is near its end v. */
static vs_vec3 handle_at(smoothing *w, size_t e, uint32_t v) {
  const vs_mesh_edge *g = &w->s->edges[e];
  vs_vec3 p = w->s->m->vertices[v], d = vs_v3_sub(w->s->m->vertices[g->a == v ? g->b : g->a], p), t = d;
  if (w->sharp[e]) {
    if (w->creases[v] == 2) t = vs_v3_dot(w->along[v], d) < 0 ? vs_v3_scale(w->along[v], -1) : w->along[v];
  } else {
    vs_vec3 n = vs_v3_unit(w->normal[vs_find(w->up, 3 * g->side[0] + (uint32_t)corner_at(w->s, g->side[0], v))]);
    t = vs_v3_sub(d, vs_v3_scale(n, vs_v3_dot(n, d)));
  }
  t = vs_v3_unit(t);
  double l = vs_v3_length(d), half = acos(fmin(1, fmax(0, l > 0 ? vs_v3_dot(t, d) / l : 1))) / 2;
  return vs_v3_add(p, vs_v3_scale(t, l / 3 / (cos(half) * cos(half))));
}

static vs_vec3 mix(vs_vec3 a, double s, vs_vec3 b, double t) { return vs_v3_add(vs_v3_scale(a, s), vs_v3_scale(b, t)); }

static vs_vec3 cubic(const vs_vec3 c[4], double t) {
  double s = 1 - t;
  return vs_v3_add(mix(c[0], s * s * s, c[1], 3 * s * s * t), mix(c[2], 3 * s * t * t, c[3], t * t * t));
}

static void controls(const smoothing *w, size_t e, vs_vec3 c[4]) {
  const vs_mesh_edge *g = &w->s->edges[e];
  c[0] = w->s->m->vertices[g->a], c[1] = w->handle[e][0], c[2] = w->handle[e][1], c[3] = w->s->m->vertices[g->b];
}

/* Computes the control points of all edges. Returns the number of parts into which each edge must be divided. */
static uint32_t find_handles(smoothing *w, double tolerance) {
  double most = 0;
  for (size_t e = 0; e < w->s->edge_count; e++) {
    vs_vec3 c[4];
    w->handle[e][0] = handle_at(w, e, w->s->edges[e].a), w->handle[e][1] = handle_at(w, e, w->s->edges[e].b);
    controls(w, e, c);
    most = fmax(most, vs_v3_length(vs_v3_sub(cubic(c, .5), mix(c[0], .5, c[3], .5))));
  }
  double parts = ceil(sqrt(most / tolerance));
  double room = sqrt((double)TRIANGLES_MOST / (double)(w->s->m->triangle_count + 1));
  return (uint32_t)fmax(1, fmin(fmin(parts, PARTS_MOST), room));
}

/* Adds the new vertices on all edges: n - 1 on each. Returns false when memory is out. */
static bool add_edges(smoothing *w, uint32_t n, vs_mesh *out) {
  bool ok = true;
  for (size_t e = 0; ok && e < w->s->edge_count; e++) {
    vs_vec3 c[4];
    controls(w, e, c);
    w->first[e] = (uint32_t)out->vertex_count;
    for (uint32_t i = 1; ok && i < n; i++) ok = vs_mesh_add_vertex(out, cubic(c, i / (double)n), NULL);
  }
  return ok;
}

/* A triangle while it is divided: its control points, and the vertices of the grid of points on it, row by row from
 * corner 0. */
typedef struct {
  vs_vec3 at[3], edge[3][2], middle; /* at: the corners; edge[k]: control points of the edge opposite corner k, the
                                      * first near corner k + 1; middle: control point in the middle */
  uint32_t *grid;
} curved;

static vs_vec3 point_of(const curved *c, double u, double v) { /* returns a point of the curved triangle; u, v: weights
                                                                * of corners 1 and 2 */
  double w = 1 - u - v;
  vs_vec3 sum = vs_v3_add(mix(c->at[0], w * w * w, c->at[1], u * u * u), vs_v3_scale(c->at[2], v * v * v));
  sum = vs_v3_add(sum, mix(c->edge[2][0], 3 * w * w * u, c->edge[2][1], 3 * w * u * u));
  sum = vs_v3_add(sum, mix(c->edge[0][0], 3 * u * u * v, c->edge[0][1], 3 * u * v * v));
  sum = vs_v3_add(sum, mix(c->edge[1][0], 3 * v * v * w, c->edge[1][1], 3 * v * w * w));
  return vs_v3_add(sum, vs_v3_scale(c->middle, 6 * u * v * w));
}

/* Returns the vertex at i / n of the side opposite corner k of triangle t, counted from corner k + 1. */
static uint32_t side_vertex(const smoothing *w, uint32_t t, int k, uint32_t i, uint32_t n) {
  uint32_t e = w->s->of[t][k], from = vs_mesh_edges_corner(w->s, t, (k + 1) % 3);
  return w->first[e] + (w->s->edges[e].a == from ? i - 1 : n - 1 - i);
}

static bool add_triangle(const smoothing *w, uint32_t t, uint32_t n, curved *c, vs_mesh *out) {
  bool ok = true;
  vs_vec3 sum = { 0, 0, 0 }, corners = { 0, 0, 0 };
  for (int k = 0; k < 3; k++) {
    uint32_t e = w->s->of[t][k];
    bool forward = w->s->edges[e].a == vs_mesh_edges_corner(w->s, t, (k + 1) % 3);
    c->at[k] = vs_mesh_edges_place(w->s, t, k);
    c->edge[k][0] = w->handle[e][!forward], c->edge[k][1] = w->handle[e][forward];
    sum = vs_v3_add(sum, vs_v3_add(c->edge[k][0], c->edge[k][1])), corners = vs_v3_add(corners, c->at[k]);
  }
  c->middle = mix(sum, 1.5 / 6, corners, -.5 / 3);
  uint32_t *g = c->grid;
  for (uint32_t i = 0; ok && i <= n; i++)     /* row i of the grid lies at the fraction i / n of the way from corner 0
                                               * to the opposite side */
    for (uint32_t j = 0; ok && j <= i; j++) { /* point j of the row, counted from the side of corner 1 to the side of
                                               * corner 2 */
      uint32_t *to = &g[i * (i + 1) / 2 + j];
      if (i == 0) *to = vs_mesh_edges_corner(w->s, t, 0);
      else if (i == n && (j == 0 || j == n)) *to = vs_mesh_edges_corner(w->s, t, j ? 2 : 1);
      else if (i == n) *to = side_vertex(w, t, 0, j, n);
      else if (j == 0) *to = side_vertex(w, t, 2, i, n);
      else if (j == i) *to = side_vertex(w, t, 1, n - i, n);
      else ok = vs_mesh_add_vertex(out, point_of(c, (double)(i - j) / n, (double)j / n), to);
    }
  for (uint32_t i = 0; ok && i < n; i++)
    for (uint32_t j = 0; ok && j <= i; j++) {
      uint32_t a = i * (i + 1) / 2 + j, b = (i + 1) * (i + 2) / 2 + j;
      ok = vs_mesh_add_triangle(out, g[a], g[b], g[b + 1]) &&
           (j == i || vs_mesh_add_triangle(out, g[a], g[b + 1], g[a + 1]));
    }
  return ok;
}

bool vs_mesh_smooth(const vs_mesh_edges *s, double sharp, double tolerance, vs_mesh *out) {
  smoothing w = { .s = s };
  curved c = { .grid = NULL };
  size_t corners = 3 * s->m->triangle_count, n = s->m->vertex_count;
  bool ok = VS_FRESH(w.sharp, s->edge_count + 1) && VS_FRESH(w.up, corners + 1) && VS_FRESH(w.normal, corners + 1) &&
            VS_FRESH(w.creases, n + 1) && VS_FRESH(w.along, n + 1) && VS_FRESH(w.handle, s->edge_count + 1) &&
            VS_FRESH(w.first, s->edge_count + 1) && VS_FRESH(c.grid, (PARTS_MOST + 1) * (PARTS_MOST + 2) / 2);
  if (ok) find_normals(&w, sharp);
  uint32_t parts = ok ? find_handles(&w, tolerance) : 1;
  for (size_t v = 0; ok && v < n; v++) ok = vs_mesh_add_vertex(out, s->m->vertices[v], NULL);
  ok = ok && add_edges(&w, parts, out);
  for (uint32_t t = 0; ok && t < s->m->triangle_count; t++) ok = add_triangle(&w, t, parts, &c, out);
  free(w.sharp), free(w.up), free(w.normal), free(w.creases);
  free(w.along), free(w.handle), free(w.first), free(c.grid);
  return ok;
}
