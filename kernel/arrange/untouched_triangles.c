/* Finds untouched triangles, `plain` in the code. No other triangle touches them, so they need no planes, facets,
 * patches or separate faces.
 *
 * A triangle of a large leaf is plain under three conditions. First, its box does not intersect the box of any triangle
 * of another leaf. Second, it has only those corners and edges in common with other triangles of its leaf that the mesh
 * gives them. Third, no neighbour is coplanar with it. A star fulfils the second condition. In other leaves, triangles
 * without a common corner must be proven apart (triangles_apart.c). Triangles around a corner must form, as seen along
 * some axis, a fan that goes around once. All tests use corners on the grid, which doubles represent exactly. If a test
 * is uncertain, the triangle is arranged like any other, which only costs time.
 *
 * A region is a connected set of plain triangles. In the classification it is a single face, with boundary edges only
 * along its rim. The face on the other side of the rim is the facet of one arranged triangle. Therefore every edge of
 * the rim has two faces, and the region needs no plane. Its triangles are copied to the result unchanged.
 *
 * Boxes are tested in blocks of up to 16 connected triangles that are consecutive in the mesh. Meshes made by programs
 * mostly have such an order. */
#include "kernel/arrange/untouched_triangles.h"

#include "kernel/arrange/cluster_frame.h"
#include "kernel/arrange/cull.h"
#include "kernel/mesh/hubs.h"
#include "kernel/mesh/triangles_apart.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <math.h>
#include <string.h>

enum { SPAN = 1 << 13, LANES = 4, PACKS = 4, BLOCK = LANES * PACKS };
enum { LEAST = 256 }; /* least number of triangles of a leaf in which untouched triangles are searched */
enum { PROVEN = 128 };

typedef struct {
  uint32_t place, first, end;   /* place: index of the leaf in the cluster; first, end: range of the leaf's triangles
                                 * that one task handles */
  uint32_t blocks;              /* number of blocks (of up to 16 triangles) in all ranges of triangles before this
                                 * one */
  VS_LIST(vs_use) rim;          /* boundary edges of the regions of untouched triangles; the member `face` of an edge is
                                 * the index of its region */
} span;
/* Up to 16 connected triangles of a mesh. hub: index of a corner that all of them have, if they share only edges around
 * it; UINT32_MAX if there is no such corner. */
typedef struct { uint32_t place, first, hub; vs_pack packs[PACKS]; } block;

typedef struct {
  vs_cluster *c;
  VS_LIST(span) spans;
  VS_LIST(uint64_t) masks;      /* masks[v]: set of the convex leaves that hide vertex v, as bits; see VS_LIDS in
                                 * cluster.h */
  VS_LIST(block) blocks;
  VS_LIST(vs_bvh_box) boxes;        /* boxes[i]: bounding box of block i of triangles */
  vs_bvh bvh;
  VS_LIST(_Atomic uint8_t) fans; /* fans[v]: state of vertex v. 1: its triangles form a single fan that goes around
                                  * once. 2 or more: they do not. PROVEN: the search for hubs has proven that the very
                                  * many triangles at v form such a fan. */
  VS_LIST(vs_hubs) hubs;         /* hubs[i]: corners of leaf i, on the grid, at which very many triangles end */
  VS_LIST(_Atomic uint32_t) sets;
} plain;

typedef struct { plain *p; vs_kernel *k; } searcher;

static const vs_mesh *mesh_at(const vs_cluster *c, uint32_t place) { return c->placed.at[place].part->mesh; }
/* Returns the position on the grid of a vertex of the leaf with the index `place`. */
static const int32_t *corner_at(const vs_cluster *c, uint32_t place, uint32_t vertex) {
  VS_ASSERT(place < c->leaf_count);
  return c->corners[c->placed.at[place].first + vertex];
}
/* Returns the vertices of triangle t of the leaf's mesh. */
static const uint32_t *triangle_at(const vs_cluster *c, uint32_t place, uint32_t t) {
  VS_ASSERT(t < mesh_at(c, place)->triangle_count);
  return mesh_at(c, place)->triangles[t];
}

static uint8_t fate_of(const vs_cluster *c, uint32_t place, uint32_t t) {
  return atomic_load_explicit(&c->fate.at[c->placed.at[place].first_triangle + t], memory_order_relaxed);
}
/* Sets the fate of triangle t of a leaf: VS_ARRANGED, VS_CULLED or VS_PLAIN (untouched). */
static void set_fate(vs_cluster *c, uint32_t place, uint32_t t, uint8_t fate) {
  VS_ASSERT(fate <= VS_PLAIN);
  atomic_store_explicit(&c->fate.at[c->placed.at[place].first_triangle + t], fate, memory_order_relaxed);
}
static void arrange(vs_cluster *c, uint32_t place, uint32_t t) { /* Marks triangle t as one that the kernel must cut
                                                                  * against others. Several threads may do this for one
                                                                  * triangle. */
  if (fate_of(c, place, t) == VS_PLAIN) set_fate(c, place, t, VS_ARRANGED);
}

