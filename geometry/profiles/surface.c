/* Makes grids of points into nodes of the kinds VS_GRID_MESH and VS_GRID_SURFACE. */
#include "geometry/profiles/surface.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"

typedef struct { vs_vec3 *at; size_t rows, columns; bool closed_u, closed_v; double near; } surface_grid;

/* Returns true if the points of the grid with the indices a and b nearly coincide. */
static bool surface_near(const surface_grid *g, size_t a, size_t b) {
  VS_ASSERT(a < g->rows * g->columns && b < g->rows * g->columns);
  return vs_v3_length(vs_v3_sub(g->at[a], g->at[b])) <= g->near;
}

/* Removes the last row if it repeats the first row, and the last column if it repeats the first column. */
static void surface_wrap(surface_grid *g) {
  size_t n = g->columns;
  bool same = g->rows > 3;
  for (size_t j = 0; same && j < n; j++) same = surface_near(g, j, (g->rows - 1) * n + j);
  if (same) g->closed_u = true, g->rows--;
  same = n > 3;
  for (size_t i = 0; same && i < g->rows; i++) same = surface_near(g, i * n, i * n + n - 1);
  if (!same) return;
  g->closed_v = true;
  g->columns--;
  for (size_t i = 1; i < g->rows; i++) memmove(g->at + i * g->columns, g->at + i * n, g->columns * sizeof *g->at);
}

typedef struct { double along; size_t index; } surface_border;

static int surface_border_compare(const void *a, const void *b) {
  const surface_border *p = a, *q = b;
  if (p->along != q->along) return p->along < q->along ? -1 : 1;
  return p->index < q->index ? -1 : p->index > q->index;
}

/* Finds points of the grid's border that nearly coincide, and moves them to the position of the first of them. Returns
 * false when memory is out. */
static bool surface_snap(surface_grid *g) {
  size_t count = 0, total = g->rows * g->columns;
  surface_border *border = vs_fresh(2 * (g->rows + g->columns) + 1, sizeof *border);
  if (!border) return false;
  for (size_t k = 0; k < total; k++) {
    size_t i = k / g->columns, j = k % g->columns;
    bool edge = (!g->closed_u && (i == 0 || i + 1 == g->rows)) || (!g->closed_v && (j == 0 || j + 1 == g->columns));
    vs_vec3 p = g->at[k];
    /* Sorts border points along an oblique direction, because many borders lie in a plane perpendicular to an axis,
     * where all points would be equal. */
    if (edge) border[count++] = (surface_border){ 0.6113 * p.x + 0.5307 * p.y + 0.5871 * p.z, k };
  }
  qsort(border, count, sizeof *border, surface_border_compare);
  for (size_t i = 0; i < count; i++) {
    size_t least = border[i].index;
    for (size_t k = i; k-- > 0 && border[i].along - border[k].along <= 2 * g->near;)
      if (surface_near(g, border[k].index, border[i].index) && border[k].index < least) least = border[k].index;
    for (size_t k = i + 1; k < count && border[k].along - border[i].along <= 2 * g->near; k++)
      if (surface_near(g, border[k].index, border[i].index) && border[k].index < least) least = border[k].index;
    if (least != border[i].index) g->at[border[i].index] = g->at[least];
  }
  free(border);
  return true;
}

static bool surface_facets(const surface_grid *g, const uint32_t *place, vs_mesh *out, uint32_t base) {
  size_t rows = g->rows - (g->closed_u ? 0 : 1), columns = g->columns - (g->closed_v ? 0 : 1);
  bool ok = true;
  for (size_t i = 0; i < rows; i++)
    for (size_t j = 0; ok && j < columns; j++) {
      size_t below = (i + 1) % g->rows, right = (j + 1) % g->columns;
      uint32_t a = place[i * g->columns + j], b = place[below * g->columns + j], c = place[below * g->columns + right],
               d = place[i * g->columns + right];
      bool other =
          vs_v3_length(vs_v3_sub(g->at[b], g->at[d])) < vs_v3_length(vs_v3_sub(g->at[a], g->at[c])) * (1 - 1e-9);
      uint32_t t[2][3] = { { a, b, other ? d : c }, { other ? b : a, c, d } };
      for (int k = 0; ok && k < 2; k++)
        if (t[k][0] != t[k][1] && t[k][1] != t[k][2] && t[k][2] != t[k][0])
          ok = vs_mesh_add_triangle(out, base + t[k][0], base + t[k][1], base + t[k][2]);
    }
  return ok;
}

