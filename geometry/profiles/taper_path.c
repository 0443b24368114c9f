/* Owns extrusions with a taper along a bent curve: the straight one of the same height, cut at the heights of the
 * curve's corners, and every height moved to where the curve is there. By Cavalieri's principle it has the volume of
 * the straight one. */
#include "geometry/profiles/taper_path.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/plane/curve.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/profiles/taper.h"
#include "model/store/array.h"

/* Points that cutting has put on edges: an open table by the edge's two ends. */
typedef struct { uint32_t a, b, at; } cut_point;
typedef struct { cut_point *slots; size_t room, count; } cut_table;

static cut_point *cut_slot(const cut_table *t, uint32_t a, uint32_t b) {
  size_t i = (size_t)((((uint64_t)a << 32 | b) * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (t->room - 1);
  while (t->slots[i].at != UINT32_MAX && (t->slots[i].a != a || t->slots[i].b != b)) i = (i + 1) & (t->room - 1);
  return &t->slots[i];
}

static bool cut_begin(cut_table *t, size_t edges) {
  size_t room = 64;
  while (room < 2 * edges) room *= 2;
  if (room > t->room) {
    free(t->slots);
    t->slots = vs_fresh(room, sizeof *t->slots);
    t->room = t->slots ? room : 0;
  }
  if (!t->slots) return false;
  memset(t->slots, 0xff, t->room * sizeof *t->slots);
  return true;
}

/* The vertex where the edge from a to b passes the height, one for both of its triangles. False: out of memory. */
static bool cut_edge(cut_table *t, vs_mesh *m, uint32_t a, uint32_t b, double ha, double hb, double height,
    uint32_t *at) {
  cut_point *p = a < b ? cut_slot(t, a, b) : cut_slot(t, b, a);
  if (p->at == UINT32_MAX) {
    vs_vec3 from = m->vertices[a], to = m->vertices[b];
    if (!vs_mesh_add_vertex(m, vs_v3_add(from, vs_v3_scale(vs_v3_sub(to, from), (height - ha) / (hb - ha))),
        &p->at)) return false;
    p->a = a < b ? a : b, p->b = a < b ? b : a;
  }
  *at = p->at;
  return true;
}

/* Cuts the triangles from `first` on at one height above the origin along the normal; what is within `near` of it
 * lies on it. */
static bool cut_at(vs_mesh *m, size_t first, vs_vec3 origin, vs_vec3 normal, double height, double near, cut_table *t) {
  size_t end = m->triangle_count;
  if (!cut_begin(t, 3 * (end - first))) return false;
  for (size_t i = first; i < end; i++) {
    double h[3];
    int side[3], up = -1;
    for (int k = 0; k < 3; k++) {
      h[k] = vs_v3_dot(vs_v3_sub(m->vertices[m->triangles[i][k]], origin), normal);
      side[k] = h[k] > height + near ? 1 : h[k] < height - near ? -1 : 0;
    }
    int sum = side[0] + side[1] + side[2], product = side[0] * side[1] * side[2];
    bool passes = product != 0 ? sum != 3 && sum != -3 : sum == 0 && (side[0] || side[1] || side[2]);
    if (!passes) continue;
    /* the corner that is alone on its side, or on the height itself where one is */
    for (int k = 0; k < 3; k++)
      if (product != 0 ? side[k] != side[(k + 1) % 3] && side[k] != side[(k + 2) % 3] : side[k] == 0) up = k;
    uint32_t a = m->triangles[i][up], b = m->triangles[i][(up + 1) % 3], c = m->triangles[i][(up + 2) % 3], p, q;
    double ha = h[up], hb = h[(up + 1) % 3], hc = h[(up + 2) % 3];
    if (product == 0) {
      if (!cut_edge(t, m, b, c, hb, hc, height, &p) || !vs_mesh_add_triangle(m, a, p, c)) return false;
      m->triangles[i][0] = a, m->triangles[i][1] = b, m->triangles[i][2] = p;
      continue;
    }
    if (!cut_edge(t, m, a, b, ha, hb, height, &p) || !cut_edge(t, m, a, c, ha, hc, height, &q)) return false;
    if (!vs_mesh_add_triangle(m, p, b, c) || !vs_mesh_add_triangle(m, p, c, q)) return false;
    m->triangles[i][0] = a, m->triangles[i][1] = p, m->triangles[i][2] = q;
  }
  return true;
}

/* Moves every vertex from `first` on by what the curve has gone at its height. path: its corners; heights: theirs,
 * rising. */
static void move_along(vs_mesh *m, size_t first, vs_vec3 origin, vs_vec3 normal, const vs_polyline *path,
    const double *heights) {
  for (size_t i = first; i < m->vertex_count; i++) {
    double h = vs_v3_dot(vs_v3_sub(m->vertices[i], origin), normal);
    size_t k = 0;
    while (k + 2 < path->count && heights[k + 1] < h) k++;
    double rise = heights[k + 1] - heights[k], t = rise > 0 ? (h - heights[k]) / rise : 0;
    vs_vec3 gone = vs_v3_sub(vs_v3_add(path->at[k], vs_v3_scale(vs_v3_sub(path->at[k + 1], path->at[k]), t)),
        path->at[0]);
    m->vertices[i] = vs_v3_add(m->vertices[i], vs_v3_sub(gone, vs_v3_scale(normal, h)));
  }
}

bool vs_taper_path_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  vs_polyline path = { 0 };
  vs_outline o = { .count = 0 };
  cut_table table = { 0 };
  double *heights = NULL;
  size_t first = out->triangle_count, first_vertex = out->vertex_count;
  bool ok = vs_region_outline(n->children[0].node, f, &o, e) && vs_curve_sample(n->children[1].node, f, &path, e);
  if (ok && (o.count == 0 || path.count < 2)) goto done;
  ok = ok && ((heights = vs_fresh(path.count, sizeof *heights)) != NULL || vs_error_memory(e, NULL));
  if (ok) {
    vs_vec3 normal = o.normal;
    if (vs_v3_dot(vs_v3_sub(path.at[path.count - 1], path.at[0]), normal) < 0) normal = vs_v3_scale(normal, -1);
    for (size_t i = 0; ok && i < path.count; i++) {
      heights[i] = vs_v3_dot(vs_v3_sub(path.at[i], path.at[0]), normal);
      if (i > 0 && !(heights[i] > heights[i - 1]))
        ok = vs_error_set(e, VS_ERROR_MODEL, NULL,
            "do-extrude: with a taper the curve must lead away from the profile's plane all the way");
    }
    double height = ok ? heights[path.count - 1] : 0;
    ok = ok && vs_taper_straight(n, vs_v3_scale(normal, height), f, out, e);
    for (size_t i = 1; ok && i + 1 < path.count; i++)
      ok = cut_at(out, first, o.point, normal, heights[i], 1e-12 * height, &table) || vs_error_memory(e, NULL);
    if (ok) move_along(out, first_vertex, o.point, normal, &path, heights);
  }
done:
  free(heights);
  free(table.slots);
  vs_polyline_free(&path);
  vs_outline_free(&o);
  return ok;
}
