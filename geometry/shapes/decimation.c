/* Implements the simplification of meshes (decimation.h).
 *
 * A corner is removed by moving it onto a neighbour, which removes the two triangles at the edge between them. Corner
 * and neighbour must have exactly two common neighbours. No other triangle may turn by more than 60 degrees or become
 * thin. The corner must be near the triangles that replace its own; the distances of earlier removals add up. Passes
 * over all corners go on until none is removed. Each pass lists the triangles of each corner anew; within a pass,
 * corners beside a removed corner are skipped. */
#include "geometry/shapes/decimation.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"

enum { PASSES = 60, AROUND = 64 }; /* PASSES: greatest number of passes over all corners; AROUND: greatest number of
                                    * triangles at a corner that may be removed */

typedef struct {
  vs_mesh *m;
  uint32_t *first, *list; /* numbers of the triangles at corner v: list[first[v]] to list[first[v + 1] - 1] */
  double *error;          /* error[v]: upper bound for the distance from the mesh of corners that were removed beside
                           * corner v */
  bool *fixed;            /* fixed[v]: true if a neighbour of corner v was removed in this pass, so that v stays */
  uint8_t *gone;          /* gone[t]: 1 if triangle t was removed in this pass */
  double tolerance;
  size_t removed;
} decimation;

static void list_triangles(decimation *d) {
  const vs_mesh *m = d->m;
  memset(d->first, 0, (m->vertex_count + 2) * sizeof *d->first);
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) d->first[m->triangles[t][k] + 2]++;
  for (size_t v = 0; v < m->vertex_count; v++) d->first[v + 2] += d->first[v + 1];
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) d->list[d->first[m->triangles[t][k] + 1]++] = (uint32_t)t;
}

static int corner_of(const uint32_t *t, uint32_t v) { return t[0] == v ? 0 : t[1] == v ? 1 : t[2] == v ? 2 : -1; }

/* Returns the distance of p from the triangle a, b, c. */
static double to_triangle(vs_vec3 p, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  vs_vec3 n = vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a)));
  const vs_vec3 at[4] = { a, b, c, a };
  double least = INFINITY;
  bool within = true;
  for (int k = 0; k < 3; k++) {
    vs_vec3 e = vs_v3_sub(at[k + 1], at[k]), q = vs_v3_sub(p, at[k]);
    double l = vs_v3_dot(e, e), s = l > 0 ? fmin(1, fmax(0, vs_v3_dot(q, e) / l)) : 0;
    least = fmin(least, vs_v3_length(vs_v3_sub(q, vs_v3_scale(e, s))));
    within = within && vs_v3_dot(vs_v3_cross(e, q), n) >= 0;
  }
  return within ? fabs(vs_v3_dot(n, vs_v3_sub(p, a))) : least;
}

/* Returns how many corners are neighbours of v and also of u; counts at most 3. */
static int common_neighbours(const decimation *d, uint32_t v, uint32_t u) {
  uint32_t found[3];
  int count = 0;
  for (uint32_t i = d->first[v]; i < d->first[v + 1]; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t w = d->m->triangles[d->list[i]][k];
      bool both = false, known = w == v || w == u;
      for (int c = 0; c < count; c++) known = known || found[c] == w;
      for (uint32_t j = d->first[u]; !known && j < d->first[u + 1] && !both; j++)
        both = corner_of(d->m->triangles[d->list[j]], w) >= 0;
      if (both && count < 3) found[count++] = w;
    }
  return count;
}

/* Returns the distance of corner v from the triangles that replace its own if v moves onto u. Returns INFINITY if v
 * must not move onto u. */
static double cost(const decimation *d, uint32_t v, uint32_t u) {
  const vs_vec3 *p = d->m->vertices;
  double least = INFINITY;
  int shared = 0;
  for (uint32_t i = d->first[v]; i < d->first[v + 1]; i++) {
    const uint32_t *t = d->m->triangles[d->list[i]];
    int k = corner_of(t, v);
    uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    if (d->gone[d->list[i]]) return INFINITY;
    if (a == u || b == u) {
      shared++;
      continue;
    }
    vs_vec3 e = vs_v3_sub(p[b], p[a]);
    vs_vec3 old = vs_v3_cross(e, vs_v3_sub(p[v], p[a])), new = vs_v3_cross(e, vs_v3_sub(p[u], p[a]));
    double l = vs_v3_length(old) * vs_v3_length(new);
    if (!(vs_v3_dot(old, new) > .5 * l) || !(vs_v3_length(new) > 1e-3 * vs_v3_dot(e, e))) return INFINITY;
    least = fmin(least, to_triangle(p[v], p[u], p[a], p[b]));
  }
  return shared == 2 && common_neighbours(d, v, u) == 2 ? least : INFINITY;
}

