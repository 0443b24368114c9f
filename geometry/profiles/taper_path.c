/* Makes extrusions with inclined walls along a bent curve. The straight extrusion of equal height is cut at the heights
 * of the curve's corners. Then every vertex is moved to the curve's position at its height. By Cavalieri's principle
 * the volume does not change. */
#include "geometry/profiles/taper_path.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/plane/curve.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/profiles/taper.h"
#include "model/store/array.h"

/* An entry of the hash table of cut edges. a, b: vertices at the edge's ends; at: vertex where the edge was cut. */
typedef struct { uint32_t a, b, at; } cut_point;
typedef struct { cut_point *slots; size_t room, count; } cut_table;

/* Returns the slot of the hash table that contains the edge from a to b, or a free slot if the table does not contain
 * it. t->room is a power of two. */
static cut_point *cut_slot(const cut_table *t, uint32_t a, uint32_t b) {
  size_t i = (size_t)((((uint64_t)a << 32 | b) * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (t->room - 1);
  VS_ASSERT(t->room > 0 && (t->room & (t->room - 1)) == 0);
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

/* The mesh of a straight extrusion while it is cut at heights. A height is a distance from the origin along the
 * profile's normal. */
typedef struct {
  vs_mesh *m;
  size_t first_vertex, first; /* indices in mesh m of the extrusion's first vertex and first triangle */
  vs_vec3 origin, normal;
  double near;                /* distance below which a vertex counts as lying at the height of a cut */
  cut_table table;
} cut_solid;

static double cut_height(const cut_solid *s, vs_vec3 p) { return vs_v3_dot(vs_v3_sub(p, s->origin), s->normal); }

/* A vertex and its height. */
typedef struct { uint32_t vertex; double height; } cut_end;

/* Sets *at to the vertex where an edge crosses the height; both triangles at the edge have this vertex. from, to: ends
 * of the edge, below and above. Returns false when memory is out. */
static bool cut_edge(cut_solid *s, cut_end from, cut_end to, double height, uint32_t *at) {
  uint32_t a = from.vertex, b = to.vertex;
  cut_point *p = a < b ? cut_slot(&s->table, a, b) : cut_slot(&s->table, b, a);
  VS_ASSERT((from.height < height) != (to.height < height));
  if (p->at == UINT32_MAX) {
    vs_vec3 start = s->m->vertices[a], way = vs_v3_sub(s->m->vertices[b], start);
    double share = (height - from.height) / (to.height - from.height);
    if (!vs_mesh_add_vertex(s->m, vs_v3_add(start, vs_v3_scale(way, share)), &p->at)) return false;
    p->a = a < b ? a : b, p->b = a < b ? b : a;
  }
  *at = p->at;
  return true;
}

/* Cuts all triangles of the solid at one height. Returns false when memory is out. */
static bool cut_at(cut_solid *s, double height) {
  vs_mesh *m = s->m;
  size_t end = m->triangle_count;
  if (!cut_begin(&s->table, 3 * (end - s->first))) return false;
  for (size_t i = s->first; i < end; i++) {
    double h[3];
    int side[3], up = -1;
    for (int k = 0; k < 3; k++) {
      h[k] = cut_height(s, m->vertices[m->triangles[i][k]]);
      side[k] = h[k] > height + s->near ? 1 : h[k] < height - s->near ? -1 : 0;
    }
    int sum = side[0] + side[1] + side[2], product = side[0] * side[1] * side[2];
    bool passes = product != 0 ? sum != 3 && sum != -3 : sum == 0 && (side[0] || side[1] || side[2]);
    if (!passes) continue;
    /* Finds the corner of the triangle that is alone on its side of the height, or a corner exactly at this height. */
    for (int k = 0; k < 3; k++)
      if (product != 0 ? side[k] != side[(k + 1) % 3] && side[k] != side[(k + 2) % 3] : side[k] == 0) up = k;
    int next = (up + 1) % 3, last = (up + 2) % 3;
    uint32_t a = m->triangles[i][up], b = m->triangles[i][next], c = m->triangles[i][last], p, q;
    cut_end at_a = { a, h[up] }, at_b = { b, h[next] }, at_c = { c, h[last] };
    if (product == 0) {
      if (!cut_edge(s, at_b, at_c, height, &p) || !vs_mesh_add_triangle(m, a, p, c)) return false;
      m->triangles[i][0] = a, m->triangles[i][1] = b, m->triangles[i][2] = p;
      continue;
    }
    if (!cut_edge(s, at_a, at_b, height, &p) || !cut_edge(s, at_a, at_c, height, &q)) return false;
    if (!vs_mesh_add_triangle(m, p, b, c) || !vs_mesh_add_triangle(m, p, c, q)) return false;
    m->triangles[i][0] = a, m->triangles[i][1] = p, m->triangles[i][2] = q;
  }
  return true;
}

/* Moves every vertex of the extrusion sideways, by the displacement of the curve at the vertex's height. path: corners
 * of the curve, at least two; heights: heights of these corners, ascending. */
static void move_along(const cut_solid *s, const vs_polyline *path, const double *heights) {
  vs_mesh *m = s->m;
  VS_ASSERT(s->first_vertex <= m->vertex_count && path->count >= 2);
  for (size_t i = s->first_vertex; i < m->vertex_count; i++) {
    double h = cut_height(s, m->vertices[i]);
    size_t k = 0;
    while (k + 2 < path->count && heights[k + 1] < h) k++;
    double rise = heights[k + 1] - heights[k], t = rise > 0 ? (h - heights[k]) / rise : 0;
    vs_vec3 gone = vs_v3_sub(vs_v3_add(path->at[k], vs_v3_scale(vs_v3_sub(path->at[k + 1], path->at[k]), t)),
        path->at[0]);
    m->vertices[i] = vs_v3_add(m->vertices[i], vs_v3_sub(gone, vs_v3_scale(s->normal, h)));
  }
}

bool vs_taper_path_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  vs_polyline path = { 0 };
  vs_outline o = { .count = 0 };
  cut_solid solid = { .m = out, .first = out->triangle_count, .first_vertex = out->vertex_count };
  double *heights = NULL;
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
            "do-extrude: with a taper the curve must lead away from the profile's plane at every point");
    }
    double height = ok ? heights[path.count - 1] : 0;
    ok = ok && vs_taper_straight(n, vs_v3_scale(normal, height), f, out, e);
    solid.origin = o.point, solid.normal = normal, solid.near = 1e-12 * height;
    for (size_t i = 1; ok && i + 1 < path.count; i++)
      ok = cut_at(&solid, heights[i]) || vs_error_memory(e, NULL);
    if (ok) move_along(&solid, &path, heights);
  }
done:
  free(heights);
  free(solid.table.slots);
  vs_polyline_free(&path);
  vs_outline_free(&o);
  return ok;
}
