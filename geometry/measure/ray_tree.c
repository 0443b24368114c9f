/* Builds a bounding volume hierarchy of a mesh's triangles, in which each box is divided at the middle of its longest
 * side, and traverses it for rays. */
#include "geometry/measure/ray_tree.h"

#include <math.h>

enum { LEAF = 4, DEPTH = 64 };

double vs_ray_meets_triangle(const vs_vec3 p[3], vs_vec3 from, vs_vec3 direction) {
  vs_vec3 u = vs_v3_sub(p[1], p[0]), v = vs_v3_sub(p[2], p[0]), h = vs_v3_cross(direction, v);
  double volume = vs_v3_dot(u, h);
  if (volume == 0) return INFINITY;
  vs_vec3 s = vs_v3_sub(from, p[0]), q = vs_v3_cross(s, u);
  double a = vs_v3_dot(s, h) / volume, b = vs_v3_dot(direction, q) / volume, t = vs_v3_dot(v, q) / volume;
  return a >= -1e-12 && b >= -1e-12 && a + b <= 1 + 1e-12 && t >= 0 ? t : INFINITY;
}

bool vs_ray_meets_box(const vs_bounds *b, vs_vec3 from, vs_vec3 direction, double far) {
  const double low[3] = { b->min.x, b->min.y, b->min.z }, high[3] = { b->max.x, b->max.y, b->max.z };
  const double at[3] = { from.x, from.y, from.z }, d[3] = { direction.x, direction.y, direction.z };
  double near = 0;
  for (int i = 0; i < 3; i++) {
    if (d[i] == 0) { /* the ray is parallel to two sides of the box, and can meet the box only if it starts between
                      * them */
      if (at[i] < low[i] || at[i] > high[i]) return false;
      continue;
    }
    double p = (low[i] - at[i]) / d[i], q = (high[i] - at[i]) / d[i];
    double first = p < q ? p : q, last = p < q ? q : p;
    if (first > near) near = first;
    if (last < far) far = last;
  }
  return near <= far * (1 + 1e-12);
}

/* Sets p to the positions of the three corners of a triangle of the mesh. */
static void corners_of(const vs_mesh *m, uint32_t triangle, vs_vec3 p[3]) {
  VS_ASSERT(triangle < m->triangle_count);
  for (int k = 0; k < 3; k++) p[k] = m->vertices[m->triangles[triangle][k]];
}

