/* Proves that two triangles are apart: that they share at most corners or an edge.
 *
 * Two convex sets with at most a common corner have a separating plane. The candidates are the planes of the two
 * triangles, and planes through an edge of each. The sign of a determinant is used only if it exceeds the largest
 * possible error. This error is below 8e-16 of the sum of the products' sizes (Shewchuk); the code requires 1e-14. If
 * two neighbouring triangles lie in one plane, their determinants are only rounding errors. The test then uses their
 * projections along an axis. */
#include "kernel/mesh/triangles_apart.h"

#include <math.h>

#include "kernel/mesh/bvh.h"
#include "kernel/mesh/hubs.h"
#include "kernel/threads.h"

#define SURE 1e-14

static int sign3(vs_vec3 a, vs_vec3 b, vs_vec3 c) { /* returns the sign of det(a, b, c); 0 if it is uncertain because of
                                                     * rounding errors */
  double x = b.y * c.z, y = b.z * c.y, z = b.z * c.x, u = b.x * c.z, v = b.x * c.y, w = b.y * c.x;
  double det = a.x * (x - y) + a.y * (z - u) + a.z * (v - w);
  double size = fabs(a.x) * (fabs(x) + fabs(y)) + fabs(a.y) * (fabs(z) + fabs(u)) + fabs(a.z) * (fabs(v) + fabs(w));
  return det > SURE * size ? 1 : det < -SURE * size ? -1 : 0;
}

static int sign2(const double a[2], const double b[2]) {
  double x = a[0] * b[1], y = a[1] * b[0], size = fabs(x) + fabs(y);
  return x - y > SURE * size ? 1 : x - y < -SURE * size ? -1 : 0;
}

static bool same(vs_vec3 a, vs_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* ---- two triangles with a common edge ---- */

static bool not_folded(vs_vec3 p, vs_vec3 q, vs_vec3 x, vs_vec3 y) { /* returns true if two triangles with the common
                                                                      * edge from p to q are not folded onto each other;
                                                                      * x, y: their third corners */
  if (sign3(vs_v3_sub(q, p), vs_v3_sub(x, p), vs_v3_sub(y, p)) != 0) return true;
  /* the two normals have similar directions if x and y lie on opposite sides of the edge */
  vs_vec3 e = vs_v3_sub(q, p), n = vs_v3_cross(e, vs_v3_sub(x, p)), m = vs_v3_cross(vs_v3_sub(y, p), e);
  return vs_v3_dot(n, m) > 0.1 * vs_v3_length(n) * vs_v3_length(m) && vs_v3_length(n) > 1e-12 * vs_v3_dot(e, e) &&
         vs_v3_length(m) > 1e-12 * vs_v3_dot(e, e);
}

/* ---- two triangles with a common corner ---- */

/* Returns true if the two cones point away from each other, so that the plane perpendicular to the direction from b to
 * a separates them. A cone is the corner of a triangle, given by the directions of its two edges; both cones have the
 * same tip. */
static bool cones_opposed(const vs_vec3 a[2], const vs_vec3 b[2]) {
  vs_vec3 d = vs_v3_sub(vs_v3_add(vs_v3_unit(a[0]), vs_v3_unit(a[1])), vs_v3_add(vs_v3_unit(b[0]), vs_v3_unit(b[1])));
  for (int i = 0; i < 4; i++) {
    vs_vec3 p = i < 2 ? a[i] : b[i - 2];
    double x = vs_v3_dot(d, p), size = fabs(d.x * p.x) + fabs(d.y * p.y) + fabs(d.z * p.z);
    if (!((i < 2 ? x : -x) > SURE * size)) return false;
  }
  return true;
}

static bool cones_apart(const vs_vec3 a[2], const vs_vec3 b[2]) { /* returns true if two cones with the same tip have
                                                                   * only the tip in common; each cone is the corner of
                                                                   * a triangle, given by the directions of its two
                                                                   * edges */
  int s = sign3(a[0], a[1], b[0]), t = sign3(b[0], b[1], a[0]);
  if (s && s == sign3(a[0], a[1], b[1])) return true;
  if (t && t == sign3(b[0], b[1], a[1])) return true;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      s = sign3(a[i], b[j], a[1 - i]);
      if (s && s == -sign3(a[i], b[j], b[1 - j])) return true;
    }
  /* Projects both cones (corners of triangles) along an axis. They are apart if their projections are apart and neither
   * cone contains the axis. */
  vs_vec3 n = vs_v3_cross(a[0], a[1]);
  double size[3] = { fabs(n.x), fabs(n.y), fabs(n.z) };
  int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  double c[4][2];
  for (int i = 0; i < 4; i++) {
    vs_vec3 v = i < 2 ? a[i] : b[i - 2];
    c[i][0] = axis == 0 ? v.y : axis == 1 ? v.z : v.x;
    c[i][1] = axis == 0 ? v.z : axis == 1 ? v.x : v.y;
  }
  int own[2] = { sign2(c[0], c[1]), sign2(c[2], c[3]) };
  /* Tests the lines along the four edges of the two cones, as seen along the axis. A line separates the cones if they
   * lie on opposite sides of it. */
  for (int i = 0; own[0] && own[1] && i < 4; i++) {
    int mine = i % 2 ? -own[i / 2] : own[i / 2], other = i < 2 ? 2 : 0;
    if (sign2(c[i], c[other]) == -mine && sign2(c[i], c[other + 1]) == -mine) return true;
  }
  return cones_opposed(a, b);
}

