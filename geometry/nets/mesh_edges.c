/* Implements the edges of a mesh (mesh_edges.h). */
#include "geometry/nets/mesh_edges.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"


void vs_mesh_edges_free(vs_mesh_edges *s) { free(s->corner), free(s->edges), free(s->of); }

typedef struct {
  vs_vec3 at;
  uint32_t vertex;
} placed;

static int by_place(const void *p, const void *q) {
  const placed *a = p, *b = q;
  if (a->at.x != b->at.x) return a->at.x < b->at.x ? -1 : 1;
  if (a->at.y != b->at.y) return a->at.y < b->at.y ? -1 : 1;
  if (a->at.z != b->at.z) return a->at.z < b->at.z ? -1 : 1;
  return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

typedef struct {
  uint32_t a, b, triangle, k;
} half;

static int by_ends(const void *p, const void *q) {
  const half *x = p, *y = q;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  if (x->b != y->b) return x->b < y->b ? -1 : 1;
  return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

bool vs_mesh_edges_make(vs_mesh_edges *s, const vs_mesh *m) {
  placed *p = NULL;
  half *h = NULL;
  size_t n = m->vertex_count, t = m->triangle_count;
  *s = (vs_mesh_edges){ .m = m };
  bool ok = VS_FRESH(p, n + 1) && VS_FRESH(h, 3 * t + 1) && VS_FRESH(s->corner, n + 1) &&
            VS_FRESH(s->edges, 3 * t + 1) && VS_FRESH(s->of, t + 1);
  for (uint32_t i = 0; ok && i < n; i++) p[i] = (placed){ m->vertices[i], i };
  if (ok) qsort(p, n, sizeof *p, by_place);
  for (size_t i = 0, first = 0; ok && i < n; i++) {
    if (p[i].at.x != p[first].at.x || p[i].at.y != p[first].at.y || p[i].at.z != p[first].at.z) first = i;
    s->corner[p[i].vertex] = p[first].vertex;
  }
  for (uint32_t i = 0; ok && i < t; i++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t a = vs_mesh_edges_corner(s, i, (int)(k + 1) % 3), b = vs_mesh_edges_corner(s, i, (int)(k + 2) % 3);
      h[3 * i + k] = (half){ a < b ? a : b, a < b ? b : a, i, k };
    }
  if (ok) qsort(h, 3 * t, sizeof *h, by_ends);
  for (size_t i = 0; ok && i < 3 * t; i++) {
    vs_mesh_edge *last = s->edge_count ? &s->edges[s->edge_count - 1] : NULL;
    bool second = last && last->a == h[i].a && last->b == h[i].b && last->side[1] == VS_MESH_NONE;
    if (second)
      last->side[1] = h[i].triangle;
    else
      s->edges[s->edge_count++] = (vs_mesh_edge){ h[i].a, h[i].b, { h[i].triangle, VS_MESH_NONE } };
    s->of[h[i].triangle][h[i].k] = (uint32_t)s->edge_count - 1;
  }
  free(p), free(h);
  return ok;
}

/* Returns the point of triangle t that is nearest to p. */
static vs_vec3 nearest_on(const vs_mesh_edges *s, uint32_t t, vs_vec3 p) {
  vs_vec3 a = vs_mesh_edges_place(s, t, 0), b = vs_mesh_edges_place(s, t, 1), c = vs_mesh_edges_place(s, t, 2);
  vs_vec3 corner[3] = { a, b, c }, n = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)), best = a;
  double nn = vs_v3_dot(n, n), far = INFINITY;
  bool inside = nn > 0;
  for (int k = 0; k < 3; k++) {
    vs_vec3 from = corner[k], way = vs_v3_sub(corner[(k + 1) % 3], from), d = vs_v3_sub(p, from);
    if (vs_v3_dot(vs_v3_cross(way, d), n) < 0) inside = false;
    double l = vs_v3_dot(way, way), share = l > 0 ? fmin(1, fmax(0, vs_v3_dot(d, way) / l)) : 0;
    vs_vec3 q = vs_v3_add(from, vs_v3_scale(way, share));
    double e = vs_v3_length(vs_v3_sub(p, q));
    if (e < far) far = e, best = q;
  }
  return inside ? vs_v3_sub(p, vs_v3_scale(n, vs_v3_dot(n, vs_v3_sub(p, a)) / nn)) : best;
}

uint32_t vs_mesh_edges_nearest(const vs_mesh_edges *s, vs_vec3 p, vs_vec3 *place) {
  double far = INFINITY;
  uint32_t best = 0;
  VS_ASSERT(s->m->triangle_count > 0);
  for (uint32_t t = 0; t < s->m->triangle_count; t++) {
    vs_vec3 q = nearest_on(s, t, p);
    double d = vs_v3_length(vs_v3_sub(q, p));
    if (d < far) far = d, best = t, *place = q;
  }
  return best;
}
