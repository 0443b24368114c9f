/* Converts the placed leaves of a cluster to corners on the grid. It chooses the frame and the grid, rounds the
 * vertices, and makes nearly equal coordinates equal. It then tests whether each star is still a star on the grid.
 * facets.c continues with the triangles.
 *
 * The step of the grid is 1, 2 or 5 times a power of ten. It is the smallest with which the cluster fits into 2^31
 * steps in either direction. It is decimal because the numbers in models are. A triangle that spans nearly all of the
 * cluster obliquely may have a normal of 64 bits on this grid. The next larger step is used then. Coordinates that
 * differ by less than 2^-40 of the extent must be rounded to the same grid line. They could differ only near the middle
 * between two lines, so only coordinates there are sorted. */
#include "kernel/arrange/snap_to_grid.h"

#include "kernel/arrange/cluster_frame.h"
#include "kernel/arrange/cull.h"
#include "kernel/arrange/facets.h"
#include "kernel/arrange/untouched_triangles.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct { double at; uint32_t index; } border; /* A coordinate near the middle between two grid lines. index: 3 *
                                                       * vertex + axis. */

enum { SPAN = 1 << 13 };
typedef struct {
  double low[3], high[3];
  VS_LIST(border) borders[3];   /* borders[a]: coordinates along axis a that are near the middle between two grid
                                 * lines */
} chunk;

typedef struct {
  vs_cluster *c;
  VS_LIST(vs_vec3) placed;      /* vertices of all leaves in the coordinates of the frame, one leaf after another */
  vs_affine *to_frame;          /* to_frame[i]: map of leaf i into the coordinates of the frame */
  size_t to_frame_room;
  VS_LIST(chunk) chunks;        /* ranges of SPAN vertices, each of which one task handles */
  VS_LIST(border) borders;      /* border coordinates along the current axis: those near the middle between two grid
                                 * lines */
  double near[3];               /* near[a]: coordinates along axis a that differ by less than this number of steps are
                                 * rounded to one grid line */
  double steps[3];              /* extent of the cluster along each axis, in grid steps */
} snapping;

static double coordinate(const vs_vec3 *v, int axis) { return axis == 0 ? v->x : axis == 1 ? v->y : v->z; }

static int by_place(const void *a, const void *b) {
  const border *x = a, *y = b;
  return x->at < y->at ? -1 : x->at > y->at ? 1 : x->index < y->index ? -1 : x->index > y->index;
}

/* Greatest number of steps from the middle of the cluster in either direction. Boxes that are enlarged by some steps
 * must still fit into 32-bit numbers. */
static const double MOST = (double)(INT64_C(1) << VS_GRID_BITS) - 64;

static void choose_step(vs_grid *g, double half, double far) {
  double least = half / MOST > far * 0x1p-51 ? half / MOST : far * 0x1p-51;
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

static size_t chunk_end(const snapping *s, size_t index) {
  return (index + 1) * SPAN < s->placed.count ? (index + 1) * SPAN : s->placed.count;
}

static bool place_chunk(vs_kernel *k, void *context, size_t index) {
  snapping *s = context;
  vs_cluster *c = s->c;
  chunk *to = &s->chunks.at[index];
  uint32_t leaf = 0, beyond = c->leaf_count;
  for (int a = 0; a < 3; a++) to->low[a] = INFINITY, to->high[a] = -INFINITY;
  while (beyond - leaf > 1) { /* finds, by bisection, the leaf that contains the first vertex of the chunk */
    uint32_t middle = leaf + (beyond - leaf) / 2;
    if (c->placed.at[middle].first <= index * SPAN) leaf = middle;
    else beyond = middle;
  }
  for (size_t i = index * SPAN, end = chunk_end(s, index); i < end; leaf++) {
    const vs_mesh *m = c->placed.at[leaf].part->mesh;
    size_t first = c->placed.at[leaf].first, stop = first + m->vertex_count < end ? first + m->vertex_count : end;
    for (; i < stop; i++) {
      vs_vec3 v = s->placed.at[i] = vs_affine_point(&s->to_frame[leaf], m->vertices[i - first]);
      double x[3] = { v.x, v.y, v.z };
      for (int a = 0; a < 3; a++) {
        if (!isfinite(x[a]))
          return vs_kernel_fail(k, VS_KERNEL_NOT_FINITE, c->leaves[leaf], "a corner is not at a finite place");
        if (x[a] < to->low[a]) to->low[a] = x[a];
        if (x[a] > to->high[a]) to->high[a] = x[a];
      }
    }
  }
  return vs_kernel_report(k, 0);
}

static bool place(vs_kernel *k, vs_cluster *c, snapping *s) {
  size_t sum = 0;
  if (!VS_ROOM(k, s->to_frame, s->to_frame_room, c->leaf_count) ||
      !VS_ROOM(k, c->placed.at, c->placed.room, (size_t)c->leaf_count + 1) || !vs_frame_choose(k, c, s->to_frame))
    return false;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    vs_placed p = { .part = &c->parts->all.at[c->parts->of_leaf.at[c->leaves[i]]], .first = (uint32_t)sum };
    c->placed.at[c->placed.count++] = p;
    sum += p.part->mesh->vertex_count;
    if (!vs_kernel_poll(k, 0)) return false;
    if (sum >= UINT32_MAX / 4) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many vertices");
  }
  size_t chunks = (sum + SPAN - 1) / SPAN;
  if (!VS_ROOM(k, s->placed.at, s->placed.room, sum + 1) || !VS_ROOM(k, s->chunks.at, s->chunks.room, chunks + 1))
    return false;
  s->placed.count = sum;
  s->chunks.count = chunks;
  memset(s->chunks.at, 0, (chunks + 1) * sizeof *s->chunks.at);
  return vs_kernel_run(k, s->chunks.count, place_chunk, s);
}