/* ---- two triangles without a common corner ---- */

/* Returns true if a plane perpendicular to d separates triangles a and b. Their corners are relative to a place
 * nearby. */
static bool parted(vs_vec3 d, const vs_vec3 a[3], const vs_vec3 b[3]) {
  double low[2], high[2], error = 0;
  for (int i = 0; i < 6; i++) {
    vs_vec3 p = i < 3 ? a[i] : b[i - 3];
    double x = vs_v3_dot(d, p), e = fabs(d.x * p.x) + fabs(d.y * p.y) + fabs(d.z * p.z);
    int s = i / 3;
    if (i % 3 == 0 || x < low[s]) low[s] = x;
    if (i % 3 == 0 || x > high[s]) high[s] = x;
    if (e > error) error = e;
  }
  return low[0] - high[1] > 2 * SURE * error || low[1] - high[0] > 2 * SURE * error;
}

bool vs_triangles_parted(const vs_vec3 a[3], const vs_vec3 b[3]) {
  vs_vec3 p[3], q[3], e[3], f[3];
  for (int i = 0; i < 3; i++) p[i] = vs_v3_sub(a[i], a[0]), q[i] = vs_v3_sub(b[i], a[0]);
  for (int i = 0; i < 3; i++) e[i] = vs_v3_sub(p[(i + 1) % 3], p[i]), f[i] = vs_v3_sub(q[(i + 1) % 3], q[i]);
  vs_vec3 n = vs_v3_cross(e[0], e[1]), m = vs_v3_cross(f[0], f[1]);
  if (parted(n, p, q) || parted(m, p, q)) return true;
  for (int i = 0; i < 3; i++)
    if (parted(vs_v3_cross(n, e[i]), p, q) || parted(vs_v3_cross(m, f[i]), p, q)) return true; /* the triangles lie
                                                                                                * nearly in one plane,
                                                                                                * so lines perpendicular
                                                                                                * to their edges are
                                                                                                * tried, too */
  for (int i = 0; i < 9; i++)
    if (parted(vs_v3_cross(e[i / 3], f[i % 3]), p, q)) return true;
  return false;
}

bool vs_triangles_apart(const vs_vec3 a[3], const vs_vec3 b[3], int *count) {
  int of_a[3], of_b[3], shared = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (same(a[i], b[j])) {
        if (shared == 2) return false;
        of_a[shared] = i, of_b[shared++] = j;
      }
  *count = shared;
  if (shared == 0) return vs_triangles_parted(a, b);
  if (shared == 2)
    return of_a[0] != of_a[1] && of_b[0] != of_b[1] &&
           not_folded(a[of_a[0]], a[of_a[1]], a[3 - of_a[0] - of_a[1]], b[3 - of_b[0] - of_b[1]]);
  vs_vec3 o = a[of_a[0]], x[2], y[2];
  for (int i = 0; i < 2; i++)
    x[i] = vs_v3_sub(a[(of_a[0] + 1 + i) % 3], o), y[i] = vs_v3_sub(b[(of_b[0] + 1 + i) % 3], o);
  return cones_apart(x, y);
}

/* ---- all pairs of a mesh ---- */

enum {
  SERIAL = 10000, /* number of triangles below which a single thread works */
  TRIANGLES = 1 << 13,
  BLOCKS = 512    /* number of blocks of boxes in one task */
};

