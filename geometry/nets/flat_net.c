/* Implements flat nets (flat_net.h): moves the triangles of a mesh into a plane, beside each other, and follows the
 * borders of joined triangles. */
#include "geometry/nets/flat_net.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/assert.h"
#include "model/store/array.h"

static vs_vec3 place(const vs_flat_net *s, uint32_t v) { return s->edges.m->vertices[v]; }
static vs_vec2 less(vs_vec2 a, vs_vec2 b) { return (vs_vec2){ a.x - b.x, a.y - b.y }; }
static double apart(vs_vec2 a, vs_vec2 b) { return hypot(a.x - b.x, a.y - b.y); }

void vs_flat_net_free(vs_flat_net *s) {
  vs_mesh_edges_free(&s->edges);
  free(s->at), free(s->face), free(s->piece), free(s->joined);
}

int vs_flat_net_corner(const vs_flat_net *s, uint32_t t, uint32_t e) {
  for (int k = 0; k < 2; k++)
    if (s->edges.of[t][k] == e) return k;
  return 2;
}

static uint32_t apex_vertex(const vs_flat_net *s, uint32_t t, uint32_t e) {
  return vs_mesh_edges_corner(&s->edges, t, vs_flat_net_corner(s, t, e));
}

/* Returns true if the two triangles at edge e lie in one plane, on opposite sides of the edge. */
static bool is_flat(const vs_flat_net *s, uint32_t e) {
  const vs_mesh_edge *g = &s->edges.edges[e];
  if (g->side[1] == VS_MESH_NONE) return false;
  vs_vec3 a = place(s, g->a), along = vs_v3_sub(place(s, g->b), a);
  vs_vec3 p = vs_v3_sub(place(s, apex_vertex(s, g->side[0], e)), a);
  vs_vec3 q = vs_v3_sub(place(s, apex_vertex(s, g->side[1], e)), a);
  vs_vec3 n = vs_v3_cross(along, p), m = vs_v3_cross(q, along);
  double ln = vs_v3_length(n), lm = vs_v3_length(m);
  if (ln <= s->slack * vs_v3_length(along) || lm <= s->slack * vs_v3_length(along)) return true; /* a triangle without
                                                                                                  * area counts as
                                                                                                  * coplanar with its
                                                                                                  * neighbour */
  return vs_v3_dot(n, m) > 0 && fabs(vs_v3_dot(q, n)) <= s->slack * ln && fabs(vs_v3_dot(p, m)) <= s->slack * lm;
}

/* Sets of[t] to the number of triangle t's part: triangles that are connected by edges e for which through(s, e) is
 * true. Returns the number of parts, or SIZE_MAX when memory is out. */
static size_t parts(const vs_flat_net *s, bool (*through)(const vs_flat_net *, uint32_t), uint32_t *of) {
  size_t n = s->edges.m->triangle_count, count = 0, open = 0;
  uint32_t *stack = vs_fresh(n + 1, sizeof *stack);
  if (!stack) return SIZE_MAX;
  for (size_t i = 0; i < n; i++) of[i] = VS_MESH_NONE;
  for (uint32_t i = 0; i < n; i++) {
    if (of[i] != VS_MESH_NONE) continue;
    of[i] = (uint32_t)count, stack[open++] = i;
    while (open) {
      uint32_t t = stack[--open];
      for (int k = 0; k < 3; k++) {
        uint32_t e = s->edges.of[t][k];
        const vs_mesh_edge *g = &s->edges.edges[e];
        uint32_t other = g->side[g->side[0] == t];
        if (other == VS_MESH_NONE || of[other] != VS_MESH_NONE || !through(s, e)) continue;
        of[other] = (uint32_t)count, stack[open++] = other;
      }
    }
    count++;
  }
  free(stack);
  return count;
}

static bool any(const vs_flat_net *s, uint32_t e) { return (void)s, (void)e, true; }