static double along(vs_vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

static vs_vec3 middle_of(const vs_mesh *m, uint32_t triangle) {
  vs_vec3 p[3];
  corners_of(m, triangle, p);
  return vs_v3_scale(vs_v3_add(p[0], vs_v3_add(p[1], p[2])), 1. / 3);
}

/* Divides the triangles of a node into two halves by their centres, and reorders them. Returns the number of triangles
 * in the first half, which is neither 0 nor count. count is at least 2. */
static uint32_t part(const vs_mesh *m, uint32_t *order, uint32_t count) {
  vs_vec3 low = middle_of(m, order[0]), high = low;
  VS_ASSERT(count > 1);
  for (uint32_t i = 1; i < count; i++) {
    vs_vec3 c = middle_of(m, order[i]);
    low = vs_v3(fmin(low.x, c.x), fmin(low.y, c.y), fmin(low.z, c.z));
    high = vs_v3(fmax(high.x, c.x), fmax(high.y, c.y), fmax(high.z, c.z));
  }
  vs_vec3 size = vs_v3_sub(high, low);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  double half = (along(low, axis) + along(high, axis)) / 2;
  uint32_t first = 0;
  for (uint32_t i = 0; i < count; i++) {
    uint32_t triangle = order[i];
    if (along(middle_of(m, triangle), axis) > half) continue;
    order[i] = order[first], order[first++] = triangle;
  }
  return first == 0 || first == count ? count / 2 : first;
}

static vs_bounds bounds_of(const vs_mesh *m, const uint32_t *order, uint32_t count) {
  vs_vec3 p[3];
  corners_of(m, order[0], p);
  vs_bounds b = { p[0], p[0] };
  for (uint32_t i = 0; i < count; i++) {
    corners_of(m, order[i], p);
    for (int k = 0; k < 3; k++) {
      b.min = vs_v3(fmin(b.min.x, p[k].x), fmin(b.min.y, p[k].y), fmin(b.min.z, p[k].z));
      b.max = vs_v3(fmax(b.max.x, p[k].x), fmax(b.max.y, p[k].y), fmax(b.max.z, p[k].z));
    }
  }
  return b;
}

/* A range of triangles that is to become a node of the tree. second: true if the range is the second half of the node
 * `parent`. */
typedef struct { uint32_t first, count, parent; bool second; } range;

bool vs_ray_tree_make(vs_ray_tree *t, vs_store *store, const vs_mesh *mesh, vs_error *e) {
  size_t count = mesh->triangle_count;
  *t = (vs_ray_tree){ .mesh = mesh, .store = store };
  if (!count) return true;
  if (count > UINT32_MAX / 4) return vs_error_memory(e, NULL);
  t->order = vs_store_realloc(store, NULL, 0, count * sizeof *t->order);
  t->nodes = vs_store_realloc(store, NULL, 0, 2 * count * sizeof *t->nodes);
  if (!t->order || !t->nodes) return vs_ray_tree_free(t), vs_error_memory(e, NULL);
  for (size_t i = 0; i < count; i++) t->order[i] = (uint32_t)i;
  range stack[DEPTH] = { { 0, (uint32_t)count, 0, false } };
  for (size_t depth = 1; depth > 0;) {
    range r = stack[--depth];
    uint32_t self = (uint32_t)t->node_count++;
    if (r.second) t->nodes[r.parent].first = self;
    t->nodes[self] = (vs_ray_node){ bounds_of(mesh, t->order + r.first, r.count), r.first, r.count };
    if (r.count <= LEAF) continue;
    uint32_t half = depth + 2 < DEPTH ? part(mesh, t->order + r.first, r.count) : 0;
    if (!half) continue; /* the node is at the greatest depth that a traversal can handle, so it becomes a leaf */
    t->nodes[self].count = 0;
    stack[depth++] = (range){ r.first + half, r.count - half, self, true };
    stack[depth++] = (range){ r.first, half, self, false };
  }
  return true;
}

void vs_ray_tree_free(vs_ray_tree *t) {
  size_t count = t->mesh ? t->mesh->triangle_count : 0;
  if (t->order) vs_store_realloc(t->store, t->order, count * sizeof *t->order, 0);
  if (t->nodes) vs_store_realloc(t->store, t->nodes, 2 * count * sizeof *t->nodes, 0);
  *t = (vs_ray_tree){ .store = t->store };
}

size_t vs_ray_tree_meet(const vs_ray_tree *t, vs_vec3 from, vs_vec3 direction, double far, bool any, double *at) {
  size_t none = t->mesh->triangle_count, nearest = none;
  uint32_t stack[DEPTH + 2];
  size_t depth = 0;
  *at = far;
  if (t->node_count) stack[depth++] = 0;
  while (depth > 0) {
    uint32_t self = stack[--depth];
    const vs_ray_node *n = &t->nodes[self];
    if (!vs_ray_meets_box(&n->box, from, direction, *at)) continue;
    if (!n->count) {
      stack[depth++] = n->first;
      stack[depth++] = self + 1;
      continue;
    }
    for (uint32_t i = n->first; i < n->first + n->count; i++) {
      vs_vec3 p[3];
      corners_of(t->mesh, t->order[i], p);
      double where = vs_ray_meets_triangle(p, from, direction);
      if (where >= *at) continue;
      *at = where, nearest = t->order[i];
      if (any) return nearest;
    }
  }
  return nearest;
}