static uint32_t next_of(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/* ---- culled triangles ---- */

/* For a range of a leaf's vertices, computes the masks: the set of convex leaves that hide each vertex. The task's
 * index selects the range. */
static bool mask_span(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  const vs_mesh *m = mesh_at(p->c, s->place);
  return !vs_cull_needed(p->c, s->place) ||
         vs_cull_vertices(k, p->c, s->place, m->vertex_count * s->first / m->triangle_count,
                          m->vertex_count * s->end / m->triangle_count, p->masks.at + p->c->placed.at[s->place].first);
}

static bool fate_span(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  bool masked = vs_cull_needed(p->c, s->place);
  const uint64_t *masks = p->masks.at + p->c->placed.at[s->place].first;
  uint8_t fate = p->c->placed.at[s->place].searched ? VS_PLAIN : VS_ARRANGED;
  for (uint32_t t = s->first; t < s->end; t++) {
    const uint32_t *v = triangle_at(p->c, s->place, t);
    set_fate(p->c, s->place, t, masked && (masks[v[0]] & masks[v[1]] & masks[v[2]]) ? VS_CULLED : fate);
  }
  return vs_kernel_report(k, 0);
}

/* ---- blocks of triangles ---- */

static bool share_a_corner(const uint32_t *v, const uint32_t *w) {
  return v[0] == w[0] || v[0] == w[1] || v[0] == w[2] || v[1] == w[0] || v[1] == w[1] || v[1] == w[2] || v[2] == w[0] ||
         v[2] == w[1] || v[2] == w[2];
}

static uint32_t hub_of(const plain *p, uint32_t place, uint32_t t) {
  const vs_hubs *h = &p->hubs.at[place];
  return h->of.count ? h->of.at[t] : UINT32_MAX;
}

/* Finds the next block of triangles, from *first to *end - 1. In a block, all triangles have one hub (a corner with
 * very many triangles), or none has a hub. Returns false at the end of the span. */
static bool next_block(const plain *p, const span *s, uint32_t *first, uint32_t *end) {
  const vs_cluster *c = p->c;
  const uint32_t (*v)[3] = (const uint32_t (*)[3])mesh_at(c, s->place)->triangles;
  uint32_t t = *first = *end;
  while (t < s->end && fate_of(c, s->place, t) == VS_CULLED) *first = ++t;
  if (t >= s->end) return false;
  for (t++; t < s->end && t - *first < BLOCK && hub_of(p, s->place, t) == hub_of(p, s->place, t - 1) &&
            (share_a_corner(v[t], v[t - 1]) || (t - *first > 1 && share_a_corner(v[t], v[t - 2])));)
    t++;
  *end = t;
  return true;
}

static bool count_blocks(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  span *s = &p->spans.at[index];
  uint32_t first, end = s->first;
  for (s->blocks = 0; next_block(p, s, &first, &end);) s->blocks++;
  return vs_kernel_report(k, 0);
}

static bool fill_blocks(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  uint32_t first, end = s->first, to = s->blocks;
  while (next_block(p, s, &first, &end)) {
    block *b = &p->blocks.at[to];
    vs_bvh_box all = vs_box_nowhere;
    b->place = s->place;
    b->first = first;
    b->hub = hub_of(p, s->place, first);
    for (uint32_t i = 0; i < BLOCK; i++) {
      uint32_t t = first + i;
      vs_bvh_box box = vs_box_nowhere;
      for (int j = 0; j < 3 && t < end && fate_of(p->c, s->place, t) != VS_CULLED; j++) {
        const int32_t *at = corner_at(p->c, s->place, triangle_at(p->c, s->place, t)[j]);
        for (int a = 0; a < 3; a++) {
          if (at[a] < box.min[a]) box.min[a] = at[a];
          if (at[a] > box.max[a]) box.max[a] = at[a];
        }
      }
      vs_pack_put(&b->packs[i / LANES], i % LANES, &box);
      for (int a = 0; a < 3; a++) {
        if (box.min[a] < all.min[a]) all.min[a] = box.min[a];
        if (box.max[a] > all.max[a]) all.max[a] = box.max[a];
      }
    }
    p->boxes.at[to++] = all;
  }
  return vs_kernel_report(k, 0);
}

/* ---- triangles whose boxes intersect ---- */

static uint32_t lanes_meeting(const block *b, const vs_bvh_box *box) {
  uint32_t set = 0;
  for (uint32_t i = 0; i < PACKS; i++) set |= vs_pack_bits(vs_pack_meeting(&b->packs[i], box)) << LANES * i;
  return set;
}

static vs_bvh_box lane_box(const block *b, uint32_t lane) {
  const vs_pack *p = &b->packs[lane / LANES];
  vs_bvh_box box;
  for (int a = 0; a < 3; a++) box.min[a] = p->min[a][lane % LANES], box.max[a] = p->max[a][lane % LANES];
  return box;
}

static void look_at_pair(vs_cluster *c, uint32_t a_place, uint32_t a, uint32_t b_place, uint32_t b) {
  if (fate_of(c, a_place, a) != VS_PLAIN && fate_of(c, b_place, b) != VS_PLAIN) return;
  if (a_place == b_place) {
    const uint32_t *v = triangle_at(c, a_place, a), *w = triangle_at(c, b_place, b);
    vs_vec3 x[3], y[3];
    if (share_a_corner(v, w)) return; /* the two triangles share a corner; the test of fans decides whether they touch
                                       * elsewhere */
    for (int i = 0; i < 3; i++) {
      const int32_t *p = corner_at(c, a_place, v[i]), *q = corner_at(c, b_place, w[i]);
      x[i] = vs_v3(p[0], p[1], p[2]);
      y[i] = vs_v3(q[0], q[1], q[2]);
    }
    if (vs_triangles_parted(x, y)) return;
  }
  arrange(c, a_place, a);
  arrange(c, b_place, b);
}

static bool meet_blocks(void *context, uint32_t first, uint32_t second) {
  searcher *s = context;
  const block *a = &s->p->blocks.at[first], *b = &s->p->blocks.at[second];
  if (!vs_kernel_poll(s->k, 0)) return false;
  uint32_t of_a = lanes_meeting(a, &s->p->boxes.at[second]);
  for (uint32_t of_b = of_a ? lanes_meeting(b, &s->p->boxes.at[first]) : 0; of_b; of_b &= of_b - 1) {
    uint32_t j = (uint32_t)__builtin_ctz(of_b);
    vs_bvh_box box = lane_box(b, j);
    for (uint32_t set = lanes_meeting(a, &box) & of_a; set; set &= set - 1)
      look_at_pair(s->p->c, a->place, a->first + (uint32_t)__builtin_ctz(set), b->place, b->first + j);
  }
  return true;
}

enum { CHUNK = 256 }; /* number of blocks of the tree of boxes in which one task searches pairs of triangles */

static bool meet_chunk(vs_kernel *k, void *context, size_t index) {
  searcher s = { context, k };
  return vs_bvh_pairs(k, &s.p->bvh, (uint32_t)index * CHUNK, (uint32_t)(index + 1) * CHUNK, meet_blocks, &s);
}

static bool meet_within(vs_kernel *k, void *context, size_t index) { /* in each block of a range of triangles, tests the
                                                                      * block's triangles against each other */
  plain *p = context;
  const span *s = &p->spans.at[index];
  if (!p->c->placed.at[s->place].searched || p->c->placed.at[s->place].star) return true;
  uint32_t end = index + 1 < p->spans.count ? p->spans.at[index + 1].blocks : (uint32_t)p->blocks.count;
  for (uint32_t i = s->blocks; i < end; i++) {
    const block *b = &p->blocks.at[i];
    for (uint32_t j = 1; j < BLOCK; j++) {
      vs_bvh_box box = lane_box(b, j);
      for (uint32_t set = lanes_meeting(b, &box) & ((1u << j) - 1); set; set &= set - 1)
        look_at_pair(p->c, s->place, b->first + (uint32_t)__builtin_ctz(set), s->place, b->first + j);
    }
    if (!vs_kernel_poll(k, 0)) return false;
  }
  return true;
}

static bool index_blocks(vs_kernel *k, plain *p, bool *few) {
  enum { WORTH = 4 }; /* least average number of triangles in a block; if blocks are smaller, the search for untouched
                       * triangles takes longer than it saves */
  vs_cluster *c = p->c;
  uint32_t sum = 0, *families = NULL;
  size_t room = 0;
  if (!vs_kernel_run(k, p->spans.count, count_blocks, p)) return false;
  for (size_t i = 0; i < p->spans.count; i++) {
    uint32_t n = p->spans.at[i].blocks;
    p->spans.at[i].blocks = sum;
    sum += n;
  }
  *few = sum <= c->fate.count / WORTH;
  if (!*few) return true;
  p->blocks.count = sum;
  bool ok = VS_ROOM(k, p->blocks.at, p->blocks.room, (size_t)sum + 1) &&
            VS_ROOM(k, p->boxes.at, p->boxes.room, (size_t)sum + 1) && VS_ROOM(k, families, room, (size_t)sum + 1) &&
            vs_kernel_run(k, p->spans.count, fill_blocks, p);
  /* Triangles of one family are not tested against each other. A star-shaped leaf does not intersect itself, and
   * triangles around one hub (corner) do not intersect each other. */
  for (uint32_t i = 0; ok && i < sum; i++) {
    const block *b = &p->blocks.at[i];
    const vs_placed *l = &c->placed.at[b->place];
    families[i] = !l->searched           ? c->leaf_count
                  : l->star              ? b->place
                  : b->hub == UINT32_MAX ? UINT32_MAX
                                         : c->leaf_count + 1 + l->first + b->hub;
  }
  p->bvh.families = families;
  ok = ok && vs_bvh_build(k, &p->bvh, p->boxes.at, sum);
  VS_FREE(k, families, room);
  return ok;
}

/* ---- neighbouring triangles ---- */

/* The normal of a triangle, and upper bounds for the errors of its components. The bounds are 0 if all products fit
 * into 53 bits. */
typedef struct { double n[3], error[3]; } normal;
static void normal_of(const vs_cluster *c, uint32_t place, uint32_t t, normal *to) {
  const uint32_t *v = triangle_at(c, place, t);
  const int32_t *o = corner_at(c, place, v[0]), *p = corner_at(c, place, v[1]), *q = corner_at(c, place, v[2]);
  double x[3], y[3];
  for (int a = 0; a < 3; a++) x[a] = (double)p[a] - o[a], y[a] = (double)q[a] - o[a];
  for (int a = 0; a < 3; a++) {
    int u = a == 2 ? 0 : a + 1, w = 3 - a - u;
    double s = x[u] * y[w], r = x[w] * y[u], size = fabs(s) + fabs(r);
    to->n[a] = s - r;
    to->error[a] = size < 0x1p53 ? 0 : size * 0x1p-51;
  }
}

/* returns true if the distance of vertex `off` from a plane is greater than rounding errors explain; m: normal of this
 * plane; on: number of a vertex in the plane */
static bool surely_bent(const vs_cluster *c, uint32_t place, const normal *m, uint32_t on, uint32_t off) {
  const int32_t *p = corner_at(c, place, on), *q = corner_at(c, place, off);
  double sum = 0, error = 0;
  for (int a = 0; a < 3; a++) {
    double d = (double)q[a] - p[a], x = m->n[a] * d;
    sum += x;
    error += 1e-14 * fabs(x) + m->error[a] * fabs(d);
  }
  return fabs(sum) > error;
}

/* For each triangle, tests the neighbours across its three edges. Marks the triangle as touched unless each edge has
 * exactly one neighbour in the mesh, and none of the neighbours is coplanar with it. */
static bool look_across(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  vs_cluster *c = p->c;
  const span *s = &p->spans.at[index];
  if (!c->placed.at[s->place].searched) return true;
  const uint32_t *twins = c->placed.at[s->place].part->twins;
  for (uint32_t t = s->first; t < s->end; t++) {
    const uint32_t *v = triangle_at(c, s->place, t);
    normal n;
    bool known = false;
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t twin = twins[3 * (size_t)t + j], other = twin / 3;
      if (twin == VS_NONE) {
        arrange(c, s->place, t);
        continue;
      }
      if (other < t || (fate_of(c, s->place, t) != VS_PLAIN && fate_of(c, s->place, other) != VS_PLAIN)) continue;
      const uint32_t *w = triangle_at(c, s->place, other);
      uint32_t e = twin % 3, f = e == 2 ? 0 : e + 1;
      if (!known) normal_of(c, s->place, t, &n), known = true;
      if (w[e] == v[j == 2 ? 0 : j + 1] && w[f] == v[j] && surely_bent(c, s->place, &n, v[j], w[3 - e - f])) continue;
      arrange(c, s->place, t);
      arrange(c, s->place, other);
    }
    if (!vs_kernel_poll(k, 0)) return false;
  }
  return true;
}