bool vs_flat_net_make(vs_flat_net *s, const vs_mesh *m, bool *several) {
  size_t n = m->triangle_count;
  *s = (vs_flat_net){ .size = 0 };
  *several = false;
  if (!vs_mesh_edges_make(&s->edges, m) || !VS_FRESH(s->at, n + 1) || !VS_FRESH(s->face, n + 1) ||
      !VS_FRESH(s->piece, n + 1) || !VS_FRESH(s->joined, s->edges.edge_count + 1))
    return false;
  vs_bounds b = vs_mesh_bounds(m);
  s->size = n ? vs_v3_length(vs_v3_sub(b.max, b.min)) : 0;
  s->slack = 1e-9 * s->size;
  memset(s->joined, 0, s->edges.edge_count * sizeof *s->joined);
  for (size_t e = 1; e < s->edges.edge_count; e++)
    if (s->edges.edges[e].a == s->edges.edges[e - 1].a && s->edges.edges[e].b == s->edges.edges[e - 1].b)
      return *several = true, false;
  s->faces = parts(s, is_flat, s->face);
  return s->faces != SIZE_MAX;
}

void vs_flat_net_ends(const vs_flat_net *s, uint32_t t, uint32_t e, vs_vec2 ends[2]) {
  int k = vs_flat_net_corner(s, t, e), a = (k + 1) % 3, b = (k + 2) % 3;
  bool forward = vs_mesh_edges_corner(&s->edges, t, a) == s->edges.edges[e].a;
  ends[0] = s->at[t][forward ? a : b], ends[1] = s->at[t][forward ? b : a];
}

vs_vec2 vs_flat_net_apex(const vs_flat_net *s, uint32_t t, uint32_t e, const vs_vec2 ends[2], double side) {
  const vs_mesh_edge *g = &s->edges.edges[e];
  vs_vec3 a = place(s, g->a), u = vs_v3_sub(place(s, g->b), a), w = vs_v3_sub(place(s, apex_vertex(s, t, e)), a);
  double l = vs_v3_length(u), x = l > 0 ? vs_v3_dot(w, u) / l : 0;
  double y = l > 0 ? side * vs_v3_length(vs_v3_cross(u, w)) / l : 0;
  vs_vec2 d = less(ends[1], ends[0]);
  double flat = hypot(d.x, d.y);
  if (!(flat > 0)) return ends[0];
  d.x /= flat, d.y /= flat;
  return (vs_vec2){ ends[0].x + d.x * x - d.y * y, ends[0].y + d.y * x + d.x * y };
}

static void lay_at(vs_flat_net *s, uint32_t t, uint32_t e, const vs_vec2 ends[2], double side) {
  int k = vs_flat_net_corner(s, t, e), a = (k + 1) % 3, b = (k + 2) % 3;
  bool forward = vs_mesh_edges_corner(&s->edges, t, a) == s->edges.edges[e].a;
  s->at[t][k] = vs_flat_net_apex(s, t, e, ends, side);
  s->at[t][forward ? a : b] = ends[0], s->at[t][forward ? b : a] = ends[1];
}

void vs_flat_net_lay(vs_flat_net *s, uint32_t from, uint32_t to, uint32_t e) {
  vs_vec2 ends[2];
  vs_flat_net_ends(s, from, e, ends);
  vs_vec2 third = s->at[from][vs_flat_net_corner(s, from, e)], d = less(ends[1], ends[0]), w = less(third, ends[0]);
  lay_at(s, to, e, ends, d.x * w.y - d.y * w.x >= 0 ? -1 : 1);
}

/* Places the first triangle of a part in the plane, with its corner 0 at the origin and corner 1 on +X. */
static void lay_first(vs_flat_net *s, uint32_t t) {
  uint32_t e = s->edges.of[t][2];
  bool forward = vs_mesh_edges_corner(&s->edges, t, 0) == s->edges.edges[e].a;
  double l = vs_v3_length(vs_v3_sub(vs_mesh_edges_place(&s->edges, t, 1), vs_mesh_edges_place(&s->edges, t, 0)));
  vs_vec2 zero = { 0, 0 }, end = { l, 0 }, ends[2] = { forward ? zero : end, forward ? end : zero };
  lay_at(s, t, e, ends, forward ? 1 : -1);
}

