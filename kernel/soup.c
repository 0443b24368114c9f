/* Owns the way from placed leaves to integer triangles: weld, grid, vertices, planes, facets; and that each leaf is closed.
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
  vs_affine *to_frame;          /* of each leaf */
  size_t to_frame_room;
  VS_LIST(border) borders;
  VS_LIST(uint32_t) ids;        /* point numbers of one leaf's vertices, or VS_NONE */
  VS_LIST(uint64_t) masks;      /* of one leaf's vertices */
  VS_LIST(uint32_t) number;     /* of one leaf's mesh triangles: among the cluster's, less base; FLAT, GONE */
  uint32_t *twins, *parent;
  size_t twin_room, parent_room;
} soup;
#define FLAT UINT32_MAX
#define GONE (UINT32_MAX - 1)

static bool place(vs_kernel *k, vs_cluster *c, soup *s) {
  bool ok = VS_ROOM(k, s->to_frame, s->to_frame_room, c->leaf_count) && VS_ROOM(k, c->placed.at, c->placed.room, (size_t)c->leaf_count + 1) &&
            vs_frame_choose(k, c, s->to_frame);
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) {
    const vs_mesh *m = c->problem->leaves[c->leaves[i]].mesh;
    vs_placed p = { .part = &c->parts->all.at[c->parts->of_leaf.at[c->leaves[i]]], .first = (uint32_t)s->placed.count };
    c->placed.at[c->placed.count++] = p;
    ok = VS_ROOM(k, s->placed.at, s->placed.room, s->placed.count + m->vertex_count);
    for (size_t j = 0; ok && j < m->vertex_count; j++) {
      vs_vec3 v = vs_affine_point(&s->to_frame[i], m->vertices[j]);
      if (!isfinite(v.x) || !isfinite(v.y) || !isfinite(v.z)) ok = vs_kernel_fail(k, VS_KERNEL_NOT_FINITE, c->leaves[i], "a corner is not at a finite place");
      else s->placed.at[s->placed.count++] = v;
    }
    if (ok && s->placed.count >= UINT32_MAX / 4) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many vertices");
  }
  return ok;
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
  if (!VS_ROOM(k, c->corners, c->corner_room, n)) return false;
  for (int a = 0; a < 3; a++) {
    double scale = c->grid.scale, unit = c->grid.unit, offset = floor((low[a] + high[a]) / 2 * scale / unit);
    double near = fmax((high[a] - low[a]) * 0x1p-40, far * 0x1p-50) * scale / unit; /* in steps; far from the origin doubles are coarser */
    c->grid.offset[a] = offset;
    s->borders.count = 0;
    for (size_t i = 0; i < n; i++) {
      double x = coordinate(&s->placed.at[i], a) * scale / unit - offset, whole = floor(x + 0.5);
      c->corners[i][a] = (int32_t)whole;
      if (fabs(x - whole) > 0.5 - near && !VS_PUSH(k, s->borders, ((border){ x, (uint32_t)i }))) return false;
    }
    if (s->borders.count) qsort(s->borders.at, s->borders.count, sizeof *s->borders.at, by_place); /* equal places sort by index: one result */
    for (size_t i = 0, first = 0; i < s->borders.count; i++) {
      if (s->borders.at[i].at - s->borders.at[first].at > near) first = i;
      c->corners[s->borders.at[i].index][a] = (int32_t)floor(s->borders.at[first].at + 0.5);
    }
  }
  return true;
}

/* Boxes of the leaves, in steps; and whether the middle of a star still sees all of it from inside. */
static void find_shapes(const vs_cluster *c, const soup *s) {
  double step = c->grid.unit / c->grid.scale;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    vs_placed *p = &c->placed.at[i];
    const vs_mesh *m = p->part->mesh;
    const int32_t(*at)[3] = (const int32_t(*)[3])c->corners + p->first;
    for (int a = 0; a < 3; a++) {
      p->box.min[a] = INT32_MAX;
      p->box.max[a] = INT32_MIN;
      for (size_t j = 0; j < m->vertex_count; j++) {
        if (at[j][a] < p->box.min[a]) p->box.min[a] = at[j][a];
        if (at[j][a] > p->box.max[a]) p->box.max[a] = at[j][a];
      }
    }
    p->star = p->part->star;
    if (!p->star) continue;
    vs_vec3 middle = vs_affine_point(&s->to_frame[i], p->part->middle);
    int32_t from[3];
    for (int a = 0; a < 3; a++) from[a] = (int32_t)floor(coordinate(&middle, a) / step - c->grid.offset[a] + 0.5);
    bool mirrored = vs_affine_determinant(&c->problem->leaves[c->leaves[i]].placement) < 0;
    for (size_t t = 0; p->star && t < m->triangle_count; t++) {
      const uint32_t *v = m->triangles[t];
      p->star = vs_orient3d(from, at[v[0]], at[v[mirrored ? 2 : 1]], at[v[mirrored ? 1 : 2]]) > 0;
    }
  }
}

