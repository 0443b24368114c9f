/* Implements the octree over the cells of a dual contour (octree.h).
 *
 * Plan. The leaves are the cells that the surface crosses. Eight neighbours are a node of level 1; eight nodes of a
 * level are a node of the next. From level to level, connected parts of the surface in a node's children become one
 * part. A node is merged if all its children were merged and if each part
 *   1. is a disc: rings minus the sides between them plus the quads within them make 1 (Euler's characteristic); it
 *      crosses each edge of the node once at most, and each side of it in one line. Then two parts never meet along
 *      two lines, and the mesh of the merged nodes is a manifold (S. Schaefer, T. Ju, J. Warren, Manifold dual
 *      contouring, 2007);
 *   2. has a point that is near the planes through all its crossings, while the points of all its rings are near the
 *      planes at that point. It is the point of the ring with the least sum of squares (T. Ju and others, Dual
 *      contouring of Hermite data, 2002). Edges and corners therefore do not move, and every point lies on the
 *      surface and in its node.
 * Each part of a merged node has one point. If a node is not merged, no node above it is. */
#include "geometry/functions/octree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

enum { LEVELS = 16, EDGES = 12 };
#define NONE UINT32_MAX

/* BEND: a node is merged only if the new point is within this fraction of the node's size of all planes, so that curved
 * surfaces are not merged. */
#define BEND .1
/* TO_MIDDLE: weight that prefers the point nearer to the middle among points that are equally near to the planes. */
#define TO_MIDDLE 1e-7

typedef struct {
  int32_t at[3];
  bool whole; /* true if all children of the node are merged, so that the node itself may be merged */
} node;

/* A connected part of the surface within a node (cube) of the octree. Neighbouring parts are joined, and may then share
 * one point. */
typedef struct {
  uint32_t ring, node;
  uint32_t up;            /* union-find parent of this part of the surface: another part with which it is joined, or
                           * itself */
  uint32_t link;          /* index of the next part of the surface in the circular list of parts that are joined with
                           * this part */
  uint32_t count;         /* number of parts of the surface in this set of joined parts; valid in the set's first
                           * part */
  uint32_t best;          /* ring (piece of the surface in a cell) whose point all parts of this set may share; valid in
                           * the set's first part */
  int32_t sides, inside;  /* sides: twice the number of cell sides between the rings of the joined parts; inside: number
                           * of quads within these parts; valid in the set's first part */
  uint8_t rim[EDGES];     /* rim[i]: number of points in which the joined parts cross edge i of the node; valid in the
                           * set's first part */
} part;

typedef struct {
  const vs_octree_leaves *l;
  double tolerance;
  int level;
  uint32_t *of;     /* of[r]: union-find parent of ring r (a piece of the surface in a cell); the root represents all
                     * rings that share one point */
  uint32_t *next;   /* next[r]: ring after r in the circular list of rings (pieces of the surface in cells) whose parts
                     * of the surface are joined */
  uint32_t *rep;    /* rep[r]: for the first ring r of a part of the surface, the ring whose point represents the
                     * part */
  uint32_t *number; /* number[r]: for the first ring r of a part of the surface, the part's index in `parts`; NONE if
                     * its node is not merged */
  uint32_t *start, *list; /* list[start[r]] to list[start[r + 1] - 1]: numbers of the quads (faces around crossed edges)
                           * that contain the point of ring r */
  part *parts;
  size_t part_count, part_room;
  uint32_t *quads; /* numbers of the quads (faces around crossed edges) whose four rings may still belong to different
                    * parts */
  size_t quad_count;
  node *nodes;
  size_t node_count, node_room;
  uint32_t *table; /* hash table that maps the position of a node to its index plus 1 */
  size_t slots, table_room;
  int32_t (*spoilt)[3]; /* positions of nodes on the level below that were not merged; therefore the nodes that contain
                         * them are not merged either */
  size_t spoilt_count, spoilt_room;
} octree;

/* ---- nodes of a level ---- */

static uint64_t hash_place(const int32_t *at) {
  uint64_t h = (uint64_t)at[0] << 42 ^ (uint64_t)at[1] << 21 ^ (uint64_t)at[2];
  h = (h ^ h >> 31) * UINT64_C(0xBF58476D1CE4E5B9);
  h = (h ^ h >> 27) * UINT64_C(0x94D049BB133111EB);
  return h ^ h >> 31;
}

/* Returns the index of the octree's node at this position. Makes the node if there is none. Returns NONE when memory is
 * out. The number of slots is a power of two, and exceeds the number of nodes. */