void vs_flat_net_join(vs_flat_net *s, double slack) {
  for (uint32_t e = 0; e < s->edges.edge_count; e++) {
    const vs_mesh_edge *g = &s->edges.edges[e];
    vs_vec2 a[2], b[2];
    s->joined[e] = false;
    if (g->side[1] == VS_MESH_NONE || s->piece[g->side[0]] != s->piece[g->side[1]]) continue;
    vs_flat_net_ends(s, g->side[0], e, a), vs_flat_net_ends(s, g->side[1], e, b);
    s->joined[e] = apart(a[0], b[0]) <= slack && apart(a[1], b[1]) <= slack;
  }
}

/* Places all triangles in the plane, one flat face after another. It enters a face across one edge only, so that the
 * face's triangles stay beside each other. Returns false when memory is out. */
static bool lay_all(vs_flat_net *s) {
  size_t n = s->edges.m->triangle_count;
  uint32_t *queue = vs_fresh(n + 1, sizeof *queue), *near = vs_fresh(n + 1, sizeof *near);
  bool *laid = vs_zeros(n + 1, sizeof *laid), *entered = vs_zeros(s->faces + 1, sizeof *entered);
  bool ok = queue && near && laid && entered;
  for (uint32_t i = 0; ok && i < n; i++) {
    if (laid[i]) continue;
    size_t first = 0, last = 0, open = 0;
    lay_first(s, i);
    laid[i] = entered[s->face[i]] = true, queue[last++] = i;
    while (first < last || open) {
      uint32_t t = open ? near[--open] : queue[first++];
      for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < 3; k++) {
          uint32_t e = s->edges.of[t][k];
          const vs_mesh_edge *g = &s->edges.edges[e];
          uint32_t other = g->side[g->side[0] == t];
          if (other == VS_MESH_NONE || laid[other] || (pass ? entered[s->face[other]] : s->face[other] != s->face[t]))
            continue;
          vs_flat_net_lay(s, t, other, e);
          laid[other] = entered[s->face[other]] = true;
          if (pass) queue[last++] = other;
          else near[open++] = other;
        }
    }
  }
  free(queue), free(near), free(laid), free(entered);
  return ok;
}

/* Sets angle[v] to the sum of the triangles' angles at vertex v, in radians, or to NAN for a vertex at a border. */
static void add_angles(const vs_flat_net *s, double *angle) {
  const vs_mesh *m = s->edges.m;
  for (size_t i = 0; i < m->vertex_count; i++) angle[i] = 0;
  for (uint32_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      vs_vec3 p = vs_mesh_edges_place(&s->edges, t, k);
      vs_vec3 u = vs_v3_sub(vs_mesh_edges_place(&s->edges, t, (k + 1) % 3), p);
      vs_vec3 w = vs_v3_sub(vs_mesh_edges_place(&s->edges, t, (k + 2) % 3), p);
      angle[vs_mesh_edges_corner(&s->edges, t, k)] += atan2(vs_v3_length(vs_v3_cross(u, w)), vs_v3_dot(u, w));
    }
  for (size_t e = 0; e < s->edges.edge_count; e++)
    if (s->edges.edges[e].side[1] == VS_MESH_NONE)
      angle[s->edges.edges[e].a] = angle[s->edges.edges[e].b] = NAN;
}

/* Returns the distortion of the pair of triangles t and t + 1 (t is even): the fraction by which the pair, laid flat,
 * is wider at half its length than in space. */
static double twist_of(const vs_flat_net *s, uint32_t t) {
  for (int k = 0; k < 3; k++) {
    uint32_t e = s->edges.of[t][k];
    const vs_mesh_edge *g = &s->edges.edges[e];
    if (g->side[1] == VS_MESH_NONE || (g->side[0] ^ 1U) != g->side[1] || is_flat(s, e)) continue;
    vs_vec3 a = place(s, g->a), b = place(s, g->b), p = place(s, apex_vertex(s, g->side[0], e)),
            q = place(s, apex_vertex(s, g->side[1], e));
    double most = 0; /* the straight lines of the surface may connect either pair of opposite sides, so each pair is
                      * tested */
    const vs_vec3 side[2][4] = { { a, p, q, b }, { p, b, a, q } };
    for (int i = 0; i < 2; i++) {
      const vs_vec3 *c = side[i];
      double flat = vs_v3_length(vs_v3_sub(c[1], c[0])) + vs_v3_length(vs_v3_sub(c[3], c[2]));
      double space = vs_v3_length(vs_v3_add(vs_v3_sub(c[1], c[0]), vs_v3_sub(c[3], c[2])));
      if (space > 0) most = fmax(most, flat / space - 1);
    }
    return most;
  }
  return 0;
}

