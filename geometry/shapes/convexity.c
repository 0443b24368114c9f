/* Implements convexity.h. To make polygons, each triangle becomes a ring of corners. An edge between two coplanar rings
 * is removed, which joins them, if the joined ring is convex at both ends of the edge. Long edges are removed first. */
#include "geometry/shapes/convexity.h"

#include <stdlib.h>

#include "model/store/array.h"

static const double SLACK = 1e-9; /* greatest deviation that counts as 0, as a fraction of the mesh's size */

static vs_vec3 normal_of(const vs_mesh_edges *s, uint32_t t) {
  vs_vec3 a = vs_mesh_edges_place(s, t, 0), b = vs_mesh_edges_place(s, t, 1), c = vs_mesh_edges_place(s, t, 2);
  return vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)));
}

static double size_of(const vs_mesh_edges *s) {
  vs_bounds b = vs_mesh_bounds(s->m);
  return vs_bounds_diagonal(&b);
}

/* Returns the index, 0 to 2, of the corner of triangle t that does not lie on edge e. */
static int across(const vs_mesh_edges *s, uint32_t t, uint32_t e) {
  return s->of[t][0] == e ? 0 : s->of[t][1] == e ? 1 : 2;
}

/* Returns the height, above the plane of the first triangle at edge e, of the second triangle's corner that is not on
 * e. Returns INFINITY at a border, and if the triangles are folded onto each other, as where two solids touch. */
static double rise(const vs_mesh_edges *s, uint32_t e, double slack) {
  const vs_mesh_edge *g = &s->edges[e];
  if (g->side[0] == VS_MESH_NONE || g->side[1] == VS_MESH_NONE) return INFINITY;
  vs_vec3 from = vs_mesh_edges_place(s, g->side[0], 0), n = normal_of(s, g->side[0]);
  double h = vs_v3_dot(n, vs_v3_sub(vs_mesh_edges_place(s, g->side[1], across(s, g->side[1], e)), from));
  return fabs(h) <= slack && vs_v3_dot(n, normal_of(s, g->side[1])) < 0 ? INFINITY : h;
}

/* Returns true if the mesh is connected: every triangle can be reached from the first across edges. Returns false also
 * when memory is out. */
static bool in_one_piece(const vs_mesh_edges *s) {
  size_t count = 0, reached = 1;
  uint32_t *open = NULL;
  bool *seen = vs_zeros(s->m->triangle_count, sizeof *seen);
  if (seen && VS_FRESH(open, s->m->triangle_count + 1)) open[count++] = 0, seen[0] = true;
  while (count) {
    uint32_t t = open[--count];
    for (int k = 0; k < 3; k++) {
      const vs_mesh_edge *g = &s->edges[s->of[t][k]];
      uint32_t u = g->side[g->side[0] == t];
      if (u != VS_MESH_NONE && !seen[u]) seen[u] = true, open[count++] = u, reached++;
    }
  }
  free(open), free(seen);
  return reached == s->m->triangle_count;
}

bool vs_mesh_is_convex(const vs_mesh_edges *s) {
  double slack = SLACK * size_of(s);
  if (!s->m->triangle_count) return false;
  for (uint32_t e = 0; e < s->edge_count; e++)
    if (!(rise(s, e, slack) <= slack)) return false;
  /* A connected closed surface on which every edge is convex bounds a convex solid. */
  return in_one_piece(s);
}

bool vs_mesh_normal_caps(const vs_mesh_edges *s, vs_normal_cap *caps) {
  double *least = NULL;
  size_t n = s->m->vertex_count;
  if (!VS_FRESH(least, n)) return false;
  for (size_t v = 0; v < n; v++) caps[v] = (vs_normal_cap){ .angle = 0 }, least[v] = 1;
  for (uint32_t t = 0; t < s->m->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      vs_normal_cap *c = &caps[vs_mesh_edges_corner(s, t, k)];
      c->axis = vs_v3_add(c->axis, normal_of(s, t));
    }
  for (uint32_t t = 0; t < s->m->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t v = vs_mesh_edges_corner(s, t, k);
      double cosine = vs_v3_dot(vs_v3_unit(caps[v].axis), normal_of(s, t));
      if (!(cosine >= least[v])) least[v] = cosine;
    }
  for (size_t v = 0; v < n; v++) {
    caps[v].axis = vs_v3_unit(caps[v].axis);
    caps[v].angle = least[v] > 0 ? acos(fmin(least[v], 1)) : 3.14159265358979323846;
  }
  free(least);
  return true;
}

/* ---- joining triangles to polygons ---- */

void vs_convex_faces_free(vs_convex_faces *c) {
  free(c->at), free(c->starts);
  *c = (vs_convex_faces){ 0 };
}