static bool lower(double x, double y) { return y < 0 || (y <= 0 && x < 0); }

/* Tests whether the triangles around a vertex, seen along some axis, go around it once. They then share only their
 * common corners and edges. corner: index of a corner in the leaf's mesh. Only the first corner at each vertex is
 * tested. */
static void look_around(plain *p, uint32_t place, uint32_t corner) {
  enum { MOST = 64 };
  const vs_cluster *c = p->c;
  const uint32_t *twins = c->placed.at[place].part->twins;
  uint32_t ring[MOST], count = 0, at = corner, vertex = triangle_at(c, place, corner / 3)[corner % 3], falls = 0;
  VS_ASSERT(corner < 3 * mesh_at(c, place)->triangle_count);
  _Atomic uint8_t *fan = &p->fans.at[c->placed.at[place].first + vertex];
  if (atomic_load_explicit(fan, memory_order_relaxed) == PROVEN) return;
  normal n[MOST];
  double sum[3] = { 0 };
  bool good = true;
  do {
    if (at / 3 < corner / 3) return;
    good = count < MOST && triangle_at(c, place, at / 3)[at % 3] == vertex;
    if (!good) break;
    ring[count++] = at;
    uint32_t twin = twins[at];
    good = twin != VS_NONE;
    if (good) at = next_of(twin);
  } while (good && at != corner);
  for (uint32_t i = 0; good && i < count; i++) {
    normal_of(c, place, ring[i] / 3, &n[i]);
    for (int a = 0; a < 3; a++) sum[a] += n[i].n[a];
  }
  int axis = fabs(sum[0]) >= fabs(sum[1])   ? (fabs(sum[0]) >= fabs(sum[2]) ? 0 : 2)
             : fabs(sum[1]) >= fabs(sum[2]) ? 1
                                            : 2;
  int x = (axis + (sum[axis] > 0 ? 1 : 2)) % 3, y = 3 - axis - x;
  const int32_t *o = corner_at(c, place, vertex);
  for (uint32_t i = 0; good && i < count; i++) {
    const uint32_t *v = triangle_at(c, place, ring[i] / 3);
    const int32_t *q = corner_at(c, place, v[(ring[i] + 1) % 3]), *r = corner_at(c, place, v[(ring[i] + 2) % 3]);
    good = sum[axis] > 0 ? n[i].n[axis] > n[i].error[axis] : n[i].n[axis] < -n[i].error[axis];
    falls += lower((double)q[x] - o[x], (double)q[y] - o[y]) && !lower((double)r[x] - o[x], (double)r[y] - o[y]);
  }
  uint8_t had = atomic_fetch_or_explicit(fan, good && falls == 1 ? 1 : 2, memory_order_relaxed);
  if (had) atomic_fetch_or_explicit(fan, 2, memory_order_relaxed); /* an earlier call has found another fan of triangles
                                                                    * at this vertex, so two fans touch there */
}

