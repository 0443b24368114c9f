/* Prepares data for each distinct mesh (distinct_meshes.h).
 *
 * A mesh is a star about its middle m under two conditions. m lies strictly on the inner side of every triangle's
 * plane. The solid angles of the triangles, seen from m, sum to one full sphere. The surface then covers that sphere
 * exactly once. A place q is inside if it lies on the same side as m of the triangle that the ray from m through q
 * crosses. To find this triangle, the kernel walks from triangle to triangle, each time across an edge that has the ray
 * on its outer side. */
#include "kernel/distinct_meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/threads.h"

/* ---- twins: two corners (index of a triangle's edge) whose edges join the same vertices in opposite directions
 * ---- */

typedef struct { uint32_t high, corner; } half; /* high: the edge's vertex with the higher number; corner: twice the
                                                 * corner's number, plus 1 if its edge runs from the higher to the lower
                                                 * vertex */

/* Puts each directed edge (a half) into the bucket of its lower vertex. The bucket of vertex v is halves[first[v]] to
 * halves[first[v + 1] - 1]. `first` has two more elements than there are vertices; all are 0 at the call. */
static void fill_buckets(const vs_twins_input *in, uint32_t *first, half *halves, uint32_t *twins) {
  const uint32_t *id = in->id;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t t = 0; t < in->count; t++)
      for (uint32_t j = 0; j < 3; j++) {
        uint32_t a = in->triangles[t][j], b = in->triangles[t][j == 2 ? 0 : j + 1];
        if (id) a = id[a], b = id[b];
        if (a == b) twins[3 * t + j] = VS_NONE;
        else if (!pass) first[(a < b ? a : b) + 2]++;
        else halves[first[(a < b ? a : b) + 1]++] = (half){ a < b ? b : a, 2 * (3 * t + j) + (a > b) };
      }
    if (!pass)
      for (size_t i = 2; i < in->id_count + 2; i++) first[i] += first[i - 1];
  }
}

/* Sorts a bucket of n directed edges by (high, corner) with Shell's method. At a vertex with very many edges, insertion
 * sort would be too slow. */
static void sort_bucket(half *at, uint32_t n) {
  for (uint32_t gap = n / 2; gap; gap = gap == 2 ? 1 : (uint32_t)(gap / 2.2))
    for (uint32_t i = gap; i < n; i++) {
      half x = at[i];
      uint32_t j = i;
      for (; j >= gap && (at[j - gap].high != x.high ? at[j - gap].high > x.high : at[j - gap].corner > x.corner);
           j -= gap)
        at[j] = at[j - gap];
      at[j] = x;
    }
}

/* Pairs the directed edges of a bucket. Each is paired with the nearest unpaired one before it that has the same two
 * vertices and the opposite direction. sorted: true if edges with the same higher vertex are neighbours. */
static inline void join_bucket(const half *at, uint32_t n, bool sorted, uint32_t *twins) {
  for (uint32_t i = 0; i < n; i++) {
    uint32_t corner = at[i].corner / 2;
    bool turned = at[i].corner & 1, found = false;
    for (uint32_t j = i; !found && j-- > 0;) {
      if (at[j].high != at[i].high) {
        if (sorted) break;
        continue;
      }
      if ((bool)(at[j].corner & 1) == turned || twins[at[j].corner / 2] != VS_NONE) continue;
      twins[corner] = at[j].corner / 2;
      twins[at[j].corner / 2] = corner;
      found = true;
    }
    if (!found) twins[corner] = VS_NONE;
  }
}

bool vs_twins_find(vs_kernel *k, const vs_twins_input *in, uint32_t *twins, uint32_t *open) {
  enum { MANY = 64 }; /* a list of at least this many directed edges is sorted before pairs are searched in it; most
                       * lists are short */
  uint32_t *first = NULL;
  half *halves = NULL;
  size_t first_room = 0, half_room = 0;
  *open = VS_NONE;
  if (in->count >= UINT32_MAX / 6) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "a solid has too many triangles");
  bool ok = VS_ROOM(k, first, first_room, in->id_count + 2) && VS_ROOM(k, halves, half_room, 3 * in->count + 1);
  if (ok) memset(first, 0, (in->id_count + 2) * sizeof *first);
  if (ok) fill_buckets(in, first, halves, twins);
  for (size_t v = 0; ok && v < in->id_count; v++) {
    half *at = halves + first[v];
    uint32_t n = first[v + 1] - first[v];
    if (n > MANY) sort_bucket(at, n);
    join_bucket(at, n, n > MANY, twins);
    for (uint32_t i = 0; i < n && *open == VS_NONE; i++)
      if (twins[at[i].corner / 2] == VS_NONE) *open = at[i].corner / 6;
    ok = vs_kernel_poll(k, 0);
  }
  VS_FREE(k, first, first_room);
  VS_FREE(k, halves, half_room);
  return ok;
}