static bool surface_append(const surface_grid *g, vs_mesh *out) {
  size_t total = g->rows * g->columns;
  uint32_t base = (uint32_t)out->vertex_count, *place = vs_fresh(total + 1, sizeof *place);
  bool ok = place && vs_polyface_merge(g->at, total, place) &&
            vs_mesh_reserve(out, out->vertex_count + total, out->triangle_count + 2 * total);
  for (size_t i = 0; ok && i < total; i++) ok = vs_mesh_add_vertex(out, g->at[i], NULL);
  ok = ok && surface_facets(g, place, out, base);
  free(place);
  return ok;
}

vs_node *vs_surface_make(vs_store *s, vs_kind kind, const vs_point_grid *grid, vs_error *e) {
  size_t count = grid->rows * grid->columns;
  surface_grid g = { vs_fresh(count + 1, sizeof *g.at), grid->rows, grid->columns, grid->closed_u, grid->closed_v, 0 };
  vs_bounds b = vs_bounds_empty();
  vs_mesh m = { 0 };
  vs_node *made = NULL;
  VS_ASSERT(grid->rows >= 2 && grid->columns >= 2);
  if (!g.at) return vs_error_memory(e, NULL), NULL;
  memcpy(g.at, grid->at, count * sizeof *g.at);
  for (size_t i = 0; i < count; i++) vs_bounds_add(&b, grid->at[i]);
  double size = vs_bounds_diagonal(&b);
  g.near = 1e-9 * size;
  surface_wrap(&g);
  if (g.rows < 3) g.closed_u = false; /* a grid with only two rows cannot be closed to a ring of rows */
  if (g.columns < 3) g.closed_v = false;
  bool ok = surface_snap(&g) && surface_append(&g, &m), known = true;
  if (ok && !(vs_mesh_area(&m) > 1e-12 * size * size)) {
    made = vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
    ok = made != NULL;
  } else if (ok) {
    struct vs_grid_mesh d = { .columns = (int32_t)g.columns, .closed_u = g.closed_u, .closed_v = g.closed_v };
    d.closed = vs_mesh_closed(&m, &known) && fabs(vs_mesh_volume(&m)) > 1e-12 * size * size * size;
    vs_points *points = known ? vs_points_new(s, g.at, g.rows * g.columns) : NULL;
    d.points = points;
    struct vs_grid_surface same = {
      .points = points, .columns = d.columns, .closed_u = d.closed_u, .closed_v = d.closed_v, .closed = d.closed
    };
    if (points) made = vs_node_new(s, kind, kind == VS_GRID_MESH ? (const void *)&d : &same, NULL, 0);
    if (points) vs_points_release(s, points);
    ok = made != NULL;
  }
  if (!ok) vs_error_memory(e, NULL);
  vs_mesh_free(&m);
  free(g.at);
  return made;
}

bool vs_surface_mesh(const vs_node *n, vs_mesh *out) {
  struct vs_grid_surface d;
  if (n->kind == VS_GRID_MESH) {
    const struct vs_grid_mesh *m = VS_AS(grid_mesh, n);
    d = (struct vs_grid_surface){
      .points = m->points, .columns = m->columns, .closed_u = m->closed_u, .closed_v = m->closed_v, .closed = m->closed
    };
  } else d = *VS_AS(grid_surface, n);
  size_t first = out->triangle_count, columns = (size_t)d.columns;
  surface_grid g = {
    (vs_vec3 *)(uintptr_t)d.points->at, columns ? d.points->count / columns : 0, columns, d.closed_u, d.closed_v, 0
  };
  if (!g.rows) return true;
  if (!surface_append(&g, out)) return false;
  if (d.closed) vs_mesh_turn_outwards(out, first);
  return true;
}