static bool find_fans(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  if (!p->c->placed.at[s->place].searched || p->c->placed.at[s->place].star) return true;
  for (uint32_t t = s->first; t < s->end; t++) {
    for (uint32_t j = 0; j < 3; j++) look_around(p, s->place, 3 * t + j);
    if (!vs_kernel_poll(k, 0)) return false;
  }
  return true;
}

static bool ask_fans(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  if (!p->c->placed.at[s->place].searched || p->c->placed.at[s->place].star) return true;
  const _Atomic uint8_t *fans = p->fans.at + p->c->placed.at[s->place].first;
  for (uint32_t t = s->first; t < s->end; t++) {
    const uint32_t *v = triangle_at(p->c, s->place, t);
    for (int j = 0; j < 3; j++) {
      uint8_t fan = atomic_load_explicit(&fans[v[j]], memory_order_relaxed);
      if (fan != 1 && fan != PROVEN) arrange(p->c, s->place, t);
    }
  }
  return vs_kernel_report(k, 0);
}

typedef struct { const vs_cluster *c; uint32_t place; } standing;
static vs_vec3 grid_corner(const void *context, uint32_t vertex) {
  const standing *s = context;
  const int32_t *at = corner_at(s->c, s->place, vertex);
  return vs_v3(at[0], at[1], at[2]);
}