/* Of the leaf at a place: which corners stand for which edges, see vs_twins_find. */
static bool twins_of(vs_kernel *k, vs_cluster *c, soup *s, uint32_t i, const uint32_t **twins) {
  const vs_part *part = c->placed.at[i].part;
  const vs_mesh *m = part->mesh;
  *twins = part->twins;
  if (*twins) return true;
  uint32_t open;
  for (size_t j = 0; j < m->vertex_count; j++) /* by place on the grid */
    if (!vs_points_integer(k, &c->points, c->corners[c->placed.at[i].first + j], &s->ids.at[j])) return false;
  if (!VS_ROOM(k, s->twins, s->twin_room, 3 * m->triangle_count) ||
      !vs_twins_find(k, (const uint32_t(*)[3])m->triangles, m->triangle_count, c->points.all.count, s->ids.at, s->twins, &open))
    return false;
  *twins = s->twins;
  return open == VS_NONE ||
         vs_kernel_fail(k, VS_KERNEL_OPEN, c->leaves[i], "the solid is not closed: a face is missing, or turned the other way, along an edge");
}

/* Triangles and facets of the leaf at place i. */
static bool add_leaf(vs_kernel *k, vs_cluster *c, soup *s, uint32_t i) {
  vs_placed *p = &c->placed.at[i];
  uint32_t leaf = c->leaves[i], base = (uint32_t)c->triangles.count;
  const vs_kernel_leaf *l = &c->problem->leaves[leaf];
  size_t count = l->mesh->vertex_count, n = l->mesh->triangle_count;
  bool mirrored = vs_affine_determinant(&l->placement) < 0, culled;
  const uint32_t *twins;
  if (p->part->volume < -1e-13 * p->part->outer * p->part->outer * p->part->outer && !c->inspect)
    return vs_kernel_fail(k, VS_KERNEL_INSIDE_OUT, leaf, "the solid is inside out: its faces should run counter-clockwise seen from outside");
  if (!VS_ROOM(k, s->ids.at, s->ids.room, count + 1) || !VS_ROOM(k, s->masks.at, s->masks.room, count + 1) || !VS_ROOM(k, s->number.at, s->number.room, n + 1))
    return false;
  for (size_t j = 0; j < count; j++) s->ids.at[j] = VS_NONE;
  if (!twins_of(k, c, s, i, &twins) || !vs_cull_vertices(k, c, i, s->masks.at, &culled)) return false;
  for (size_t t = 0; t < n; t++) {
    const uint32_t *corner = l->mesh->triangles[t];
    vs_soup_triangle tri = { .leaf = leaf, .facet = VS_NONE, .source = (uint32_t)t };
    if (culled && (s->masks.at[corner[0]] & s->masks.at[corner[1]] & s->masks.at[corner[2]])) {
      s->number.at[t] = GONE;
      continue;
    }
    const int32_t *at[3];
    for (int j = 0; j < 3; j++) at[j] = c->corners[p->first + corner[mirrored ? 2 - j : j]];
    vs_plane plane;
    s->number.at[t] = FLAT;
    if (!vs_plane_through(at[0], at[1], at[2], &plane, &tri.flip)) continue;
    s->number.at[t] = (uint32_t)c->triangles.count - base;
    for (int j = 0; j < 3; j++) {
      uint32_t *id = &s->ids.at[corner[mirrored ? 2 - j : j]];
      if (*id == VS_NONE && !vs_points_integer(k, &c->points, at[j], id)) return false;
      tri.v[j] = *id;
    }
    if (!vs_planes_add(k, &c->planes, &plane, &tri.plane) || !VS_PUSH(k, c->triangles, tri)) return false;
  }

  uint32_t triangles = (uint32_t)c->triangles.count - base;
  if (!VS_ROOM(k, s->parent, s->parent_room, (size_t)triangles + 1)) return false;
  uint32_t *parent = s->parent; /* of triangles, for facets */
  vs_soup_triangle *all = c->triangles.at + base;
  for (uint32_t t = 0; t < triangles; t++) parent[t] = t;
  for (uint32_t t = 0; t < triangles; t++)
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t twin = twins[3 * all[t].source + (mirrored ? (4 - j) % 3 : j)], number = twin == VS_NONE ? GONE : s->number.at[twin / 3];
      if (number == FLAT) all[t].inner |= VS_BESIDE_FLAT; /* a triangle that has become a line lies here: this one may have to be split along it */
      if (number >= GONE || number < t) continue;
      vs_soup_triangle *a = &all[t], *b = &all[number];
      uint32_t e = mirrored ? (4 - twin % 3) % 3 : twin % 3;
      if (number == t || a->plane != b->plane || a->flip != b->flip || a->v[j] != b->v[(e + 1) % 3] || a->v[(j + 1) % 3] != b->v[e]) continue;
      a->inner |= (uint8_t)(1u << j);
      b->inner |= (uint8_t)(1u << e);
      vs_unite(parent, t, number);
    }
  for (uint32_t t = 0; t < triangles; t++) {
    uint32_t root = vs_find(parent, t);
    if (root == t) {
      all[t].facet = (uint32_t)c->facets.count;
      vs_facet f = { .leaf = leaf, .place = i, .plane = all[t].plane, .group = (uint32_t)c->facets.count, .flip = all[t].flip };
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
  if (ok) find_shapes(c, &s);
  ok = ok && vs_cull_prepare(k, c, s.to_frame);
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) ok = add_leaf(k, c, &s, i) && vs_kernel_poll(k, 0);
  ok = ok && index_facets(k, c);
  VS_DROP(k, s.placed);
  VS_FREE(k, s.to_frame, s.to_frame_room);
  VS_DROP(k, s.borders);
  VS_DROP(k, s.ids);
  VS_DROP(k, s.masks);
  VS_DROP(k, s.number);
  VS_FREE(k, s.twins, s.twin_room);
  VS_FREE(k, s.parent, s.parent_room);
  return ok;
}