static bool grid_chunk(vs_kernel *k, void *context, size_t index) {
  snapping *s = context;
  const vs_grid *g = &s->c->grid;
  for (int a = 0; a < 3; a++) {
    double offset = g->offset[a], border_at = 0.5 - s->near[a];
    for (size_t i = index * SPAN, end = chunk_end(s, index); i < end; i++) {
      double x = coordinate(&s->placed.at[i], a) * g->scale / g->unit - offset, whole = floor(x + 0.5);
      s->c->corners[i][a] = (int32_t)whole;
      if (fabs(x - whole) > border_at && !VS_PUSH(k, s->chunks.at[index].borders[a], ((border){ x, (uint32_t)i })))
        return false;
    }
  }
  return vs_kernel_report(k, 0);
}

/* Returns true if each component of the normal of triangle a b c fits into 63 bits. A component is twice the area of
 * the triangle as seen along that axis, divided by a common divisor. */
static bool normal_fits(const int32_t a[3], const int32_t b[3], const int32_t c[3]) {
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    double n = ((double)b[u] - a[u]) * ((double)c[v] - a[v]) - ((double)b[v] - a[v]) * ((double)c[u] - a[u]);
    if (fabs(n) < 0x1p63 - 0x1p16) continue;
    vs_plane plane;
    bool flipped;
    return vs_plane_through(a, b, c, &plane, &flipped);
  }
  return true;
}

/* Returns true if the normals of all triangles fit into 63 bits. Only leaves that span at least 2^63 square steps in
 * two axes are tested, because the normals of smaller leaves always fit. */
static bool normals_fit(const vs_cluster *c, const snapping *s) {
  static const double SAFE = 0x1p62;
  if (s->steps[0] * s->steps[1] < SAFE && s->steps[1] * s->steps[2] < SAFE && s->steps[2] * s->steps[0] < SAFE)
    return true;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_placed *p = &c->placed.at[i];
    const vs_mesh *m = p->part->mesh;
    const int32_t(*at)[3] = (const int32_t(*)[3])c->corners + p->first;
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t v = 0; v < m->vertex_count; v++)
      for (int a = 0; a < 3; a++) low[a] = fmin(low[a], at[v][a]), high[a] = fmax(high[a], at[v][a]);
    double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    for (size_t t = 0; (x * y >= SAFE || y * z >= SAFE || z * x >= SAFE) && t < m->triangle_count; t++)
      if (!normal_fits(at[m->triangles[t][0]], at[m->triangles[t][1]], at[m->triangles[t][2]])) return false;
  }
  return true;
}