/* Finds the hubs (corners with very many triangles) of the searched leaves that are not stars. */
static bool find_hubs(vs_kernel *k, plain *p) {
  const vs_cluster *c = p->c;
  if (!VS_ROOM(k, p->hubs.at, p->hubs.room, c->leaf_count)) return false;
  memset(p->hubs.at, 0, c->leaf_count * sizeof *p->hubs.at);
  p->hubs.count = c->leaf_count;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    const vs_mesh *m = mesh_at(c, i);
    standing s = { c, i };
    vs_fans fans = { (const uint32_t (*)[3])m->triangles, m->triangle_count, m->vertex_count, NULL, grid_corner, &s };
    if (c->placed.at[i].searched && !c->placed.at[i].star && !vs_hubs_find(k, &fans, &p->hubs.at[i])) return false;
  }
  return true;
}

static bool search_leaves(vs_kernel *k, plain *p, size_t vertices) {
  bool few;
  if (!find_hubs(k, p) || !index_blocks(k, p, &few)) return false;
  if (!few) { /* The triangles of the mesh are in no useful order. Therefore the search for untouched triangles would
               * not save time. */
    for (size_t i = 0; i < p->c->fate.count; i++)
      if (p->c->fate.at[i] == VS_PLAIN) p->c->fate.at[i] = VS_ARRANGED;
    return true;
  }
  size_t chunks = ((size_t)vs_bvh_blocks(&p->bvh) + CHUNK - 1) / CHUNK;
  bool ok = vs_kernel_run(k, chunks, meet_chunk, p) && vs_kernel_run(k, p->spans.count, meet_within, p);
  VS_DROP(k, p->blocks);
  VS_DROP(k, p->boxes);
  vs_bvh_free(k, &p->bvh);
  ok = ok && VS_ROOM(k, p->fans.at, p->fans.room, vertices + 1);
  if (ok) memset(p->fans.at, 0, vertices + 1);
  for (uint32_t i = 0; ok && i < p->hubs.count; i++)
    for (size_t j = 0; j < p->hubs.at[i].corners.count; j++)
      atomic_init(&p->fans.at[p->c->placed.at[i].first + p->hubs.at[i].corners.at[j]], PROVEN);
  ok = ok && vs_kernel_run(k, p->spans.count, find_fans, p) && vs_kernel_run(k, p->spans.count, ask_fans, p) &&
       vs_kernel_run(k, p->spans.count, look_across, p);
  return ok;
}