/* Moves corner v onto corner u, and so removes v. error: upper bound for the distance of removed corners from the
 * mesh. */
static void collapse(decimation *d, uint32_t v, uint32_t u, double error) {
  for (uint32_t i = d->first[v]; i < d->first[v + 1]; i++) {
    uint32_t *t = d->m->triangles[d->list[i]];
    for (int k = 0; k < 3; k++) d->fixed[t[k]] = true, d->error[t[k]] = fmax(d->error[t[k]], error);
    if (corner_of(t, u) >= 0) d->gone[d->list[i]] = 1;
    else t[corner_of(t, v)] = u;
  }
  d->removed++;
}

/* Removes corner v if the tolerance and the shape of its triangles allow it. */
static void try_corner(decimation *d, uint32_t v) {
  double best = INFINITY;
  uint32_t to = 0;
  if (d->fixed[v] || d->first[v + 1] - d->first[v] > AROUND) return;
  for (uint32_t i = d->first[v]; i < d->first[v + 1]; i++) {
    const uint32_t *t = d->m->triangles[d->list[i]];
    uint32_t u = t[(corner_of(t, v) + 1) % 3];
    if (d->fixed[u]) continue;
    double c = cost(d, v, u);
    if (c < best) best = c, to = u;
  }
  if (best < INFINITY && best + d->error[v] <= d->tolerance) collapse(d, v, to, best + d->error[v]);
}

/* Gives all corners at one position the index of the first of them. Returns false when memory is out. */
static bool weld(vs_mesh *m) {
  uint32_t *place = NULL;
  bool ok = VS_FRESH(place, m->vertex_count + 1) && vs_polyface_merge(m->vertices, m->vertex_count, place);
  for (size_t t = 0; ok && t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) m->triangles[t][k] = place[m->triangles[t][k]];
  free(place);
  return ok;
}

/* Removes the corners that no triangle uses. Returns false when memory is out. */
static bool drop_unused(vs_mesh *m) {
  uint32_t *name = NULL, count = 0;
  if (!VS_FRESH(name, m->vertex_count + 1)) return false;
  for (size_t v = 0; v < m->vertex_count; v++) name[v] = UINT32_MAX;
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) name[m->triangles[t][k]] = 0;
  for (size_t v = 0; v < m->vertex_count; v++)
    if (name[v] == 0) m->vertices[count] = m->vertices[v], name[v] = count++;
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) m->triangles[t][k] = name[m->triangles[t][k]];
  m->vertex_count = count;
  free(name);
  return true;
}

bool vs_mesh_decimate(vs_mesh *m, double tolerance, vs_long_work work) {
  decimation d = { .m = m, .tolerance = tolerance };
  size_t n = m->vertex_count;
  bool ok = VS_FRESH(d.first, n + 2) && VS_FRESH(d.list, 3 * m->triangle_count + 1) && VS_FRESH(d.error, n + 1) &&
            VS_FRESH(d.fixed, n + 1) && VS_FRESH(d.gone, m->triangle_count + 1) && weld(m);
  for (size_t v = 0; ok && v < n; v++) d.error[v] = 0;
  m->settled = false;
  for (int pass = 0; ok && pass < PASSES; pass++) {
    d.removed = 0;
    memset(d.fixed, 0, n * sizeof *d.fixed), memset(d.gone, 0, m->triangle_count * sizeof *d.gone);
    ok = !work.going || work.going(work.context, (double)pass / PASSES);
    list_triangles(&d);
    for (uint32_t v = 0; ok && v < n; v++) try_corner(&d, v);
    if (ok) vs_mesh_squeeze(m, d.gone);
    if (!d.removed) break;
  }
  free(d.first), free(d.list), free(d.error), free(d.fixed), free(d.gone);
  return ok && drop_unused(m);
}
