/* Owns the way from placed leaves to integer triangles: weld, grid, vertices, planes, facets; and the check that each leaf is closed.
 *
 * The grid's step is 1, 2 or 5 times a power of ten, the least with which the cluster fits 2^25 steps either way: decimal, because
 * models are. Coordinates that differ by less than 2^-40 of the extent share one grid line: that matters only next to the middle
 * between two lines, so only coordinates there are sorted. */
#include "kernel/cluster.h"

#include <math.h>
#include <stdlib.h>

typedef struct { double at; uint32_t index; } border; /* index: 3 * vertex + axis */

typedef struct {
  VS_LIST(vs_vec3) placed;      /* in the frame, leaf after leaf */
  VS_LIST(uint32_t) starts;     /* where each leaf's vertices begin; one more */
  int32_t (*grid)[3];
  size_t grid_room;
  VS_LIST(border) borders;
  VS_LIST(uint32_t) ids;        /* point numbers of one leaf's vertices */
  VS_LIST(vs_use) edges;        /* of one leaf: from < to; face: 2 * triangle corner + reversed */
  uint32_t *scratch, *order;
  size_t scratch_room, order_room;
} soup;

static bool place(vs_kernel *k, vs_cluster *c, soup *s) {
  vs_affine *to_frame = NULL;
  size_t room = 0;
  bool ok = VS_ROOM(k, to_frame, room, c->leaf_count) && vs_frame_choose(k, c, to_frame);
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) {
    const vs_mesh *m = c->problem->leaves[c->leaves[i]].mesh;
    ok = VS_PUSH(k, s->starts, (uint32_t)s->placed.count) && VS_ROOM(k, s->placed.at, s->placed.room, s->placed.count + m->vertex_count);
    for (size_t j = 0; ok && j < m->vertex_count; j++) {
      vs_vec3 v = vs_affine_point(&to_frame[i], m->vertices[j]);
      if (!isfinite(v.x) || !isfinite(v.y) || !isfinite(v.z)) ok = vs_kernel_fail(k, VS_KERNEL_NOT_FINITE, c->leaves[i], "a corner is not at a finite place");
      else s->placed.at[s->placed.count++] = v;
    }
  }
  VS_FREE(k, to_frame, room);
  if (ok && s->placed.count >= UINT32_MAX / 4) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many vertices");
  return ok && VS_PUSH(k, s->starts, (uint32_t)s->placed.count);
}

static double coordinate(const vs_vec3 *v, int axis) { return axis == 0 ? v->x : axis == 1 ? v->y : v->z; }

static int by_place(const void *a, const void *b) {
  const border *x = a, *y = b;
  return x->at < y->at ? -1 : x->at > y->at ? 1 : x->index < y->index ? -1 : x->index > y->index;
}

static void choose_step(vs_grid *g, double half, double far) {
  double limit = (double)(1 << VS_GRID_BITS) - 2;
  double least = half / limit > far * 0x1p-51 ? half / limit : far * 0x1p-51;
  int exponent = (int)floor(log10(least > 1e-280 ? least : 1e-280));
  for (;; exponent++) {
    static const double units[3] = { 1, 2, 5 };
    for (int i = 0; i < 3; i++) {
      g->unit = exponent > 0 ? units[i] * pow(10, exponent) : units[i];
      g->scale = exponent > 0 ? 1 : pow(10, -exponent);
      if (g->unit / g->scale >= least) return;
    }
  }
}

static bool weld(vs_kernel *k, vs_cluster *c, soup *s) {
  double low[3], high[3], half = 0, far = 0;
  size_t n = s->placed.count;
  if (n == 0) return true;
  for (int a = 0; a < 3; a++) {
    low[a] = high[a] = coordinate(&s->placed.at[0], a);
    for (size_t i = 1; i < n; i++) {
      double x = coordinate(&s->placed.at[i], a);
      if (x < low[a]) low[a] = x;
      if (x > high[a]) high[a] = x;
    }
    half = fmax(half, (high[a] - low[a]) / 2);
    far = fmax(far, fmax(fabs(low[a]), fabs(high[a])));
  }
  choose_step(&c->grid, half, far);
  if (!VS_ROOM(k, s->grid, s->grid_room, n)) return false;
  for (int a = 0; a < 3; a++) {
    double scale = c->grid.scale, unit = c->grid.unit, offset = floor((low[a] + high[a]) / 2 * scale / unit);
    double near = fmax((high[a] - low[a]) * 0x1p-40, far * 0x1p-50) * scale / unit; /* in steps; far from the origin doubles are coarser */
    c->grid.offset[a] = offset;
    s->borders.count = 0;
    for (size_t i = 0; i < n; i++) {
      double x = coordinate(&s->placed.at[i], a) * scale / unit - offset, whole = floor(x + 0.5);
      s->grid[i][a] = (int32_t)whole;
      if (fabs(x - whole) > 0.5 - near && !VS_PUSH(k, s->borders, ((border){ x, (uint32_t)i }))) return false;
    }
    if (s->borders.count) qsort(s->borders.at, s->borders.count, sizeof *s->borders.at, by_place); /* equal places sort by index: one result */
    for (size_t i = 0, first = 0; i < s->borders.count; i++) {
      if (s->borders.at[i].at - s->borders.at[first].at > near) first = i;
      s->grid[s->borders.at[i].index][a] = (int32_t)floor(s->borders.at[first].at + 0.5);
    }
  }
  return true;
}