static uint32_t node_at(octree *o, const int32_t *at) {
  size_t h = hash_place(at) & (o->slots - 1);
  VS_ASSERT(o->slots > 0 && (o->slots & (o->slots - 1)) == 0);
  for (; o->table[h]; h = (h + 1) & (o->slots - 1))
    if (!memcmp(o->nodes[o->table[h] - 1].at, at, sizeof o->nodes->at)) return o->table[h] - 1;
  if (!VS_GROW(o->nodes, o->node_room, o->node_count + 1)) return NONE;
  o->nodes[o->node_count] = (node){ .at = { at[0], at[1], at[2] }, .whole = true };
  o->table[h] = (uint32_t)++o->node_count;
  return o->table[h] - 1;
}

/* Makes the octree's nodes of the current level. A node with a child that is not merged gets `whole` false. Returns
 * false when memory is out. */
static bool make_nodes(octree *o) {
  for (o->slots = 64; o->slots < 2 * (o->part_count + o->spoilt_count);) o->slots *= 2;
  if (!VS_GROW(o->table, o->table_room, o->slots)) return false;
  memset(o->table, 0, o->slots * sizeof *o->table);
  o->node_count = 0;
  for (size_t i = 0; i < o->spoilt_count; i++) {
    const int32_t at[3] = { o->spoilt[i][0] >> 1, o->spoilt[i][1] >> 1, o->spoilt[i][2] >> 1 };
    uint32_t n = node_at(o, at);
    if (n == NONE) return false;
    o->nodes[n].whole = false;
  }
  for (size_t i = 0; i < o->part_count; i++) {
    part *p = &o->parts[i];
    const int32_t *cell = o->l->place[p->ring];
    const int32_t at[3] = { cell[0] >> o->level, cell[1] >> o->level, cell[2] >> o->level };
    *p = (part){ .ring = p->ring, .node = node_at(o, at), .up = (uint32_t)i, .link = (uint32_t)i, .count = 1 };
    if (p->node == NONE) return false;
  }
  return true;
}

/* ---- parts that are joined ---- */

/* Returns the first ring (piece of the surface in a cell) of the part of the surface to which the given ring
 * belongs. */
static uint32_t first_ring(octree *o, uint32_t ring) {
  VS_ASSERT(ring < o->l->rings);
  while (o->of[ring] != ring) ring = o->of[ring] = o->of[o->of[ring]];
  return ring;
}

static uint32_t first_part(octree *o, uint32_t p) {
  while (o->parts[p].up != p) p = o->parts[p].up = o->parts[o->parts[p].up].up;
  return p;
}

static void swap(uint32_t *a, uint32_t *b) {
  uint32_t t = *a;
  *a = *b, *b = t;
}

/* Sets p[0] to p[3] to the parts of the surface that contain the four rings of a quad; NONE for a ring whose node
 * cannot be merged. */
static void parts_around(octree *o, uint32_t quad, uint32_t *p) {
  for (int k = 0; k < 4; k++) {
    p[k] = o->number[first_ring(o, o->l->around[quad][k])];
    if (p[k] != NONE && !o->nodes[o->parts[p[k]].node].whole) p[k] = NONE;
  }
}

static void join(octree *o) {
  for (size_t i = 0; i < o->quad_count; i++) {
    uint32_t p[4];
    parts_around(o, o->quads[i], p);
    for (int k = 0; k < 4; k++) {
      uint32_t a = p[k], b = p[(k + 1) % 4];
      if (a == NONE || b == NONE || o->parts[a].node != o->parts[b].node) continue;
      a = first_part(o, a), b = first_part(o, b);
      if (a == b) continue;
      o->parts[b].up = a;
      o->parts[a].count += o->parts[b].count;
      swap(&o->parts[a].link, &o->parts[b].link);
    }
  }
}

static void count(octree *o) {
  int32_t mask = (1 << o->level) - 1;
  for (size_t i = 0; i < o->quad_count; i++) {
    uint32_t quad = o->quads[i], p[4], first[4];
    const uint32_t *ring = o->l->around[quad];
    const int32_t *at = o->l->place[ring[0]];
    int axis = o->l->axis[quad], b = (axis + 1) % 3, d = (axis + 2) % 3;
    bool rim = !(at[b] & mask) && !(at[d] & mask);
    parts_around(o, quad, p);
    for (int k = 0; k < 4; k++) first[k] = p[k] == NONE ? NONE : first_part(o, p[k]);
    for (int k = 0; k < 4; k++) {
      if (first[k] == NONE) continue;
      part *to = &o->parts[first[k]];
      if (first[k] == first[(k + 1) % 4] && p[k] != p[(k + 1) % 4]) to->sides++;
      if (!rim) continue;
      const int32_t *cell = o->l->place[ring[k]];
      uint8_t *times = &to->rim[4 * axis + (cell[b] < at[b]) + 2 * (cell[d] < at[d])];
      if (*times < 2) ++*times;
    }
    bool one = first[0] != NONE && first[0] == first[1] && first[0] == first[2] && first[0] == first[3];
    if (one && !(p[0] == p[1] && p[0] == p[2] && p[0] == p[3])) o->parts[first[0]].inside++;
  }
}