static bool make_spans(vs_kernel *k, plain *p) {
  for (uint32_t i = 0; i < p->c->leaf_count; i++) {
    uint32_t n = (uint32_t)mesh_at(p->c, i)->triangle_count;
    for (uint32_t t = 0; t < n; t += SPAN) {
      span s = { .place = i, .first = t, .end = n - t < SPAN ? n : t + SPAN };
      if (!VS_PUSH(k, p->spans, s)) return false;
    }
  }
  return true;
}

static void plain_free(vs_kernel *k, plain *p) {
  for (size_t i = 0; i < p->spans.count; i++) VS_DROP(k, p->spans.at[i].rim);
  VS_DROP(k, p->spans);
  VS_DROP(k, p->masks);
  VS_DROP(k, p->blocks);
  VS_DROP(k, p->boxes);
  vs_bvh_free(k, &p->bvh);
  VS_DROP(k, p->fans);
  VS_DROP(k, p->sets);
  for (size_t i = 0; i < p->hubs.count; i++) vs_hubs_free(k, &p->hubs.at[i]);
  VS_DROP(k, p->hubs);
}

bool vs_plain_find(vs_kernel *k, vs_cluster *c) {
  plain p = { .c = c };
  size_t triangles = 0, vertices = 0;
  bool culled = false, searched = false;
  for (uint32_t i = 0; i < c->leaf_count; i++) {
    vs_placed *l = &c->placed.at[i];
    l->first_triangle = triangles;
    l->searched = !c->inspect && !(c->layered && c->layered[c->leaves[i]]) && l->part->twins &&
        l->part->mesh->triangle_count >= LEAST;
    triangles += l->part->mesh->triangle_count;
    vertices += l->part->mesh->vertex_count;
    culled = culled || vs_cull_needed(c, i);
    searched = searched || l->searched;
  }
  if (!culled && !searched) return true; /* no triangle was culled and no leaf was searched, so all triangles are
                                          * arranged */
  if (triangles >= UINT32_MAX / 3) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  bool ok = make_spans(k, &p) && VS_ROOM(k, c->fate.at, c->fate.room, triangles + 1) &&
            (!culled || VS_ROOM(k, p.masks.at, p.masks.room, vertices + 1));
  if (ok) c->fate.count = triangles;
  ok = ok && (!culled || vs_kernel_run(k, p.spans.count, mask_span, &p)) &&
       vs_kernel_run(k, p.spans.count, fate_span, &p);
  VS_DROP(k, p.masks);
  ok = ok && (!searched || search_leaves(k, &p, vertices));
  for (size_t i = 0; ok && i < triangles; i++) c->plain_count += c->fate.at[i] == VS_PLAIN;
  if (ok && c->plain_count) {
    ok = VS_ROOM(k, c->point_of.at, c->point_of.room, vertices + 1);
    if (ok) memset(c->point_of.at, 0xff, (vertices + 1) * sizeof *c->point_of.at); /* sets every element to VS_NONE */
    c->point_of.count = vertices;
  }
  plain_free(k, &p);
  return ok;
}

/* ---- regions ---- */

static bool begin_sets(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  uint32_t first = (uint32_t)p->c->placed.at[s->place].first_triangle;
  for (uint32_t t = s->first; t < s->end; t++) atomic_init(&p->sets.at[first + t], first + t);
  return vs_kernel_report(k, k->part);
}

static bool join_span(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  const span *s = &p->spans.at[index];
  const uint32_t *twins = p->c->placed.at[s->place].part->twins;
  uint32_t first = (uint32_t)p->c->placed.at[s->place].first_triangle;
  for (uint32_t t = s->first; p->c->placed.at[s->place].searched && t < s->end; t++) {
    if (fate_of(p->c, s->place, t) != VS_PLAIN) continue;
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t other = twins[3 * (size_t)t + j] / 3;
      if (other > t && fate_of(p->c, s->place, other) == VS_PLAIN)
        vs_unite_shared(p->sets.at, first + t, first + other);
    }
  }
  return vs_kernel_report(k, k->part);
}

/* Numbers the regions of untouched triangles in the order of their first triangles. For each region, also chooses the
 * largest of its first LOOKED_AT triangles, through which a ray is sent later. */