/* Orders vertices by their coordinates, and then by number. Vertices with equal coordinates become neighbours. */
static bool place_before(const void *context, uint32_t a, uint32_t b) {
  const vs_vec3 *v = context, *x = &v[a], *y = &v[b];
  return x->x != y->x ? x->x < y->x : x->y != y->y ? x->y < y->y : x->z != y->z ? x->z < y->z : a < b;
}

static bool find_twins(vs_kernel *k, vs_part *p) {
  const vs_mesh *m = p->mesh;
  vs_twins_input in = { (const uint32_t (*)[3])m->triangles, m->triangle_count, NULL, m->vertex_count };
  uint32_t open, *order = NULL, *scratch = NULL, *id = NULL;
  size_t order_room = 0, scratch_room = 0, id_room = 0, n = m->vertex_count;
  if (!VS_ROOM(k, p->twins, p->twin_room, 3 * m->triangle_count + 1) ||
      !vs_twins_find(k, &in, p->twins, &open))
    return false;
  if (open == VS_NONE) return true;
  bool ok = VS_ROOM(k, order, order_room, n) && VS_ROOM(k, scratch, scratch_room, n) && VS_ROOM(k, id, id_room, n);
  if (ok) {
    for (uint32_t i = 0; i < n; i++) order[i] = i;
    vs_kernel_sort(order, scratch, n, place_before, m->vertices);
    for (size_t i = 0; i < n; i++) {
      const vs_vec3 *a = &m->vertices[order[i]], *b = &m->vertices[order[i ? i - 1 : 0]];
      id[order[i]] = i && a->x == b->x && a->y == b->y && a->z == b->z ? id[order[i - 1]] : order[i];
    }
    in.id = id;
    ok = vs_twins_find(k, &in, p->twins, &open);
  }
  VS_FREE(k, order, order_room);
  VS_FREE(k, scratch, scratch_room);
  VS_FREE(k, id, id_room);
  if (ok && open != VS_NONE) VS_FREE(k, p->twins, p->twin_room);
  return ok;
}

/* ---- stars and convex parts ---- */

static double det(vs_vec3 a, vs_vec3 b, vs_vec3 c) { return vs_v3_dot(vs_v3_cross(a, b), c); }

/* Sets p->star to true if the part is a star: the mean of its vertices is on the inner side of every triangle, and rays
 * from it cross the surface once. Returns false if interrupted. */
static bool find_star(vs_kernel *k, vs_part *p) {
  const vs_mesh *m = p->mesh;
  size_t n = m->triangle_count, vertices = m->vertex_count;
  double angle = 0, size, six = 0;
  p->middle = vs_v3(0, 0, 0);
  p->outer = 0;
  p->inner = INFINITY;
  if (!p->twins || n < 4 || vertices < 4) return true;
  for (size_t i = 0; i < vertices; i++) p->middle = vs_v3_add(p->middle, m->vertices[i]);
  p->middle = vs_v3_scale(p->middle, 1 / (double)vertices);
  for (size_t i = 0; i < vertices; i++) p->outer = fmax(p->outer, vs_v3_length(vs_v3_sub(m->vertices[i], p->middle)));
  size = p->outer;
  if (!(size > 0) || !isfinite(size)) return true;
  for (size_t t = 0; t < n; t++) {
    vs_vec3 a = vs_v3_sub(m->vertices[m->triangles[t][0]], p->middle),
            b = vs_v3_sub(m->vertices[m->triangles[t][1]], p->middle),
            c = vs_v3_sub(m->vertices[m->triangles[t][2]], p->middle),
            normal = vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a));
    double volume = det(a, b, c), area = vs_v3_length(normal), la = vs_v3_length(a), lb = vs_v3_length(b),
           lc = vs_v3_length(c);
    if (!(volume > 1e-9 * size * area) || p->twins[3 * t] == VS_NONE || p->twins[3 * t + 1] == VS_NONE ||
        p->twins[3 * t + 2] == VS_NONE)
      return true;
    p->inner = fmin(p->inner, volume / area);
    if (!vs_kernel_poll(k, 0)) return false;
    six += volume;
    angle += 2 * atan2(volume, la * lb * lc + vs_v3_dot(a, b) * lc + vs_v3_dot(b, c) * la + vs_v3_dot(c, a) * lb);
  }
  if (fabs(angle / (12.566370614359172) - 1) > 0.01) return true;
  p->volume = six / 6;
  p->star = true;
  return true;
}