/* ---- conditions under which a part of the surface gets one common point ---- */

static bool is_disc(const part *p) {
  int all = 0;
  if ((int32_t)p->count - p->sides / 2 + p->inside != 1) return false;
  for (int e = 0; e < EDGES; e++) {
    if (p->rim[e] > 1) return false;
    all += p->rim[e];
  }
  for (int face = 0; face < 6; face++) {
    int b = (face / 2 + 1) % 3, d = (face / 2 + 2) % 3, side = face & 1;
    /* lines: number of lines in which the part of the surface crosses this face of the node. An edge's position along b
     * is bit 1 of its number, its position along d is bit 0. */
    int lines =
        p->rim[4 * b + 2 * side] + p->rim[4 * b + 2 * side + 1] + p->rim[4 * d + side] + p->rim[4 * d + side + 2];
    if (lines != 0 && lines != 2) return false;
  }
  return all > 0;
}

/* EACH_RING runs the next statement for each ring r (piece of the surface) of all parts joined with part p. */
#define EACH_RING(o, p, r)                                                                                             \
  for (uint32_t q_ = (p), once_ = 1; once_ || q_ != (p); q_ = (o)->parts[q_].link, once_ = 0)                          \
    for (uint32_t r = (o)->parts[q_].ring, first_ = 1; first_ || r != (o)->parts[q_].ring; r = (o)->next[r], first_ = 0)

/* Returns the ring whose point all parts joined with part p may share, or NONE if no ring's point is near enough to the
 * planes. */
static uint32_t best_ring(const octree *o, uint32_t p) {
  const vs_octree_leaves *l = o->l;
  double limit = fmin(o->tolerance, BEND * l->size * (1 << o->level));
  if (o->parts[p].count == 1) return o->rep[o->parts[p].ring];
  vs_vec3 origin = l->point[o->parts[p].ring], middle = { 0, 0, 0 };
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, hx = 0, hy = 0, hz = 0, hh = 0, planes = 0, rings = 0;
  EACH_RING(o, p, r) {
    middle = vs_v3_add(middle, vs_v3_sub(l->point[r], origin)), rings++;
    for (uint32_t k = o->start[r]; k < o->start[r + 1]; k++, planes++) {
      vs_vec3 n = l->normal[o->list[k]];
      double h = vs_v3_dot(n, vs_v3_sub(l->root[o->list[k]], origin));
      xx += n.x * n.x, xy += n.x * n.y, xz += n.x * n.z, yy += n.y * n.y, yz += n.y * n.z, zz += n.z * n.z;
      hx += h * n.x, hy += h * n.y, hz += h * n.z, hh += h * h;
    }
  }
  middle = vs_v3_scale(middle, 1 / rings);
  uint32_t best = NONE;
  double least = INFINITY;
  EACH_RING(o, p, r) {
    vs_vec3 x = vs_v3_sub(l->point[r], origin), off = vs_v3_sub(x, middle);
    double squares = x.x * (xx * x.x + 2 * (xy * x.y + xz * x.z - hx)) + x.y * (yy * x.y + 2 * (yz * x.z - hy)) +
                     x.z * (zz * x.z - 2 * hz) + hh;
    double cost = fmax(0, squares) / planes + TO_MIDDLE * vs_v3_dot(off, off);
    if (cost < least) least = cost, best = r;
  }
  if (best == NONE) return NONE;
  vs_vec3 to = l->point[best];
  EACH_RING(o, p, r) {
    double nearest = INFINITY;
    for (uint32_t k = o->start[r]; k < o->start[r + 1]; k++)
      if (fabs(vs_v3_dot(l->normal[o->list[k]], vs_v3_sub(to, l->root[o->list[k]]))) > limit) return NONE;
    for (uint32_t k = o->start[best]; k < o->start[best + 1]; k++)
      nearest = fmin(nearest, fabs(vs_v3_dot(l->normal[o->list[k]], vs_v3_sub(to, l->point[r]))));
    if (nearest > limit) return NONE;
  }
  return best;
}

static bool judge(octree *o) {
  for (size_t i = 0; i < o->part_count; i++) {
    part *p = &o->parts[i];
    node *n = &o->nodes[p->node];
    if (i % 4096 == 4095 && !o->l->work.going(o->l->work.context, .95)) return false;
    if (p->up != i || !n->whole) continue;
    p->best = is_disc(p) ? best_ring(o, (uint32_t)i) : NONE;
    if (p->best == NONE) n->whole = false;
  }
  return true;
}

/* ---- levels of the octree ---- */

/* Merges all nodes of the current level whose parts fulfil the conditions for merging. Their joined parts become the
 * parts of the next level. Returns false when memory is out. */