bool vs_flat_net_unroll(vs_flat_net *s, vs_flatness *out) {
  double *angle = vs_fresh(s->edges.m->vertex_count + 1, sizeof *angle);
  *out = (vs_flatness){ 0 };
  s->pieces = parts(s, any, s->piece);
  if (!angle || s->pieces == SIZE_MAX || !lay_all(s)) return free(angle), false;
  add_angles(s, angle);
  for (size_t i = 0; i < s->edges.m->vertex_count; i++) {
    double off = angle[i] > 0 ? fabs(angle[i] - 2 * acos(-1)) : 0; /* at a border angle[i] is NAN, the comparison is
                                                                    * false, and `off` is 0 */
    out->worst = fmax(out->worst, off), out->curvature += off;
  }
  for (uint32_t e = 0; e < s->edges.edge_count; e++) {
    const vs_mesh_edge *g = &s->edges.edges[e];
    vs_vec2 a[2], b[2];
    if (g->side[1] == VS_MESH_NONE) continue;
    vs_flat_net_ends(s, g->side[0], e, a), vs_flat_net_ends(s, g->side[1], e, b);
    out->gap = fmax(out->gap, fmax(apart(a[0], b[0]), apart(a[1], b[1])));
  }
  for (uint32_t t = 0; t < s->edges.m->triangle_count; t += 2) out->twist = fmax(out->twist, twist_of(s, t));
  free(angle);
  vs_flat_net_join(s, 1e4 * s->slack);
  return true;
}

/* Returns true if the corners `at` of a triangle are counter-clockwise in the plane. */
static bool is_left(const vs_vec2 at[3]) {
  vs_vec2 u = less(at[1], at[0]), w = less(at[2], at[0]);
  return u.x * w.y - u.y * w.x >= 0;
}

bool vs_flat_net_borders(const vs_flat_net *s, uint32_t piece, vs_flat_border *edge, bool (*ended)(void *),
                         void *context) {
  size_t n = s->edges.m->triangle_count;
  bool(*done)[3] = vs_zeros(n + 1, sizeof *done), ok = done != NULL;
  for (uint32_t i = 0; ok && i < n; i++)
    for (int k = 0; ok && k < 3; k++) {
      if (s->piece[i] != piece || done[i][k] || s->joined[s->edges.of[i][k]]) continue;
      uint32_t t = i;
      int c = k;
      while (ok && !done[t][c]) {
        bool left = is_left(s->at[t]);
        int from = (c + (left ? 1 : 2)) % 3, to = (c + (left ? 2 : 1)) % 3;
        const vs_vec2 ends[2] = { s->at[t][from], s->at[t][to] };
        done[t][c] = true;
        ok = edge(context, t, s->edges.of[t][c], ends);
        /* The next border edge begins at the end `to` of this edge. To find it, the loop turns about `to` from triangle
         * to triangle, across joined edges. */
        uint32_t v = vs_mesh_edges_corner(&s->edges, t, to), next = s->edges.of[t][from];
        for (size_t turn = 0; s->joined[next] && turn < 3 * n; turn++) {
          const vs_mesh_edge *g = &s->edges.edges[next];
          t = g->side[g->side[0] == t];
          int apex = vs_flat_net_corner(s, t, next), at = 0;
          while (at < 2 && vs_mesh_edges_corner(&s->edges, t, at) != v) at++;
          VS_ASSERT(at != apex);
          next = s->edges.of[t][3 - apex - at]; /* continues with the edge opposite to the third corner, which is
                                                 * neither `apex` nor `at` */
        }
        c = vs_flat_net_corner(s, t, next);
      }
      ok = ok && ended(context);
    }
  free(done);
  return ok;
}