typedef struct {
  const vs_mesh *m;
  vs_bounds all;
  double step; /* width of a step of the boxes' integer coordinates, in units of the mesh */
  VS_LIST(vs_bvh_box) boxes;
  vs_bvh bvh;
  _Atomic bool met;
  _Atomic size_t edges;
} search;
typedef struct { vs_kernel *k; const vs_mesh *m; bool met; size_t edges; } looking;

static void corners(const vs_mesh *m, uint32_t t, vs_vec3 to[3]) {
  for (int i = 0; i < 3; i++) to[i] = m->vertices[m->triangles[t][i]];
}

static bool look(void *context, uint32_t a, uint32_t b) {
  looking *l = context;
  vs_vec3 x[3], y[3];
  int shared = 0;
  corners(l->m, a, x);
  corners(l->m, b, y);
  if (!vs_kernel_poll(l->k, l->k->part)) return false;
  l->met = !vs_triangles_apart(x, y, &shared);
  l->edges += shared == 2;
  return !l->met;
}

static bool look_some(vs_kernel *k, void *context, size_t index) {
  search *s = context;
  looking l = { k, s->m, false, 0 };
  if (atomic_load(&s->met)) return true;
  if (!vs_bvh_pairs(k, &s->bvh, (uint32_t)index * BLOCKS, ((uint32_t)index + 1) * BLOCKS, look, &l) && !l.met)
    return false;
  if (l.met) atomic_store(&s->met, true);
  atomic_fetch_add(&s->edges, l.edges);
  return vs_kernel_report(k, k->part);
}

static bool box_some(vs_kernel *k, void *context, size_t index) {
  search *s = context;
  size_t begin = index * TRIANGLES,
         end = s->m->triangle_count - begin < TRIANGLES ? s->m->triangle_count : begin + TRIANGLES;
  vs_vec3 from = s->all.min;
  for (size_t t = begin; t < end; t++) {
    vs_vec3 v[3];
    vs_bounds w = vs_bounds_empty();
    corners(s->m, (uint32_t)t, v);
    for (int i = 0; i < 3; i++) vs_bounds_add(&w, v[i]);
    s->boxes.at[t] =
        (vs_bvh_box){ { (int32_t)((w.min.x - from.x) / s->step), (int32_t)((w.min.y - from.y) / s->step),
                    (int32_t)((w.min.z - from.z) / s->step) },
                  { (int32_t)((w.max.x - from.x) / s->step) + 1, (int32_t)((w.max.y - from.y) / s->step) + 1,
                    (int32_t)((w.max.z - from.z) / s->step) + 1 } };
  }
  return vs_kernel_report(k, k->part);
}

static vs_vec3 corner_at(const void *mesh, uint32_t vertex) { return ((const vs_mesh *)mesh)->vertices[vertex]; }

bool vs_mesh_is_apart(vs_kernel *k, const vs_mesh *m, bool *apart, size_t *edges) {
  search s = { .m = m, .all = vs_mesh_bounds(m) };
  vs_vec3 d = vs_v3_sub(s.all.max, s.all.min);
  double size = fmax(fmax(d.x, d.y), d.z);
  uint32_t threads = k->threads;
  s.step = size > 0 ? size * 0x1p-28 : 1;
  if (m->triangle_count < SERIAL) k->threads = 1;
  vs_fans fans = { (const uint32_t (*)[3])m->triangles, m->triangle_count, m->vertex_count, NULL, corner_at, m };
  vs_hubs hubs = { .edges = 0 };
  bool ok = m->triangle_count < UINT32_MAX && vs_hubs_find(k, &fans, &hubs);
  s.bvh.families = hubs.of.count ? hubs.of.at : NULL; /* the search for pairs of boxes skips triangles around one hub
                                                       * (vertex of very many triangles), which are proven to be
                                                       * apart */
  ok = ok && VS_ROOM(k, s.boxes.at, s.boxes.room, m->triangle_count + 1) &&
       vs_kernel_run(k, (m->triangle_count + TRIANGLES - 1) / TRIANGLES, box_some, &s) &&
       vs_bvh_build(k, &s.bvh, s.boxes.at, (uint32_t)m->triangle_count) &&
       vs_kernel_run(k, ((size_t)vs_bvh_blocks(&s.bvh) + BLOCKS - 1) / BLOCKS, look_some, &s);
  k->threads = threads;
  *apart = ok && !atomic_load(&s.met);
  *edges = atomic_load(&s.edges) + hubs.edges;
  vs_hubs_free(k, &hubs);
  vs_bvh_free(k, &s.bvh);
  VS_DROP(k, s.boxes);
  return ok;
}
