/* Implements the signed distance from a closed mesh (mesh_distance.h). */
#include "geometry/measure/mesh_distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { LEAF = 4, DEPTH = 64 };

typedef struct {
  vs_vec3 corner[3], face, edge[3], point[3]; /* point: corners of the facet; face: normal of the facet; edge[k]: normal
                                               * at the edge from corner k to the next corner; corner[k]: normal at
                                               * corner k */
} facet;
typedef struct {
  vs_bounds bounds;
  uint32_t first, count; /* first, count: range of facets in a leaf of the tree; count 0: the node is no leaf, and its
                          * children have the indices first and first + 1 */
} box;

struct vs_mesh_distance {
  facet *facets;
  box *boxes;
  size_t count, box_count;
};

void vs_mesh_distance_free(vs_mesh_distance *d) {
  if (!d) return;
  free(d->facets), free(d->boxes);
  free(d);
}

typedef struct {
  uint64_t key;
  uint32_t facet, edge;
} side;

static int compare_sides(const void *p, const void *q) {
  const side *a = p, *b = q;
  if (a->key != b->key) return a->key < b->key ? -1 : 1;
  return a->facet < b->facet ? -1 : a->facet > b->facet;
}

static bool normals(const vs_mesh *m, vs_mesh_distance *d) {
  vs_vec3 *point = NULL;
  side *sides = NULL;
  if (!VS_FRESH(point, m->vertex_count + 1) || !VS_FRESH(sides, 3 * m->triangle_count + 1)) return free(point), false;
  memset(point, 0, (m->vertex_count + 1) * sizeof *point);
  for (uint32_t i = 0; i < m->triangle_count; i++) {
    facet *f = &d->facets[i];
    const uint32_t *t = m->triangles[i];
    for (int k = 0; k < 3; k++) f->corner[k] = m->vertices[t[k]];
    f->face = vs_v3_unit(vs_v3_cross(vs_v3_sub(f->corner[1], f->corner[0]), vs_v3_sub(f->corner[2], f->corner[0])));
    for (uint32_t k = 0; k < 3; k++) {
      vs_vec3 a = vs_v3_sub(f->corner[(k + 1) % 3], f->corner[k]), b = vs_v3_sub(f->corner[(k + 2) % 3], f->corner[k]);
      double angle = atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b));
      point[t[k]] = vs_v3_add(point[t[k]], vs_v3_scale(f->face, angle));
      uint32_t p = t[k], q = t[(k + 1) % 3];
      sides[3 * i + k] = (side){ p < q ? (uint64_t)p << 32 | q : (uint64_t)q << 32 | p, i, k };
    }
  }
  qsort(sides, 3 * m->triangle_count, sizeof *sides, compare_sides);
  for (size_t i = 0, end; i < 3 * m->triangle_count; i = end) {
    vs_vec3 sum = { 0, 0, 0 };
    for (end = i; end < 3 * m->triangle_count && sides[end].key == sides[i].key; end++)
      sum = vs_v3_add(sum, d->facets[sides[end].facet].face);
    for (size_t k = i; k < end; k++) d->facets[sides[k].facet].edge[sides[k].edge] = vs_v3_unit(sum);
  }
  for (size_t i = 0; i < m->triangle_count; i++)
    for (int k = 0; k < 3; k++) d->facets[i].point[k] = vs_v3_unit(point[m->triangles[i][k]]);
  free(point), free(sides);
  return true;
}

static vs_bounds bounds_of(const facet *f, size_t count) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < count; i++)
    for (int k = 0; k < 3; k++) vs_bounds_add(&b, f[i].corner[k]);
  return b;
}

static double centre_along(const facet *f, int axis) {
  vs_vec3 s = vs_v3_add(vs_v3_add(f->corner[0], f->corner[1]), f->corner[2]);
  return axis == 0 ? s.x : axis == 1 ? s.y : s.z;
}
static int compare_x(const void *p, const void *q) {
  double a = centre_along(p, 0), b = centre_along(q, 0);
  return a < b ? -1 : a > b;
}
static int compare_y(const void *p, const void *q) {
  double a = centre_along(p, 1), b = centre_along(q, 1);
  return a < b ? -1 : a > b;
}
static int compare_z(const void *p, const void *q) {
  double a = centre_along(p, 2), b = centre_along(q, 2);
  return a < b ? -1 : a > b;
}

