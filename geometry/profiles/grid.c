/* Makes triangle meshes of grids of points. */
#include "geometry/profiles/grid.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "model/store/array.h"

bool vs_grid_cap(const vs_cap_loops *loops, const uint32_t *row, vs_mesh *out, bool turned) {
  const size_t *sizes = loops->sizes;
  bool ok = true;
  VS_ASSERT(loops->count == 0 || !loops->hole[0]);
  for (size_t l = 0, first = 0; ok && l < loops->count;) {
    size_t end = l + 1, points = sizes[l];
    while (end < loops->count && loops->hole[end]) points += sizes[end++];
    ok = vs_triangulate(loops->at + first, sizes + l, end - l, out, row + first, turned);
    first += points;
    l = end;
  }
  return ok;
}

/* Projects the points of a row to the plane of the row's first loop, in which this loop is counter-clockwise. Returns
 * NULL if the row has no area; when memory is out, also sets *ok to false. */
static vs_vec2 *grid_flatten(const vs_quad_grid *g, const vs_vec3 *row, bool *ok) {
  vs_vec3 area = { 0, 0, 0 };
  *ok = true;
  for (size_t i = 1; i + 1 < g->sizes[0]; i++)
    area = vs_v3_add(area, vs_v3_cross(vs_v3_sub(row[i], row[0]), vs_v3_sub(row[i + 1], row[0])));
  if (!(vs_v3_length(area) > 0)) return NULL;
  vs_affine frame = vs_frame_on_axis(vs_v3(0, 0, 0), area);
  vs_vec2 *flat = vs_fresh(g->columns, sizeof *flat);
  *ok = flat != NULL;
  for (size_t i = 0; flat && i < g->columns; i++) {
    vs_vec3 d = vs_v3_sub(row[i], row[0]);
    flat[i] = (vs_vec2){ d.x * frame.m[0][0] + d.y * frame.m[1][0] + d.z * frame.m[2][0],
                         d.x * frame.m[0][1] + d.y * frame.m[1][1] + d.z * frame.m[2][1] };
  }
  return flat;
}

static bool grid_fill(const vs_quad_grid *g, const vs_vec3 *at, const uint32_t *row, vs_mesh *out, bool turned) {
  bool ok = true;
  vs_cap_loops loops = { g->flat, g->sizes, g->hole, g->loop_count };
  if (g->flat) {
    bool point = true; /* true if all points of the row coincide, as in a section with scale 0 */
    for (size_t i = 1; point && i < g->columns; i++) point = vs_v3_equal(at[i], at[0]);
    return point || vs_grid_cap(&loops, row, out, turned);
  }
  vs_vec2 *flat = grid_flatten(g, at, &ok);
  loops.at = flat;
  if (flat) ok = vs_grid_cap(&loops, row, out, turned);
  free(flat);
  return ok;
}

/* Makes the vertices of one row. at: points of the row; before, below: points and vertices of the previous row, or NULL
 * for the first row. */
static bool grid_row(const vs_quad_grid *g, const vs_vec3 *at, const vs_vec3 *before, const uint32_t *below,
                     uint32_t *row, vs_mesh *out) {
  bool ok = true;
  for (size_t l = 0, first = 0; ok && l < g->loop_count; first += g->sizes[l], l++)
    for (size_t i = first; ok && i < first + g->sizes[l]; i++) {
      if (below && vs_v3_equal(at[i], before[i])) row[i] = below[i];
      else if (i > first && vs_v3_equal(at[i], at[i - 1])) row[i] = row[i - 1];
      else if (g->round && i > first && i + 1 == first + g->sizes[l] && vs_v3_equal(at[i], at[first]))
        row[i] = row[first];
      else ok = vs_mesh_add_vertex(out, at[i], &row[i]);
    }
  return ok;
}

static bool grid_facet(vs_mesh *out, uint32_t a, uint32_t b, uint32_t c) {
  return a == b || b == c || c == a || vs_mesh_add_triangle(out, a, b, c);
}

static double grid_distance(const vs_mesh *m, uint32_t a, uint32_t b) {
  vs_vec3 d = vs_v3_sub(m->vertices[a], m->vertices[b]);
  return vs_v3_dot(d, d);
}