static void find_convex(vs_part *p) {
  enum { GLOBAL = 1 << 16 };
  const vs_mesh *m = p->mesh;
  size_t n = m->triangle_count, vertices = m->vertex_count;
  double size = p->outer;
  if (!p->star) return;
  bool global = n * vertices <= GLOBAL; /* If true, each vertex is tested against each triangle. If false, each triangle
                                         * is tested only against its neighbours across edges, with a tolerance of a
                                         * double's rounding error. */
  for (size_t t = 0; t < n; t++) {
    vs_vec3 a = m->vertices[m->triangles[t][0]], normal = vs_v3_cross(vs_v3_sub(m->vertices[m->triangles[t][1]], a),
                                                                      vs_v3_sub(m->vertices[m->triangles[t][2]], a));
    double length = vs_v3_length(normal);
    for (size_t i = 0; i < (global ? vertices : 3); i++) {
      vs_vec3 v = m->vertices[global ? i : m->triangles[p->twins[3 * t + i] / 3][(p->twins[3 * t + i] + 2) % 3]];
      if (vs_v3_dot(normal, vs_v3_sub(v, a)) > (global ? 1e-11 : 1e-13) * size * length) return;
    }
  }
  p->convex = true;
}

/* Walks from *triangle to the triangle that the ray from the part's middle in direction d crosses. corner: receives the
 * corners of that triangle, relative to the middle. Returns false if the walk has more than STEPS steps. */
static bool walk_to(const vs_part *p, vs_vec3 d, uint32_t *triangle, vs_vec3 corner[3]) {
  enum { STEPS = 48 };
  const vs_mesh *m = p->mesh;
  VS_ASSERT(*triangle < m->triangle_count);
  for (int step = 0; step < STEPS; step++) {
    const uint32_t *v = m->triangles[*triangle];
    double worst = 0;
    uint32_t across = 3;
    for (int j = 0; j < 3; j++) corner[j] = vs_v3_sub(m->vertices[v[j]], p->middle);
    for (uint32_t j = 0; j < 3; j++) {
      double s = det(corner[j], corner[j == 2 ? 0 : j + 1], d);
      if (s < worst) worst = s, across = j;
    }
    if (across == 3) return true;
    *triangle = p->twins[3 * *triangle + across] / 3;
  }
  return false;
}

static const uint8_t across_of[3] = { 1, 2, 0 }, up_of[3] = { 2, 0, 1 };

/* Returns the index of the cell that contains the direction d. The sides of a cube around the part are divided into
 * start_cells * start_cells cells each. */
static uint32_t cell_of(const vs_part *p, vs_vec3 d) {
  double x[3] = { d.x, d.y, d.z }, size[3] = { fabs(d.x), fabs(d.y), fabs(d.z) };
  uint32_t k = size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : size[1] >= size[2] ? 1 : 2, n = p->start_cells;
  if (!(size[k] > 0)) return 0;
  uint32_t u = (uint32_t)((x[across_of[k]] / size[k] + 1) / 2 * n), v = (uint32_t)((x[up_of[k]] / size[k] + 1) / 2 * n);
  return ((2 * k + (x[k] < 0)) * n + (u < n ? u : n - 1)) * n + (v < n ? v : n - 1);
}

/* Divides the sides of a cube around the part into cells. For each cell, finds a triangle near the place where a ray
 * from the part's middle through the cell crosses the surface. */
static bool find_starts(vs_kernel *k, vs_part *p) {
  enum { MOST = 16 };
  double wanted = sqrt((double)p->mesh->triangle_count / 24);
  uint32_t n = wanted > MOST ? MOST : (uint32_t)wanted, triangle = 0, at = 0;
  if (n < 2 || !p->convex) return true;
  if (!VS_ROOM(k, p->starts, p->start_room, 6 * (size_t)n * n)) return false;
  p->start_cells = n;
  for (uint32_t side = 0; side < 6; side++)
    for (uint32_t i = 0; i < n; i++)
      for (uint32_t j = 0; j < n; j++) {
        double x[3];
        vs_vec3 corner[3];
        x[side / 2] = side & 1 ? -1 : 1;
        x[across_of[side / 2]] = (2 * i + 1.0) / n - 1;
        x[up_of[side / 2]] = (2 * j + 1.0) / n - 1;
        if (j == 0 && i > 0) triangle = p->starts[at - n]; /* begins at the triangle of the first cell of the previous
                                                            * row; it is nearer than the triangle of the previous cell,
                                                            * at the other end of that row */
        walk_to(p, vs_v3(x[0], x[1], x[2]), &triangle, corner);
        p->starts[at++] = triangle;
      }
  return true;
}