static bool edge_before(const void *context, uint32_t a, uint32_t b) {
  const vs_use *e = context, *x = &e[a], *y = &e[b];
  return x->from != y->from ? x->from < y->from : x->to < y->to;
}

/* Triangles and facets of leaf i; every edge must be walked as often one way as the other. */
static bool add_leaf(vs_kernel *k, vs_cluster *c, soup *s, uint32_t i) {
  uint32_t leaf = c->leaves[i], start = s->starts.at[i], count = s->starts.at[i + 1] - start, base = (uint32_t)c->triangles.count;
  const vs_kernel_leaf *l = &c->problem->leaves[leaf];
  bool mirrored = vs_affine_determinant(&l->placement) < 0;
  double volume = 0;
  s->ids.count = s->edges.count = 0;
  if (!VS_ROOM(k, s->ids.at, s->ids.room, count)) return false;
  for (uint32_t j = 0; j < count; j++)
    if (!vs_points_integer(k, &c->points, s->grid[start + j], &s->ids.at[j])) return false;
  for (size_t t = 0; t < l->mesh->triangle_count; t++) {
    const uint32_t *corner = l->mesh->triangles[t];
    vs_soup_triangle tri = { .leaf = leaf, .facet = VS_NONE, .source = (uint32_t)t };
    int32_t at[3][3];
    for (int j = 0; j < 3; j++) {
      uint32_t from = corner[mirrored ? 2 - j : j];
      tri.v[j] = s->ids.at[from];
      vs_points_grid(&c->points, tri.v[j], at[j]);
    }
    vs_plane plane;
    bool flat = !vs_plane_through(at[0], at[1], at[2], &plane, &tri.flip);
    uint32_t number = flat ? VS_NONE : (uint32_t)c->triangles.count;
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t a = tri.v[j], b = tri.v[(j + 1) % 3];
      if (a != b && !VS_PUSH(k, s->edges, ((vs_use){ a < b ? a : b, a < b ? b : a, flat ? VS_NONE - 1 + (a > b) : 2 * (3 * (number - base) + j) + (a > b) })))
        return false;
    }
    if (flat) continue;
    double o[3][3];
    for (int x = 0; x < 3; x++)
      for (int y = 0; y < 3; y++) o[x][y] = (double)at[x][y] - s->grid[start][y];
    volume += o[0][0] * (o[1][1] * o[2][2] - o[1][2] * o[2][1]) - o[0][1] * (o[1][0] * o[2][2] - o[1][2] * o[2][0]) + o[0][2] * (o[1][0] * o[2][1] - o[1][1] * o[2][0]);
    vs_box box;
    for (int y = 0; y < 3; y++) {
      box.min[y] = at[0][y] < at[1][y] ? at[0][y] : at[1][y];
      box.max[y] = at[0][y] > at[1][y] ? at[0][y] : at[1][y];
      if (at[2][y] < box.min[y]) box.min[y] = at[2][y];
      if (at[2][y] > box.max[y]) box.max[y] = at[2][y];
    }
    if (!vs_planes_add(k, &c->planes, &plane, &tri.plane) || !VS_PUSH(k, c->triangles, tri) || !VS_PUSH(k, c->boxes, box)) return false;
  }
  if (volume < 0 && !c->inspect) return vs_kernel_fail(k, VS_KERNEL_INSIDE_OUT, leaf, "the solid is inside out: its faces should run counter-clockwise seen from outside");

  uint32_t edges = (uint32_t)s->edges.count, triangles = (uint32_t)c->triangles.count - base;
  if (!VS_ROOM(k, s->order, s->order_room, (size_t)edges + 3u * triangles + 1) || !VS_ROOM(k, s->scratch, s->scratch_room, (size_t)edges + 1)) return false;
  for (uint32_t e = 0; e < edges; e++) s->order[e] = e;
  vs_kernel_sort(s->order, s->scratch, edges, edge_before, s->edges.at);
  uint32_t *parent = s->order + edges; /* of triangles, for facets */
  vs_soup_triangle *all = c->triangles.at + base;
  for (uint32_t t = 0; t < triangles; t++) parent[t] = t;
  for (uint32_t e = 0, end; e < edges; e = end) {
    const vs_use *first = &s->edges.at[s->order[e]];
    int balance = 0;
    for (end = e; end < edges && s->edges.at[s->order[end]].from == first->from && s->edges.at[s->order[end]].to == first->to; end++)
      balance += s->edges.at[s->order[end]].face & 1 ? 1 : -1;
    if (balance != 0)
      return vs_kernel_fail(k, VS_KERNEL_OPEN, leaf, "the solid is not closed: a face is missing, or turned the other way, along an edge");
    bool flat = false;
    for (uint32_t x = e; x < end; x++) flat = flat || s->edges.at[s->order[x]].face >= VS_NONE - 1;
    for (uint32_t x = e; flat && x < end; x++) /* a triangle that has become a line lay here: the others may have to be split along it */
      if (s->edges.at[s->order[x]].face < VS_NONE - 1) all[s->edges.at[s->order[x]].face / 6].inner |= VS_BESIDE_FLAT;
    for (uint32_t x = e; x < end; x++)
      for (uint32_t y = x + 1; y < end; y++) {
        uint32_t fx = s->edges.at[s->order[x]].face, fy = s->edges.at[s->order[y]].face;
        if (fx >= VS_NONE - 1 || fy >= VS_NONE - 1 || (fx & 1) == (fy & 1)) continue;
        vs_soup_triangle *a = &all[fx / 6], *b = &all[fy / 6];
        uint8_t abit = (uint8_t)(1u << (fx / 2 % 3)), bbit = (uint8_t)(1u << (fy / 2 % 3));
        if (a->plane != b->plane || a->flip != b->flip || (a->inner & abit) || (b->inner & bbit)) continue;
        a->inner |= abit;
        b->inner |= bbit;
        vs_unite(parent, fx / 6, fy / 6);
      }
  }
  for (uint32_t t = 0; t < triangles; t++) {
    uint32_t root = vs_find(parent, t);
    if (root == t) {
      all[t].facet = (uint32_t)c->facets.count;
      vs_facet f = { leaf, all[t].plane, 0, (uint32_t)c->facets.count, all[t].flip, false };
      if (!VS_PUSH(k, c->facets, f)) return false;
    } else {
      all[t].facet = all[root].facet; /* the root is the smallest */
    }
    if (all[t].inner & VS_BESIDE_FLAT) c->facets.at[all[t].facet].touched = true;
  }
  return true;
}