/* A corner of a ring (polygon): its vertex, and the indices of the corners after and before it in the ring. */
typedef struct {
  uint32_t vertex, next, last;
} corner;
typedef struct {
  uint32_t edge;
  double length;
} long_edge;

static int longest_first(const void *p, const void *q) {
  const long_edge *a = p, *b = q;
  if (a->length != b->length) return a->length > b->length ? -1 : 1;
  return a->edge < b->edge ? -1 : a->edge > b->edge;
}

typedef struct {
  const vs_mesh_edges *s;
  corner *ring; /* all corners; corner k of triangle t is element 3 t + k */
  double size;
} rings;

/* Returns true if a path over the vertices a, b and c turns left at b or stays straight, as seen along `normal`.
 * Returns false if it turns right or back. */
static bool left(const rings *r, uint32_t a, uint32_t b, uint32_t c, vs_vec3 normal) {
  const vs_vec3 *v = r->s->m->vertices;
  vs_vec3 u = vs_v3_sub(v[b], v[a]), w = vs_v3_sub(v[c], v[b]);
  double turn = vs_v3_dot(vs_v3_cross(u, w), normal), slack = 1e-12 * vs_v3_length(u) * vs_v3_length(w);
  return turn > slack || (turn >= -slack && vs_v3_dot(u, w) > 0);
}

/* Removes edge e between two coplanar rings, which joins them, if the corners at both of its ends are then convex.
 * normal: normal of the plane. */
static void remove_edge(rings *r, uint32_t e, vs_vec3 normal) {
  const vs_mesh_edge *g = &r->s->edges[e];
  corner *c = r->ring;
  /* Edge e goes from corner a to corner b in one ring, and from corner p to corner q in the other. */
  uint32_t a = 3 * g->side[0] + (uint32_t)(across(r->s, g->side[0], e) + 1) % 3;
  uint32_t p = 3 * g->side[1] + (uint32_t)(across(r->s, g->side[1], e) + 1) % 3;
  uint32_t b = c[a].next, q = c[p].next;
  if (c[a].vertex != c[q].vertex || c[b].vertex != c[p].vertex) return;
  if (!left(r, c[c[a].last].vertex, c[a].vertex, c[c[q].next].vertex, normal)) return;
  if (!left(r, c[c[p].last].vertex, c[p].vertex, c[c[b].next].vertex, normal)) return;
  /* Where the two rings are joined, corner q replaces corner a, and corner b replaces corner p. */
  c[c[a].last].next = q, c[q].last = c[a].last;
  c[c[p].last].next = b, c[b].last = c[p].last;
  c[a].next = c[a].last = a, c[p].next = c[p].last = p;
}

static bool add_ring(const rings *r, uint32_t start, bool *done, vs_convex_faces *out) {
  size_t first = out->count;
  for (uint32_t i = start; !done[i]; i = r->ring[i].next) {
    done[i] = true;
    if (!VS_GROW(out->at, out->room, out->count + 1)) return false;
    out->at[out->count++] = r->s->m->vertices[r->ring[i].vertex];
  }
  if (out->count < first + 3) return out->count = first, true;
  if (!VS_GROW(out->starts, out->start_room, out->polygons + 2)) return false;
  out->starts[out->polygons] = (uint32_t)first;
  out->starts[++out->polygons] = (uint32_t)out->count;
  return true;
}

bool vs_mesh_convex_faces(const vs_mesh_edges *s, vs_convex_faces *out) {
  size_t corners = 3 * s->m->triangle_count, flat = 0;
  rings r = { .s = s, .size = size_of(s) };
  long_edge *edges = NULL;
  bool *done = vs_zeros(corners, sizeof *done);
  bool ok = done && VS_FRESH(r.ring, corners + 1) && VS_FRESH(edges, s->edge_count + 1);
  for (uint32_t i = 0; ok && i < corners; i++) {
    uint32_t t = i / 3, k = i % 3;
    r.ring[i] = (corner){ vs_mesh_edges_corner(s, t, (int)k), 3 * t + (k + 1) % 3, 3 * t + (k + 2) % 3 };
  }
  for (uint32_t e = 0; ok && e < s->edge_count; e++) {
    const vs_mesh_edge *g = &s->edges[e];
    if (!(fabs(rise(s, e, SLACK * r.size)) <= SLACK * r.size)) continue;
    edges[flat++] = (long_edge){ e, vs_v3_length(vs_v3_sub(s->m->vertices[g->a], s->m->vertices[g->b])) };
  }
  if (ok) qsort(edges, flat, sizeof *edges, longest_first);
  for (size_t i = 0; ok && i < flat; i++) remove_edge(&r, edges[i].edge, normal_of(s, s->edges[edges[i].edge].side[0]));
  for (uint32_t i = 0; ok && i < corners; i++)
    if (!done[i] && r.ring[i].next != i) ok = add_ring(&r, i, done, out);
  free(r.ring), free(edges), free(done);
  return ok;
}