bool vs_part_holds(const vs_part *p, vs_vec3 q, double margin) {
  vs_vec3 d = vs_v3_sub(q, p->middle), corner[3];
  double square = vs_v3_dot(d, d);
  VS_ASSERT(p->convex && margin >= 0);
  if (square > p->outer * p->outer) return false;
  if (margin < p->inner && square < (p->inner - margin) * (p->inner - margin)) return true;
  uint32_t t = p->start_cells ? p->starts[cell_of(p, d)] : 0;
  if (!walk_to(p, d, &t, corner)) return false;
  vs_vec3 normal = vs_v3_cross(vs_v3_sub(corner[1], corner[0]), vs_v3_sub(corner[2], corner[0]));
  return vs_v3_dot(normal, vs_v3_sub(d, corner[0])) < -margin * vs_v3_length(normal);
}

/* ---- the parts of a problem ---- */

enum { CHUNK = 8, FEW = 64 }; /* CHUNK: number of meshes that one task prepares; FEW: number of meshes below which each
                               * mesh is a separate task */
static size_t in_chunk(const vs_parts *p) { return p->all.count < FEW ? 1 : CHUNK; }

static bool look_at(vs_kernel *k, void *context, size_t chunk) {
  vs_parts *p = context;
  size_t n = in_chunk(p);
  for (size_t i = chunk * n; i < (chunk + 1) * n && i < p->all.count; i++) {
    vs_part *part = &p->all.at[i];
    if (part->mesh->triangle_count == 0) continue;
    if (!find_twins(k, part)) return false;
    if (!find_star(k, part)) return false;
    if (!part->star) part->volume = vs_mesh_volume(part->mesh);
    else if (part->joined) find_convex(part);
    else VS_FREE(k, part->twins, part->twin_room); /* The kernel copies this mesh unchanged, so its pairs of opposite
                                                    * edges (twins) are not needed. */
    if (!find_starts(k, part) || !vs_kernel_report(k, 0)) return false;
  }
  return true;
}

bool vs_parts_prepare(vs_kernel *k, vs_parts *p, const vs_kernel_problem *problem, const uint32_t *order,
                      const uint32_t *cluster, uint32_t count) {
  size_t slots = 64;
  while (slots < 2 * (size_t)problem->leaf_count) slots *= 2;
  uint32_t *table = NULL;
  size_t table_room = 0;
  bool ok = VS_ROOM(k, table, table_room, slots) &&
            VS_ROOM(k, p->of_leaf.at, p->of_leaf.room, (size_t)problem->leaf_count + 1);
  for (size_t i = 0; ok && i < slots; i++) table[i] = VS_NONE;
  for (uint32_t i = 0; ok && i < problem->leaf_count; i++) {
    const vs_mesh *mesh = problem->leaves[i].mesh;
    size_t slot = ((uint64_t)(uintptr_t)mesh * 0x9e3779b97f4a7c15u >> 20) & (slots - 1);
    while (table[slot] != VS_NONE && p->all.at[table[slot]].mesh != mesh) slot = (slot + 1) & (slots - 1);
    if (table[slot] == VS_NONE) {
      vs_part part = { .mesh = mesh };
      ok = VS_PUSH(k, p->all, part) && vs_kernel_poll(k, 0);
      table[slot] = (uint32_t)p->all.count - 1;
    }
    p->of_leaf.at[i] = table[slot];
  }
  VS_FREE(k, table, table_room);
  for (uint32_t i = 0; ok && i < count; i++)
    if ((i > 0 && cluster[i - 1] == cluster[i]) || (i + 1 < count && cluster[i + 1] == cluster[i]))
      p->all.at[p->of_leaf.at[order[i]]].joined = true;
  enum { SERIAL = 10000 }; /* number of triangles in the problem below which a single thread prepares all meshes */
  size_t triangles = 0;
  uint32_t threads = k->threads;
  for (size_t i = 0; i < p->all.count; i++) triangles += p->all.at[i].mesh->triangle_count;
  if (triangles < SERIAL) k->threads = 1;
  ok = ok && vs_kernel_run(k, (p->all.count + in_chunk(p) - 1) / in_chunk(p), look_at, p);
  k->threads = threads;
  return ok;
}

void vs_parts_free(vs_kernel *k, vs_parts *p) {
  for (size_t i = 0; i < p->all.count; i++) {
    VS_FREE(k, p->all.at[i].twins, p->all.at[i].twin_room);
    VS_FREE(k, p->all.at[i].starts, p->all.at[i].start_room);
  }
  VS_DROP(k, p->all);
  VS_DROP(k, p->of_leaf);
}