vs_mesh_distance *vs_mesh_distance_new(const vs_mesh *m) {
  vs_mesh_distance *d = NULL;
  if (!VS_FRESH(d, 1)) return NULL;
  *d = (vs_mesh_distance){ .count = m->triangle_count };
  bool ok =
      VS_FRESH(d->facets, m->triangle_count + 1) && VS_FRESH(d->boxes, 2 * m->triangle_count + 2) && normals(m, d);
  if (!ok) return vs_mesh_distance_free(d), NULL;
  d->boxes[d->box_count++] = (box){ bounds_of(d->facets, d->count), 0, (uint32_t)d->count };
  for (size_t i = 0; i < d->box_count; i++) { /* divides each box of the tree at the middle of its longest side, until
                                               * it contains few facets */
    box *b = &d->boxes[i];
    uint32_t first = b->first, n = b->count;
    if (n <= LEAF) continue;
    vs_vec3 size = vs_v3_sub(b->bounds.max, b->bounds.min);
    bool x = size.x >= size.y && size.x >= size.z, y = !x && size.y >= size.z;
    qsort(d->facets + first, n, sizeof *d->facets, x ? compare_x : y ? compare_y : compare_z);
    uint32_t half = n / 2;
    b->first = (uint32_t)d->box_count, b->count = 0;
    d->boxes[d->box_count++] = (box){ bounds_of(d->facets + first, half), first, half };
    d->boxes[d->box_count++] = (box){ bounds_of(d->facets + first + half, n - half), first + half, n - half };
  }
  return d;
}

/* Returns the point of facet f that is nearest to p. Sets *normal to the normal at that point (C. Ericson, Real-Time
 * Collision Detection, 5.1.5). */
static vs_vec3 nearest(const facet *f, vs_vec3 p, const vs_vec3 **normal) {
  vs_vec3 a = f->corner[0], b = f->corner[1], c = f->corner[2], ab = vs_v3_sub(b, a), ac = vs_v3_sub(c, a);
  vs_vec3 ap = vs_v3_sub(p, a), bp = vs_v3_sub(p, b), cp = vs_v3_sub(p, c);
  double d1 = vs_v3_dot(ab, ap), d2 = vs_v3_dot(ac, ap), d3 = vs_v3_dot(ab, bp), d4 = vs_v3_dot(ac, bp);
  double d5 = vs_v3_dot(ab, cp), d6 = vs_v3_dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return *normal = &f->point[0], a;
  if (d3 >= 0 && d4 <= d3) return *normal = &f->point[1], b;
  if (d6 >= 0 && d5 <= d6) return *normal = &f->point[2], c;
  double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return *normal = &f->edge[0], vs_v3_add(a, vs_v3_scale(ab, d1 / (d1 - d3)));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return *normal = &f->edge[2], vs_v3_add(a, vs_v3_scale(ac, d2 / (d2 - d6)));
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return *normal = &f->edge[1], vs_v3_add(b, vs_v3_scale(vs_v3_sub(c, b), t));
  }
  double sum = va + vb + vc;
  *normal = &f->face;
  return vs_v3_add(a, vs_v3_add(vs_v3_scale(ab, vb / sum), vs_v3_scale(ac, vc / sum)));
}

/* Returns the distance of the number `at` from the interval from low to high; 0 if it lies inside. */
static inline double outside(double low, double high, double at) {
  double below = low - at, above = at - high, off = below > above ? below : above;
  return off > 0 ? off : 0;
}

static double box_distance(const vs_bounds *b, vs_vec3 p) { /* returns the square of p's distance from the box */
  double x = outside(b->min.x, b->max.x, p.x), y = outside(b->min.y, b->max.y, p.y),
         z = outside(b->min.z, b->max.z, p.z);
  return x * x + y * y + z * z;
}

double vs_mesh_distance_at(const vs_mesh_distance *d, vs_vec3 p, vs_vec3 *slope) {
  struct {
    uint32_t box;
    double away;
  } stack[DEPTH]; /* DEPTH is enough: the traversal needs one entry for each level of the tree, and the tree has at most
                   * as many levels as the number of facets has bits. */
  int todo = 0;
  double best = INFINITY;
  vs_vec3 at = p, normal = { 0, 0, 1 };
  if (d->count) stack[todo].box = 0, stack[todo++].away = box_distance(&d->boxes[0].bounds, p);
  while (todo) {
    const box *b = &d->boxes[stack[--todo].box];
    if (stack[todo].away >= best) continue;
    for (uint32_t i = b->first; i < b->first + b->count; i++) {
      const vs_vec3 *n;
      vs_vec3 q = nearest(&d->facets[i], p, &n), way = vs_v3_sub(p, q);
      double away = vs_v3_dot(way, way);
      if (away < best) best = away, at = q, normal = *n;
    }
    if (b->count) continue;
    double low = box_distance(&d->boxes[b->first].bounds, p), high = box_distance(&d->boxes[b->first + 1].bounds, p);
    uint32_t near = low <= high ? b->first : b->first + 1, far = low <= high ? b->first + 1 : b->first;
    stack[todo].box = far, stack[todo++].away = low > high ? low : high;
    stack[todo].box = near, stack[todo++].away = low <= high ? low : high;
  }
  if (!d->count) return 0;
  vs_vec3 way = vs_v3_sub(p, at);
  double distance = sqrt(best), sign = vs_v3_dot(way, normal) < 0 ? -1 : 1;
  if (slope) *slope = distance > 0 ? vs_v3_scale(way, sign / distance) : normal;
  return sign * distance;
}