static bool name_regions(vs_kernel *k, plain *p) {
  enum { LOOKED_AT = 256 };
  vs_cluster *c = p->c;
  VS_LIST(double) largest = { 0 };
  bool ok = VS_ROOM(k, c->region_of.at, c->region_of.room, c->fate.count + 1);
  for (uint32_t place = 0; ok && place < c->leaf_count; place++) {
    uint32_t n = (uint32_t)mesh_at(c, place)->triangle_count, first = (uint32_t)c->placed.at[place].first_triangle;
    for (uint32_t t = 0; ok && c->placed.at[place].searched && t < n; t++) {
      if (fate_of(c, place, t) != VS_PLAIN) continue;
      uint32_t root = vs_find_shared(p->sets.at, first + t);
      if (root == first + t) {
        c->region_of.at[root] = (uint32_t)c->regions.count;
        vs_region made = { .place = place };
        ok = VS_PUSH(k, c->regions, made) && VS_PUSH(k, largest, -1);
      } else {
        c->region_of.at[first + t] = c->region_of.at[root];
      }
      if (!ok) break;
      uint32_t number = c->region_of.at[root];
      if (c->regions.at[number].count++ < LOOKED_AT) {
        normal m;
        normal_of(c, place, t, &m);
        double size = fmax(fabs(m.n[0]), fmax(fabs(m.n[1]), fabs(m.n[2])));
        if (size > largest.at[number]) largest.at[number] = size, c->regions.at[number].triangle = t;
      }
      ok = vs_kernel_poll(k, k->part);
    }
  }
  VS_DROP(k, largest);
  return ok;
}

static bool find_rim(vs_kernel *k, void *context, size_t index) {
  plain *p = context;
  vs_cluster *c = p->c;
  span *s = &p->spans.at[index];
  const vs_placed *l = &c->placed.at[s->place];
  const uint32_t *twins = l->part->twins;
  bool mirrored = vs_affine_determinant(&c->problem->leaves[c->leaves[s->place]].placement) < 0;
  for (uint32_t t = s->first; l->searched && t < s->end; t++) {
    if (fate_of(c, s->place, t) != VS_PLAIN) continue;
    const uint32_t *v = triangle_at(c, s->place, t);
    uint32_t region = c->region_of.at[l->first_triangle + t];
    for (uint32_t j = 0; j < 3; j++) {
      uint8_t fate = fate_of(c, s->place, twins[3 * (size_t)t + j] / 3);
      uint32_t from = c->point_of.at[l->first + v[j]], to = c->point_of.at[l->first + v[j == 2 ? 0 : j + 1]];
      if (fate == VS_PLAIN) continue;
      if (fate == VS_CULLED) from = to = VS_NONE; /* beyond this edge, the triangles of the surface were removed as
                                                   * hidden, so the edge gets no face there */
      else if (from == VS_NONE || to == VS_NONE) return VS_BROKEN(k, "a rim has no points");
      if (!VS_PUSH(k, s->rim, ((vs_use){ mirrored ? to : from, mirrored ? from : to, region }))) return false;
    }
  }
  return vs_kernel_report(k, k->part);
}

static bool add_faces(vs_kernel *k, plain *p) {
  vs_cluster *c = p->c;
  size_t regions = c->regions.count, uses = c->uses.count, faces = c->faces.count;
  VS_LIST(uint32_t) at = { 0 }; /* at[r]: index of the first boundary edge of region r; while edges are copied, it
                                 * increases to the index after the last */
  size_t sum = 0;
  for (size_t i = 0; i < p->spans.count; i++) sum += p->spans.at[i].rim.count;
  if (uses + sum >= UINT32_MAX || faces + regions >= UINT32_MAX / 2)
    return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  bool ok = VS_ROOM(k, at.at, at.room, regions + 2) && VS_ROOM(k, c->uses.at, c->uses.room, uses + sum + 1) &&
            VS_ROOM(k, c->faces.at, c->faces.room, faces + regions + 1) &&
            VS_ROOM(k, c->covers.at, c->covers.room, c->covers.count + regions + 1);
  if (!ok) return VS_DROP(k, at), false;
  memset(at.at, 0, (regions + 2) * sizeof *at.at);
  for (size_t i = 0; i < p->spans.count; i++)
    for (size_t j = 0; j < p->spans.at[i].rim.count; j++) {
      const vs_use *u = &p->spans.at[i].rim.at[j];
      if (u->from == VS_NONE) c->regions.at[u->face].open = true;
      else at.at[u->face + 2]++;
    }
  for (size_t i = 2; i < regions + 2; i++) at.at[i] += at.at[i - 1];
  for (size_t i = 0; i < p->spans.count; i++)
    for (size_t j = 0; j < p->spans.at[i].rim.count; j++) {
      const vs_use *u = &p->spans.at[i].rim.at[j];
      if (u->from != VS_NONE)
        c->uses.at[uses + at.at[u->face + 1]++] = (vs_use){ u->from, u->to, (uint32_t)faces + u->face };
    }
  for (uint32_t i = 0; i < regions; i++) {
    vs_face made = { .plane = VS_NONE,
                     .cover = (uint32_t)c->covers.count,
                     .cover_count = 1,
                     .facet = i,
                     .use = (uint32_t)uses + at.at[i],
                     .use_count = at.at[i + 1] - at.at[i] };
    c->regions.at[i].face = (uint32_t)faces + i;
    c->covers.at[c->covers.count++] = (vs_cover){ c->leaves[c->regions.at[i].place], 1 };
    c->faces.at[c->faces.count++] = made;
  }
  c->uses.count = uses + at.at[regions];
  VS_DROP(k, at);
  return true;
}