static bool weld(vs_kernel *k, vs_cluster *c, snapping *s) {
  double low[3], high[3], half = 0, far = 0;
  size_t n = s->placed.count;
  if (n == 0) return true;
  for (int a = 0; a < 3; a++) {
    low[a] = INFINITY;
    high[a] = -INFINITY;
    for (size_t i = 0; i < s->chunks.count; i++) {
      if (s->chunks.at[i].low[a] < low[a]) low[a] = s->chunks.at[i].low[a];
      if (s->chunks.at[i].high[a] > high[a]) high[a] = s->chunks.at[i].high[a];
    }
    half = fmax(half, (high[a] - low[a]) / 2);
    far = fmax(far, fmax(fabs(low[a]), fabs(high[a])));
  }
  for (bool fits = false; !fits; half *= 1.5) { /* tries the next larger decimal step, 2 or 2.5 times as wide, until all
                                                 * normals fit */
    choose_step(&c->grid, half, far);
    for (int a = 0; a < 3; a++) {
      double scale = c->grid.scale, unit = c->grid.unit;
      c->grid.offset[a] = floor((low[a] + high[a]) / 2 * scale / unit);
      /* near[a]: distance, in steps, below which coordinates count as equal. It follows from the extent, and from the
       * spacing of doubles at the distance `far` from the origin. */
      s->near[a] = fmax((high[a] - low[a]) * 0x1p-40, far * 0x1p-50) * scale / unit;
      s->steps[a] = (high[a] - low[a]) * scale / unit;
    }
    for (size_t i = 0; i < s->chunks.count; i++)
      for (int a = 0; a < 3; a++) s->chunks.at[i].borders[a].count = 0;
    if (!VS_ROOM(k, c->corners, c->corner_room, n) || !vs_kernel_run(k, s->chunks.count, grid_chunk, s)) return false;
    fits = normals_fit(c, s);
  }
  for (int a = 0; a < 3; a++) {
    s->borders.count = 0;
    for (size_t i = 0; i < s->chunks.count; i++)
      for (size_t j = 0; j < s->chunks.at[i].borders[a].count; j++)
        if (!VS_PUSH(k, s->borders, s->chunks.at[i].borders[a].at[j])) return false;
    /* Equal coordinates are sorted by index, so that the result is unique. */
    if (s->borders.count) qsort(s->borders.at, s->borders.count, sizeof *s->borders.at, by_place);
    for (size_t i = 0, first = 0; i < s->borders.count; i++) {
      if (s->borders.at[i].at - s->borders.at[first].at > s->near[a]) first = i;
      c->corners[s->borders.at[i].index][a] = (int32_t)floor(s->borders.at[first].at + 0.5);
    }
  }
  return true;
}

/* Computes the bounding box of each leaf in steps. Determines whether each star (a mesh whose middle sees every
 * triangle from inside) is still one on the grid. */
static bool find_shape(vs_kernel *k, void *context, size_t index) {
  const snapping *s = context;
  const vs_cluster *c = s->c;
  double step = c->grid.unit / c->grid.scale;
  vs_placed *p = &c->placed.at[index];
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
  if (!p->star) return true;
  vs_vec3 middle = vs_affine_point(&s->to_frame[index], p->part->middle);
  int32_t from[3];
  for (int a = 0; a < 3; a++) from[a] = (int32_t)floor(coordinate(&middle, a) / step - c->grid.offset[a] + 0.5);
  bool mirrored = vs_affine_determinant(&c->problem->leaves[c->leaves[index]].placement) < 0;
  for (size_t t = 0; p->star && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    p->star = vs_orient3d(from, at[v[0]], at[v[mirrored ? 2 : 1]], at[v[mirrored ? 1 : 2]]) > 0;
  }
  return vs_kernel_poll(k, 0);
}

bool vs_snap_to_grid(vs_kernel *k, vs_cluster *c) {
  snapping s = { .c = c };
  bool ok = place(k, c, &s) && weld(k, c, &s) && vs_kernel_run(k, c->leaf_count, find_shape, &s) &&
            vs_cull_prepare(k, c, s.to_frame);
  for (size_t i = 0; i < s.chunks.count; i++)
    for (int a = 0; a < 3; a++) VS_DROP(k, s.chunks.at[i].borders[a]);
  VS_DROP(k, s.chunks);
  VS_DROP(k, s.placed);
  VS_FREE(k, s.to_frame, s.to_frame_room);
  VS_DROP(k, s.borders);
  return ok && vs_plain_find(k, c) && vs_facets_build(k, c);
}
