/* Finds the feature edges of a mesh as polylines: the edges that a draughtsman would draw. */
#include "solids/feature_edges.h"

#include <stdlib.h>

#include "geometry/files/polyface.h"
#include "solids/sections.h"
#include "model/store/array.h"

static const double sharp = 0.86602540378443865; /* Cosine of 30 degrees. An edge is a feature edge if its faces differ
                                                  * by more than this angle; a line of edges ends where it turns by more
                                                  * than this angle. */

void vs_polylines_free(vs_polylines *p) {
  for (size_t i = 0; i < p->count; i++) vs_polyline_free(&p->at[i]);
  free(p->at);
  *p = (vs_polylines){ 0 };
}

typedef struct { uint64_t key; uint32_t face; bool forward; } side;
typedef struct { uint32_t from, to, edge; } arm; /* A directed feature edge: the edge `edge` leads from the vertex
                                                  * `from` to the vertex `to`. Each edge gives two. */

static int side_compare(const void *p, const void *q) {
  const side *a = p, *b = q;
  return a->key != b->key ? (a->key < b->key ? -1 : 1) : a->face < b->face ? -1 : a->face > b->face;
}
static int arm_compare(const void *p, const void *q) {
  const arm *a = p, *b = q;
  return a->from != b->from ? (a->from < b->from ? -1 : 1) : a->to < b->to ? -1 : a->to > b->to;
}

/* Returns the feature edges of m, each in both directions, sorted by their start. place[v]: first vertex at the
 * position of vertex v. *count: number of entries, twice the number of edges. Returns NULL if memory is out. */
static arm *feature_arms(const vs_mesh *m, const uint32_t *place, size_t *count) {
  size_t n = m->triangle_count, sides = 0;
  side *all = vs_fresh(3 * n + 1, sizeof *all);
  vs_vec3 *normal = vs_fresh(n + 1, sizeof *normal);
  arm *arms = vs_fresh(6 * n + 1, sizeof *arms);
  *count = 0;
  for (size_t i = 0; all && normal && i < n; i++) {
    uint32_t t[3] = { place[m->triangles[i][0]], place[m->triangles[i][1]], place[m->triangles[i][2]] };
    normal[i] = vs_v3_unit(
        vs_v3_cross(vs_v3_sub(m->vertices[t[1]], m->vertices[t[0]]), vs_v3_sub(m->vertices[t[2]], m->vertices[t[0]])));
    for (int k = 0; k < 3; k++) {
      uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a != b) all[sides++] = (side){ a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a, (uint32_t)i, a < b };
    }
  }
  if (all) qsort(all, sides, sizeof *all, side_compare);
  for (size_t i = 0, end; arms && all && normal && i < sides; i = end) {
    for (end = i; end < sides && all[end].key == all[i].key; end++) {}
    bool feature = end - i != 2;
    if (end - i == 2) {
      vs_vec3 p = normal[all[i].face], q = normal[all[i + 1].face];
      double cosine = vs_v3_dot(p, q) * (all[i].forward == all[i + 1].forward ? -1 : 1);
      feature = vs_v3_dot(p, p) > 0 && vs_v3_dot(q, q) > 0 && cosine < sharp;
    }
    if (!feature) continue;
    uint32_t a = (uint32_t)(all[i].key >> 32), b = (uint32_t)all[i].key, edge = (uint32_t)(*count / 2);
    arms[(*count)++] = (arm){ a, b, edge };
    arms[(*count)++] = (arm){ b, a, edge };
  }
  bool ok = all && normal && arms;
  free(all);
  free(normal);
  if (!ok) free(arms);
  else qsort(arms, *count, sizeof *arms, arm_compare);
  return ok ? arms : NULL;
}

/* Returns the number of feature edges at a vertex. *first: index in `arms` of the first of them. */
static size_t arms_at(const arm *arms, size_t count, uint32_t vertex, size_t *first) {
  size_t low = 0, high = count, n = 0;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (arms[middle].from < vertex) low = middle + 1;
    else high = middle;
  }
  for (*first = low; low + n < count && arms[low + n].from == vertex; n++) {}
  return n;
}

/* Returns true if a line of edges continues beyond the end of the edge `in`: exactly two edges end there, at an angle
 * of less than 30 degrees. *next: the edge with which it continues. */
static bool runs_on(const vs_mesh *m, const arm *arms, size_t count, const arm *in, const arm **next) {
  size_t first;
  if (arms_at(arms, count, in->to, &first) != 2) return false;
  *next = arms[first].edge == in->edge ? &arms[first + 1] : &arms[first];
  vs_vec3 a = vs_v3_unit(vs_v3_sub(m->vertices[in->to], m->vertices[in->from])),
          b = vs_v3_unit(vs_v3_sub(m->vertices[(*next)->to], m->vertices[in->to]));
  return vs_v3_dot(a, b) > sharp;
}

static bool add_point(vs_polyline *p, vs_vec3 at) {
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = at;
  return true;
}

/* Appends a polyline that begins with the edge `start`, and continues to its end or once around a ring. */
static bool follow(const vs_mesh *m, const arm *arms, size_t count, const arm *start, bool *used, vs_polylines *out) {
  if (!VS_GROW(out->at, out->room, out->count + 1)) return false;
  vs_polyline *p = &out->at[out->count++];
  *p = (vs_polyline){ 0 };
  bool ok = add_point(p, m->vertices[start->from]);
  const arm *at = start, *next;
  used[at->edge] = true;
  while (ok && runs_on(m, arms, count, at, &next)) {
    if (next->edge == start->edge) {
      p->closed = true;
      ok = add_point(p, m->vertices[at->to]);
      break;
    }
    if (used[next->edge]) break;
    ok = add_point(p, m->vertices[at->to]);
    at = next;
    used[at->edge] = true;
  }
  if (ok && !p->closed) ok = add_point(p, m->vertices[at->to]);
  if (p->closed && p->count > 1)
    p->count -= p->at[p->count - 1].x == p->at[0].x && p->at[p->count - 1].y == p->at[0].y &&
                p->at[p->count - 1].z == p->at[0].z;
  return ok;
}

bool vs_mesh_edges(const vs_mesh *m, vs_polylines *out, vs_error *e) {
  uint32_t *place = vs_fresh(m->vertex_count + 1, sizeof *place);
  size_t count = 0;
  bool ok = place && vs_polyface_merge(m->vertices, m->vertex_count, place);
  arm *arms = ok ? feature_arms(m, place, &count) : NULL;
  bool *used = vs_zeros(count / 2 + 1, sizeof *used);
  ok = arms && used;
  for (int pass = 0; ok && pass < 2; pass++) /* the first pass follows lines from their ends, the second pass follows
                                              * the remaining closed lines */
    for (size_t i = 0; ok && i < count; i++) {
      const arm *a = &arms[i], *next, back = { a->to, a->from, a->edge };
      if (used[a->edge] || (pass == 0 && runs_on(m, arms, count, &back, &next))) continue;
      ok = follow(m, arms, count, a, used, out);
    }
  free(place);
  free(arms);
  free(used);
  return ok || vs_error_memory(e, NULL);
}