bool vs_plain_regions(vs_kernel *k, vs_cluster *c) {
  plain p = { .c = c };
  if (!c->plain_count) return true;
  bool ok = make_spans(k, &p) && VS_ROOM(k, p.sets.at, p.sets.room, c->fate.count + 1) &&
            vs_kernel_run(k, p.spans.count, begin_sets, &p) && vs_kernel_run(k, p.spans.count, join_span, &p) &&
            name_regions(k, &p);
  VS_DROP(k, p.sets);
  ok = ok && vs_kernel_run(k, p.spans.count, find_rim, &p) && add_faces(k, &p);
  plain_free(k, &p);
  return ok;
}

/* ---- output of regions ---- */

size_t vs_plain_kept(const vs_cluster *c) {
  size_t sum = 0;
  for (size_t i = 0; i < c->regions.count; i++)
    if (c->kept.at[c->regions.at[i].face]) sum += c->regions.at[i].count;
  return sum;
}

/* Bit in point_of for a vertex that already has a number in the result. The other bits are that number. */
#define NUMBERED VS_POINT_MORE

typedef struct {
  vs_cluster *c;
  vs_mesh *out;
  VS_LIST(uint32_t) vertices; /* for each vertex that is new in the result: its index in the cluster's array
                               * `corners` */
  size_t first_vertex;        /* number, in the result, of the first vertex that this function appends */
} copying;

enum { PLACES = 1 << 14 };
static bool place_chunk(vs_kernel *k, void *context, size_t index) {
  copying *w = context;
  size_t begin = index * PLACES, end = w->vertices.count - begin < PLACES ? w->vertices.count : begin + PLACES;
  for (size_t i = begin; i < end; i++) {
    vs_point p = { .big = VS_POINT_EXACT };
    for (int a = 0; a < 3; a++)
      p.fixed[a] = (int64_t)w->c->corners[w->vertices.at[i]][a] * ((int64_t)1 << VS_FIXED_BITS);
    w->out->vertices[w->first_vertex + i] = vs_grid_world(&w->c->grid, &p);
  }
  return vs_kernel_report(k, k->part);
}

static bool copy_leaf(vs_kernel *k, copying *w, uint32_t place, const uint32_t *number) {
  vs_cluster *c = w->c;
  const vs_placed *l = &c->placed.at[place];
  uint32_t n = (uint32_t)l->part->mesh->triangle_count;
  bool mirrored = vs_affine_determinant(&c->problem->leaves[c->leaves[place]].placement) < 0;
  for (uint32_t t = 0; l->searched && t < n; t++) {
    if (fate_of(c, place, t) != VS_PLAIN) continue;
    const vs_region *r = &c->regions.at[c->region_of.at[l->first_triangle + t]];
    if (!c->kept.at[r->face]) continue;
    bool turned = mirrored != (c->kept.at[r->face] == 2);
    const uint32_t *v = triangle_at(c, place, t);
    uint32_t *to = w->out->triangles[w->out->triangle_count];
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t vertex = (uint32_t)l->first + v[j], *of = &c->point_of.at[vertex], as;
      if (*of == VS_NONE) {
        *of = NUMBERED | (uint32_t)w->vertices.count;
        if (!VS_PUSH(k, w->vertices, vertex)) return false;
      }
      if (*of & NUMBERED) as = (uint32_t)w->first_vertex + (*of & ~NUMBERED);
      else as = number[*of];
      if (as == VS_NONE) return VS_BROKEN(k, "a rim has one side");
      to[turned ? 2 - j : j] = as;
    }
    w->out->tags[w->out->triangle_count++] = c->faces.at[r->face].tag;
    if (!vs_kernel_poll(k, 0.95)) return false;
  }
  return true;
}

bool vs_plain_copy(vs_kernel *k, vs_cluster *c, vs_mesh *out, const uint32_t *number) {
  copying w = { .c = c, .out = out, .first_vertex = out->vertex_count };
  bool ok = true;
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) ok = copy_leaf(k, &w, i, number);
  size_t vertices = w.first_vertex + w.vertices.count;
  if (ok && vertices > out->vertex_room &&
      !vs_mesh_reserve(out, w.first_vertex ? vertices + vertices / 2 : vertices, 0))
    ok = vs_kernel_no_memory(k);
  if (ok) out->vertex_count = vertices;
  ok = ok && vs_kernel_run(k, (w.vertices.count + PLACES - 1) / PLACES, place_chunk, &w);
  VS_DROP(k, w.vertices);
  return ok;
}