/* facet_triangles: the triangles by facet */
static bool index_facets(vs_kernel *k, vs_cluster *c) {
  size_t n = c->triangles.count, f = c->facets.count;
  vs_facet last = { .leaf = VS_NONE };
  if (!VS_PUSH(k, c->facets, last) || !VS_ROOM(k, c->facet_triangles.at, c->facet_triangles.room, n + 1)) return false;
  for (size_t t = 0; t < n; t++) c->facets.at[c->triangles.at[t].facet + 1].first++;
  for (size_t i = 1; i <= f; i++) c->facets.at[i].first += c->facets.at[i - 1].first;
  for (size_t t = n; t-- > 0;) { /* filled from the end: each bucket's end moves down to its beginning */
    uint32_t facet = c->triangles.at[t].facet;
    c->facet_triangles.at[--c->facets.at[facet + 1].first] = (uint32_t)t;
  }
  for (size_t i = 0; i < f; i++) c->facets.at[i].first = c->facets.at[i + 1].first;
  c->facets.at[f].first = (uint32_t)n;
  c->facet_triangles.count = n;
  c->facets.count = f; /* the sentinel stays readable behind it */
  return true;
}

bool vs_soup_build(vs_kernel *k, vs_cluster *c) {
  soup s = { 0 };
  bool ok = place(k, c, &s) && weld(k, c, &s);
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) ok = add_leaf(k, c, &s, i) && vs_kernel_poll(k, 0);
  ok = ok && index_facets(k, c);
  VS_DROP(k, s.placed);
  VS_DROP(k, s.starts);
  VS_FREE(k, s.grid, s.grid_room);
  VS_DROP(k, s.borders);
  VS_DROP(k, s.ids);
  VS_DROP(k, s.edges);
  VS_FREE(k, s.scratch, s.scratch_room);
  VS_FREE(k, s.order, s.order_room);
  return ok;
}