/* Returns true if q has a smaller coordinate than p: of x, y and z, the first one in which they differ clearly. */
static bool comes_before(vs_vec3 q, vs_vec3 p) {
  double d[3] = { q.x - p.x, q.y - p.y, q.z - p.z }, most = fmax(fabs(d[0]), fmax(fabs(d[1]), fabs(d[2])));
  int axis = 0;
  while (axis < 2 && fabs(d[axis]) < 0.37 * most) axis++;
  return d[axis] < 0;
}

bool vs_grid_cut(vs_vec3 low_p, vs_vec3 low_q, vs_vec3 high_p, vs_vec3 high_q) {
  vs_vec3 across = vs_v3_sub(high_p, low_q), other = vs_v3_sub(high_q, low_p), edge = vs_v3_sub(low_q, low_p);
  double a = vs_v3_dot(across, across), b = vs_v3_dot(other, other), equal = 1e-9 * fmax(a, b);
  if (fabs(a - b) > equal) return a < b;
  double bend = fabs(vs_v3_dot(vs_v3_cross(across, other), edge));
  return bend > 1e-12 * pow(fmax(a, b), 1.5) && comes_before(low_q, low_p);
}

bool vs_grid_mesh(const vs_quad_grid *g, vs_mesh *out) {
  size_t n = g->columns, rows = g->rows + g->joined;
  uint32_t *index = vs_fresh(3 * n + 1, sizeof *index), *low = index, *high = index ? index + n : NULL,
           *start = index ? index + 2 * n : NULL;
  bool ok = index != NULL;
  VS_ASSERT(!g->joined || !g->seam);
  for (size_t r = 0; ok && r < rows; r++) {
    bool back = r == g->rows; /* true for the last step of a closed grid, which joins the last row to the first */
    const vs_vec3 *at = g->at + (back ? 0 : r) * n;
    if (back) for (size_t i = 0; i < n; i++) high[i] = start[i];
    else if (g->seam && r && r + 1 == rows) for (size_t i = 0; i < n; i++) high[i] = start[g->seam[i]];
    else ok = grid_row(g, at, r ? at - n : NULL, r ? low : NULL, high, out);
    if (ok && !r) for (size_t i = 0; i < n; i++) start[i] = high[i];
    if (ok && g->joined && !back && r + 1 == g->rows) /* if the last row of a closed grid shares poles (single points)
                                                       * with the first row, its vertices there are those of the first
                                                       * row */
      for (size_t i = 0; i < n; i++)
        if (vs_v3_equal(at[i], g->at[i])) high[i] = start[i];
    for (size_t i = 0; ok && g->numbers && i < n; i++) g->numbers[r * n + i] = high[i];
    if (ok && g->capped && !g->joined && !g->seam && (r == 0 || r + 1 == rows))
      ok = grid_fill(g, at, high, out, r == 0);
    for (size_t l = 0, first = 0; ok && r && l < g->loop_count; first += g->sizes[l], l++)
      for (size_t i = 0; ok && i + (g->round ? 0 : 1) < g->sizes[l]; i++) {
        size_t p = first + i, q = first + (i + 1 == g->sizes[l] ? 0 : i + 1);
        bool other = g->by_number && g->by_number[r - 1]
                         ? q < p
                     : g->shared ? low[p] != low[q] && high[p] != high[q] &&
                                       vs_grid_cut(out->vertices[low[p]], out->vertices[low[q]],
                                                   out->vertices[high[p]], out->vertices[high[q]])
                         : low[p] != low[q] && high[p] != high[q] &&
                               grid_distance(out, low[q], high[p]) < grid_distance(out, low[p], high[q]) * (1 - 1e-9);
        ok = other ? grid_facet(out, low[p], low[q], high[p]) && grid_facet(out, low[q], high[q], high[p])
                   : grid_facet(out, low[p], low[q], high[q]) && grid_facet(out, low[p], high[q], high[p]);
      }
    uint32_t *swap = low;
    low = high;
    high = swap;
  }
  free(index);
  return ok;
}
