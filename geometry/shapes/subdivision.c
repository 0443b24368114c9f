/* Implements subdivision surfaces (subdivision.h). */
#include "geometry/shapes/subdivision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

static const double full_turn = 6.28318530717958647693;

typedef struct {
  uint32_t a, b, face[2], faces;
  double sharpness;
} edge;

/* The faces of a mesh, with the edges between them. */
typedef struct {
  const vs_face_list *l;
  edge *edges;
  size_t edge_count, room;
  uint32_t *of_corner; /* of_corner[c]: index of the edge that goes from corner c of a face to the face's next corner */
  uint32_t *slots;     /* hash table with the index of an edge plus 1 in each slot; 0 marks a free slot */
  size_t size;
} topology;

static void topology_free(topology *t) {
  free(t->edges), free(t->of_corner), free(t->slots);
  *t = (topology){ 0 };
}

/* Returns the slot of the edge between the points a and b in the hash table, or a free slot if there is no such edge.
 * t->size is a power of two. */
static uint32_t *slot_of(const topology *t, uint32_t a, uint32_t b) {
  uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
  size_t k = (size_t)((key * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (t->size - 1);
  VS_ASSERT(t->size > 0 && (t->size & (t->size - 1)) == 0);
  for (; t->slots[k]; k = (k + 1) & (t->size - 1)) {
    const edge *e = &t->edges[t->slots[k] - 1];
    if ((e->a == a && e->b == b) || (e->a == b && e->b == a)) break;
  }
  return &t->slots[k];
}

static bool topology_of(const vs_face_list *l, const vs_crease *creases, size_t crease_count, topology *t) {
  *t = (topology){ .l = l, .size = 64 };
  while (t->size < 2 * l->corner_count + 2) t->size *= 2;
  if (!VS_FRESH(t->slots, t->size) || !VS_FRESH(t->of_corner, l->corner_count + 1) ||
      !VS_GROW(t->edges, t->room, l->corner_count + 1))
    return topology_free(t), false;
  memset(t->slots, 0, t->size * sizeof *t->slots);
  for (uint32_t f = 0; f < l->face_count; f++)
    for (uint32_t c = l->starts[f]; c < l->starts[f + 1]; c++) {
      uint32_t a = l->corners[c], b = l->corners[c + 1 < l->starts[f + 1] ? c + 1 : l->starts[f]];
      uint32_t *slot = slot_of(t, a, b);
      if (!*slot) {
        t->edges[t->edge_count++] = (edge){ .a = a, .b = b };
        *slot = (uint32_t)t->edge_count;
      }
      edge *e = &t->edges[*slot - 1];
      if (e->faces < 2) e->face[e->faces] = f;
      e->faces++;
      t->of_corner[c] = *slot - 1;
    }
  for (size_t i = 0; i < crease_count; i++) {
    uint32_t *slot = slot_of(t, creases[i].a, creases[i].b);
    if (*slot) t->edges[*slot - 1].sharpness = fmax(t->edges[*slot - 1].sharpness, creases[i].sharpness);
  }
  for (size_t i = 0; i < t->edge_count; i++)
    if (t->edges[i].faces != 2) t->edges[i].sharpness = INFINITY;
  return true;
}

/* Sums over the edges and faces at a point. The new position of the point is computed from them. */
typedef struct {
  uint32_t edges, faces, sharp;
  double sharpness;                  /* sum of the sharpness (number of subdivisions) of the sharp edges at the point */
  vs_vec3 neighbours, across, along; /* sums of positions at the point: neighbours: other ends of all its edges; along:
                                      * other ends of its sharp edges; across: sum over its faces */
} gathered;

static void gather_edges(const topology *t, gathered *g) {
  for (size_t i = 0; i < t->edge_count; i++) {
    const edge *e = &t->edges[i];
    for (int k = 0; k < 2; k++) {
      gathered *at = &g[k ? e->b : e->a];
      vs_vec3 other = t->l->points[k ? e->a : e->b];
      at->edges++;
      at->neighbours = vs_v3_add(at->neighbours, other);
      if (!(e->sharpness > 0)) continue;
      at->sharp++;
      at->sharpness += e->sharpness;
      at->along = vs_v3_add(at->along, other);
    }
  }
}

static vs_vec3 mix(vs_vec3 a, vs_vec3 b, double t) { return vs_v3_add(vs_v3_scale(a, 1 - t), vs_v3_scale(b, t)); }

/* Returns the position of point p after one subdivision, where sharp edges may end at p. smooth: position of p without
 * sharp edges. */
static vs_vec3 creased(const gathered *g, vs_vec3 p, vs_vec3 smooth) {
  if (g->sharp < 2) return smooth;
  vs_vec3 sharp = g->sharp > 2 ? p : vs_v3_scale(vs_v3_add(vs_v3_scale(p, 6), g->along), 1.0 / 8);
  double s = g->sharpness / g->sharp;
  return s >= 1 ? sharp : mix(smooth, sharp, s);
}

static double loop_beta(double n) {
  double c = 3.0 / 8 + cos(full_turn / n) / 4;
  return (5.0 / 8 - c * c) / n;
}

/* ---- one subdivision ---- */

typedef struct {
  vs_crease *at;
  size_t count, room;
} crease_list;

static bool face_of(vs_face_list *l, const uint32_t *corner, int n) {
  bool ok = true;
  for (int i = 0; ok && i < n; i++) ok = vs_face_list_corner(l, corner[i]);
  return ok && vs_face_list_close(l);
}

static bool step(const vs_face_list *l, const crease_list *creases, bool loop, vs_face_list *out, crease_list *less) {
  topology t;
  gathered *g = NULL;
  vs_vec3 *middle = NULL; /* middle[f]: centroid of the corners of face f */
  if (!topology_of(l, creases->at, creases->count, &t)) return false;
  bool ok = VS_FRESH(g, l->point_count + 1) && VS_FRESH(middle, l->face_count + 1);
  if (ok) memset(g, 0, (l->point_count + 1) * sizeof *g), gather_edges(&t, g);
  for (size_t f = 0; ok && f < l->face_count; f++) {
    vs_vec3 sum = { 0, 0, 0 };
    for (uint32_t c = l->starts[f]; c < l->starts[f + 1]; c++) sum = vs_v3_add(sum, l->points[l->corners[c]]);
    middle[f] = vs_v3_scale(sum, 1.0 / (l->starts[f + 1] - l->starts[f]));
    for (uint32_t c = l->starts[f]; c < l->starts[f + 1]; c++) {
      gathered *at = &g[l->corners[c]];
      at->faces++;
      at->across = vs_v3_add(at->across, middle[f]);
    }
  }
  for (size_t i = 0; ok && i < l->point_count; i++) {
    vs_vec3 p = l->points[i], smooth = p;
    double n = g[i].edges;
    if (n > 0 && loop) {
      double beta = loop_beta(n);
      smooth = vs_v3_add(vs_v3_scale(p, 1 - n * beta), vs_v3_scale(g[i].neighbours, beta));
    } else if (n > 0) { /* The new position is (F + 2 R + (n - 3) P) / n. P is the old position, and n the number of
                         * faces at the point. F is the mean of their centroids, and R the mean of the midpoints of the
                         * point's edges. */
      vs_vec3 r = vs_v3_scale(vs_v3_add(vs_v3_scale(p, n), g[i].neighbours), 1 / (2 * n));
      vs_vec3 f = vs_v3_scale(g[i].across, 1.0 / g[i].faces);
      smooth = vs_v3_scale(vs_v3_add(vs_v3_add(f, vs_v3_scale(r, 2)), vs_v3_scale(p, n - 3)), 1 / n);
    }
    ok = vs_face_list_point(out, creased(&g[i], p, smooth));
  }
  uint32_t first_edge = (uint32_t)l->point_count, first_face = first_edge + (uint32_t)t.edge_count;
  for (size_t i = 0; ok && i < t.edge_count; i++) {
    const edge *e = &t.edges[i];
    vs_vec3 a = l->points[e->a], b = l->points[e->b], straight = vs_v3_scale(vs_v3_add(a, b), .5), smooth = straight;
    if (e->faces == 2 && !loop) {
      smooth = vs_v3_scale(vs_v3_add(vs_v3_add(a, b), vs_v3_add(middle[e->face[0]], middle[e->face[1]])), .25);
    } else if (e->faces == 2) { /* Computes the two corners opposite the edge from the triangles' centroids: the sum of
                                 * these corners is three times the sum of the centroids minus twice the sum of the
                                 * edge's ends. */
      vs_vec3 c = vs_v3_scale(vs_v3_add(middle[e->face[0]], middle[e->face[1]]), 3);
      vs_vec3 both = vs_v3_sub(c, vs_v3_scale(vs_v3_add(a, b), 2));
      smooth = vs_v3_add(vs_v3_scale(vs_v3_add(a, b), 3.0 / 8), vs_v3_scale(both, 1.0 / 8));
    }
    double s = e->sharpness;
    ok = vs_face_list_point(out, s >= 1 ? straight : mix(smooth, straight, s));
    if (!ok || !(s > 1)) continue;
    ok = VS_GROW(less->at, less->room, less->count + 2);
    if (!ok) break;
    less->at[less->count++] = (vs_crease){ e->a, first_edge + (uint32_t)i, s - 1 };
    less->at[less->count++] = (vs_crease){ e->b, first_edge + (uint32_t)i, s - 1 };
  }
  for (size_t f = 0; ok && !loop && f < l->face_count; f++) ok = vs_face_list_point(out, middle[f]);
  for (uint32_t f = 0; ok && f < l->face_count; f++) {
    uint32_t start = l->starts[f], end = l->starts[f + 1];
    if (loop) {
      const uint32_t *c = l->corners + start, *e = t.of_corner + start;
      uint32_t m[3] = { first_edge + e[0], first_edge + e[1], first_edge + e[2] };
      const uint32_t faces[4][3] = {
        { c[0], m[0], m[2] }, { m[0], c[1], m[1] }, { m[2], m[1], c[2] }, { m[0], m[1], m[2] }
      };
      for (int k = 0; ok && k < 4; k++) ok = face_of(out, faces[k], 3);
      continue;
    }
    for (uint32_t c = start; ok && c < end; c++) {
      uint32_t before = t.of_corner[c > start ? c - 1 : end - 1];
      const uint32_t quad[4] = { l->corners[c], first_edge + t.of_corner[c], first_face + f, first_edge + before };
      ok = face_of(out, quad, 4);
    }
  }
  topology_free(&t);
  free(g), free(middle);
  return ok;
}

/* ---- limit positions ---- */

static bool to_limit(vs_face_list *l, const crease_list *creases, bool loop) {
  topology t;
  gathered *g = NULL;
  vs_vec3 *moved = NULL;
  if (!topology_of(l, creases->at, creases->count, &t)) return false;
  bool ok = VS_FRESH(g, l->point_count + 1) && VS_FRESH(moved, l->point_count + 1);
  if (ok) memset(g, 0, (l->point_count + 1) * sizeof *g), gather_edges(&t, g);
  for (size_t f = 0; ok && !loop && f < l->face_count; f++) { /* for each corner of a quadrilateral, adds the opposite
                                                               * corner to the sum of that corner */
    const uint32_t *c = l->corners + l->starts[f];
    for (int k = 0; k < 4; k++) g[c[k]].across = vs_v3_add(g[c[k]].across, l->points[c[(k + 2) % 4]]);
  }
  for (size_t i = 0; ok && i < l->point_count; i++) {
    vs_vec3 p = l->points[i];
    double n = g[i].edges;
    moved[i] = p;
    if (g[i].sharp > 2 || !(n > 0)) continue;
    if (g[i].sharp == 2) {
      moved[i] = vs_v3_scale(vs_v3_add(vs_v3_scale(p, 4), g[i].along), 1.0 / 6);
    } else if (loop) {
      double chi = 1 / (3 / (8 * loop_beta(n)) + n);
      moved[i] = vs_v3_add(vs_v3_scale(p, 1 - n * chi), vs_v3_scale(g[i].neighbours, chi));
    } else {
      vs_vec3 sum = vs_v3_add(vs_v3_scale(p, n * n), vs_v3_add(vs_v3_scale(g[i].neighbours, 4), g[i].across));
      moved[i] = vs_v3_scale(sum, 1 / (n * (n + 5)));
    }
  }
  if (ok && l->point_count) memcpy(l->points, moved, l->point_count * sizeof *moved);
  topology_free(&t);
  free(g), free(moved);
  return ok;
}

/* Divides each polygon of l into a fan of triangles. Returns false when memory is out. */
static bool fans(vs_face_list *l) {
  vs_face_list out = { 0 };
  bool ok = true;
  for (size_t i = 0; ok && i < l->point_count; i++) ok = vs_face_list_point(&out, l->points[i]);
  for (size_t f = 0; ok && f < l->face_count; f++)
    for (uint32_t c = l->starts[f] + 1; ok && c + 1 < l->starts[f + 1]; c++)
      ok = face_of(&out, (const uint32_t[]){ l->corners[l->starts[f]], l->corners[c], l->corners[c + 1] }, 3);
  vs_face_list_free(l);
  *l = out;
  return ok;
}

bool vs_subdivide(vs_face_list *l, const vs_subdivision *how, vs_long_work work) {
  bool loop = how->scheme == VS_SUBDIVIDE_LOOP, ok = !loop || fans(l);
  crease_list now = { 0 };
  VS_ASSERT(how->levels >= 0);
  ok = ok && VS_GROW(now.at, now.room, how->crease_count + 1);
  if (ok && how->crease_count) memcpy(now.at, how->creases, how->crease_count * sizeof *now.at);
  if (ok) now.count = how->crease_count;
  for (int i = 0; ok && i < how->levels; i++) {
    vs_face_list finer = { 0 };
    crease_list less = { 0 };
    ok = work.going(work.context, (double)i / how->levels) && step(l, &now, loop, &finer, &less);
    vs_face_list_free(l);
    free(now.at);
    *l = finer, now = less;
  }
  ok = ok && (!how->limit || to_limit(l, &now, loop));
  free(now.at);
  return ok;
}