static bool merge(octree *o) {
  size_t parts = 0, quads = 0;
  o->spoilt_count = 0;
  for (size_t i = 0; i < o->node_count; i++) {
    if (o->nodes[i].whole) continue;
    if (!VS_GROW(o->spoilt, o->spoilt_room, o->spoilt_count + 1)) return false;
    memcpy(o->spoilt[o->spoilt_count++], o->nodes[i].at, sizeof *o->spoilt);
  }
  for (size_t i = 0; i < o->part_count; i++) {
    part *p = &o->parts[i];
    o->number[p->ring] = NONE;
    if (!o->nodes[p->node].whole) continue;
    uint32_t first = o->parts[first_part(o, (uint32_t)i)].ring;
    if (first == p->ring) continue;
    o->of[p->ring] = first;
    swap(&o->next[p->ring], &o->next[first]);
  }
  for (size_t i = 0; i < o->part_count; i++) {
    part p = o->parts[i];
    if (!o->nodes[p.node].whole || p.up != i) continue;
    o->rep[p.ring] = p.best;
    o->number[p.ring] = (uint32_t)parts;
    o->parts[parts++].ring = p.ring; /* elements of `parts` before index p were already read, and may be overwritten */
  }
  o->part_count = parts;
  for (size_t i = 0; i < o->quad_count; i++) {
    uint32_t quad = o->quads[i], first[4];
    bool live = false, one = true;
    for (int k = 0; k < 4; k++) {
      first[k] = first_ring(o, o->l->around[quad][k]);
      live = live || o->number[first[k]] != NONE;
      one = one && first[k] == first[0];
    }
    if (live && !one) o->quads[quads++] = quad;
  }
  o->quad_count = quads;
  return true;
}

/* Makes, for each ring (piece of the surface in a cell), the list of the quads that contain its point. Returns false
 * when memory is out. */
static bool list_quads(octree *o) {
  const vs_octree_leaves *l = o->l;
  size_t room[2] = { 0, 0 };
  if (!VS_GROW(o->start, room[0], l->rings + 2) || !VS_GROW(o->list, room[1], 4 * l->quads + 1)) return false;
  memset(o->start, 0, (l->rings + 2) * sizeof *o->start);
  for (size_t i = 0; i < l->quads; i++)
    for (int k = 0; k < 4; k++) o->start[l->around[i][k] + 2]++;
  for (size_t r = 2; r < l->rings + 2; r++) o->start[r] += o->start[r - 1];
  for (size_t i = 0; i < l->quads; i++)
    for (int k = 0; k < 4; k++) o->list[o->start[l->around[i][k] + 1]++] = (uint32_t)i;
  return true;
}

static bool begin(octree *o) {
  const vs_octree_leaves *l = o->l;
  size_t room[5] = { 0 };
  if (!VS_GROW(o->of, room[0], l->rings) || !VS_GROW(o->next, room[1], l->rings) ||
      !VS_GROW(o->rep, room[2], l->rings) || !VS_GROW(o->number, room[3], l->rings) ||
      !VS_GROW(o->quads, room[4], l->quads) || !VS_GROW(o->parts, o->part_room, l->rings) || !list_quads(o))
    return false;
  for (uint32_t r = 0; r < l->rings; r++) {
    o->of[r] = o->next[r] = o->rep[r] = r;
    o->number[r] = l->barred[r] ? NONE : (uint32_t)o->part_count;
    if (!l->barred[r])
      o->parts[o->part_count++].ring = r;
    else if (!VS_GROW(o->spoilt, o->spoilt_room, o->spoilt_count + 1))
      return false;
    else
      memcpy(o->spoilt[o->spoilt_count++], l->place[r], sizeof *o->spoilt);
  }
  for (uint32_t i = 0; i < l->quads; i++) o->quads[i] = i;
  o->quad_count = l->quads;
  return true;
}

vs_octree_outcome vs_octree_merge(const vs_octree_leaves *leaves, double tolerance, uint32_t *stands_for) {
  octree o = { .l = leaves, .tolerance = tolerance, .level = 1 };
  bool ok = begin(&o), on = true;
  VS_ASSERT(tolerance >= 0);
  for (; ok && on && o.level < LEVELS && o.part_count; o.level++) {
    ok = make_nodes(&o);
    if (!ok) break;
    join(&o);
    count(&o);
    on = judge(&o);
    ok = on && merge(&o);
  }
  for (uint32_t r = 0; ok && r < leaves->rings; r++) stands_for[r] = o.rep[first_ring(&o, r)];
  free(o.of), free(o.next), free(o.rep), free(o.number), free(o.start), free(o.list);
  free(o.parts), free(o.quads), free(o.nodes), free(o.table), free(o.spoilt);
  return ok ? VS_OCTREE_DONE : on ? VS_OCTREE_MEMORY : VS_OCTREE_STOPPED;
}
