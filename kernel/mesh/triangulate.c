/* Triangulates a polygon by a plane sweep that cuts off each triangle as soon as it is visible.
 *
 * The sweep visits the vertices in the order of x. The status contains the edges that cross the sweep line. Each
 * interval inside the polygon between two neighbouring edges has a chain. The chain is the left border of the space, up
 * to the sweep line, that has no triangles yet. It goes from the left end of the interval's lower edge to the left end
 * of its upper edge. The coordinate x decreases from the chain's rightmost corner to both ends, and every other corner
 * between is reflex. Therefore a new vertex at an end of the chain sees the chain's corners one after another. A new
 * vertex in the middle sees the rightmost corner. The sweep takes n log n steps, and all decisions are exact. Every
 * corner of the polygon is used, so neighbouring polygons have no T-junctions.
 *
 * Most faces have few corners, and a border that consists of one lower and one upper side. For these faces, a single
 * chain without a status suffices. */
#include "kernel/mesh/triangulate.h"

#include <stdlib.h>

typedef struct { vs_kernel *k; vs_triangulation *t; } cutter;

/* Appends the triangle x, y, z, which are three different vertices of the sweep. */
static bool emit(cutter *c, uint32_t x, uint32_t y, uint32_t z) {
  vs_triangulation *t = c->t;
  VS_ASSERT(x != y && y != z && z != x);
  if (!VS_ROOM(c->k, t->triangles.at, t->triangles.room, t->triangles.count + 1)) return false;
  uint32_t *o = t->triangles.at[t->triangles.count++];
  o[0] = t->sweep.vertices.at[x];
  o[1] = t->sweep.vertices.at[y];
  o[2] = t->sweep.vertices.at[z];
  return true;
}

static bool node(cutter *c, uint32_t vertex, uint32_t *out) {
  *out = (uint32_t)c->t->nodes.count;
  return VS_PUSH(c->k, c->t->nodes, ((vs_chain_node){ vertex, VS_NONE, VS_NONE }));
}

static bool start(cutter *c, uint32_t edge, uint32_t v) {
  vs_chain *x = &c->t->chains.at[edge];
  if (!node(c, v, &x->head)) return false;
  x->tail = x->rightmost = x->head;
  return true;
}

/* Cuts off the triangles that vertex v sees from the upper end of chain x, the border of the untriangulated space. */
static bool cut_tail(cutter *c, vs_chain *x, uint32_t v) {
  vs_chain_node *n = c->t->nodes.at;
  while (x->tail != x->head) {
    uint32_t last = x->tail, before = n[last].previous;
    if (vs_sweep_turn(&c->t->sweep, v, n[last].vertex, n[before].vertex) <= 0) break;
    if (!emit(c, v, n[last].vertex, n[before].vertex)) return false;
    x->tail = before;
    n[before].next = VS_NONE;
  }
  return true;
}

static bool cut_head(cutter *c, vs_chain *x, uint32_t v) {
  vs_chain_node *n = c->t->nodes.at;
  while (x->tail != x->head) {
    uint32_t first = x->head, after = n[first].next;
    if (vs_sweep_turn(&c->t->sweep, n[after].vertex, n[first].vertex, v) <= 0) break;
    if (!emit(c, n[after].vertex, n[first].vertex, v)) return false;
    x->head = after;
    n[after].previous = VS_NONE;
  }
  return true;
}

static bool extend_tail(cutter *c, vs_chain *x, uint32_t v) {
  uint32_t added;
  if (!cut_tail(c, x, v) || !node(c, v, &added)) return false;
  vs_chain_node *n = c->t->nodes.at;
  n[x->tail].next = added;
  n[added].previous = x->tail;
  x->tail = x->rightmost = added;
  return true;
}

static bool extend_head(cutter *c, vs_chain *x, uint32_t v) {
  uint32_t added;
  if (!cut_head(c, x, v) || !node(c, v, &added)) return false;
  vs_chain_node *n = c->t->nodes.at;
  n[x->head].previous = added;
  n[added].next = x->head;
  x->head = x->rightmost = added;
  return true;
}

/* Splits the chain above edge `below` at its rightmost corner, which vertex v sees. A chain is the left border of the
 * space that has no triangles yet. The edge `below` keeps the lower part, and the edge `above`, a different edge, gets
 * the upper part. */
static bool split(cutter *c, uint32_t below, uint32_t above, uint32_t v) {
  vs_chain *x = &c->t->chains.at[below], *y = &c->t->chains.at[above];
  uint32_t middle = x->rightmost, copy;
  VS_ASSERT(below != above);
  if (!node(c, c->t->nodes.at[middle].vertex, &copy)) return false;
  vs_chain_node *n = c->t->nodes.at;
  y->head = copy;
  y->tail = x->tail == middle ? copy : x->tail;
  n[copy].next = n[middle].next;
  if (n[copy].next != VS_NONE) n[n[copy].next].previous = copy;
  n[middle].next = VS_NONE;
  x->tail = middle;
  return extend_tail(c, x, v) && extend_head(c, y, v);
}

/* Returns true if the edges at a vertex bound the polygon consistently. Upwards across all of them, a path starts
 * inside the polygon if `under` is true, and ends inside it if `over` is true. */
static bool agree(const vs_boundary *edges, const uint32_t *at, uint32_t count, bool under, bool over) {
  for (uint32_t i = 0; i < count; i++) {
    if ((bool)(edges[at[i]].inside & 2) != under) return false;
    under = edges[at[i]].inside & 1;
  }
  return under == over;
}

static bool step(cutter *c, const vs_sweep_event *e) {
  vs_triangulation *t = c->t;
  const vs_boundary *edges = t->boundary.at;
  uint32_t v = e->vertex, m = e->left_count, n = e->right_count;
  bool under = e->below != VS_NONE && (edges[e->below].inside & 1), over = under;
  if (m) over = edges[e->lefts[m - 1]].inside & 1;
  if (!agree(edges, e->lefts, m, under, over) || !agree(edges, e->rights, n, under, over))
    return VS_BROKEN(c->k, "a face lies on itself");
  if (m) {
    uint32_t last = e->lefts[m - 1];
    if (under && !extend_tail(c, &t->chains.at[e->below], v)) return false;
    for (uint32_t i = 0; i + 1 < m; i++) {
      vs_chain *x = &t->chains.at[e->lefts[i]];
      if (!(edges[e->lefts[i]].inside & 1)) continue;
      for (size_t before = SIZE_MAX; x->head != x->tail && t->triangles.count != before;) {
        before = t->triangles.count;
        if (!cut_tail(c, x, v) || !cut_head(c, x, v)) return false;
      }
      if (x->head != x->tail) return VS_BROKEN(c->k, "a face does not close");
    }
    if (over && !extend_head(c, &t->chains.at[last], v)) return false;
    if (n) t->chains.at[e->rights[n - 1]] = t->chains.at[last];
    else if (under != over) return VS_BROKEN(c->k, "a face has no border");
    else if (under) { /* vertex v lies between two intervals inside the polygon: it ends the chain of the lower interval
                       * and begins the chain of the upper one */
      vs_chain *x = &t->chains.at[e->below], *y = &t->chains.at[last];
      vs_chain_node *nodes = t->nodes.at;
      uint32_t second = nodes[y->head].next;
      nodes[x->tail].next = second;
      if (second != VS_NONE) nodes[second].previous = x->tail, x->rightmost = x->tail, x->tail = y->tail;
    }
  } else if (under && n && !split(c, e->below, e->rights[n - 1], v)) {
    return false;
  }
  for (uint32_t i = 0; i + 1 < n; i++)
    if ((edges[e->rights[i]].inside & 1) && !start(c, e->rights[i], v)) return false;
  return true;
}

/* ---- small faces: a single border that goes right along the bottom and returns along the top ---- */

enum { SMALL = 32 };

static bool before(const vs_sweep *s, uint32_t a, uint32_t b) {
  int sign = vs_compare(s->points, a, b, s->u);
  return sign < 0 || (sign == 0 && vs_compare(s->points, a, b, s->v) < 0);
}

/* Orders the sides of the border as a loop that starts at its leftmost corner; *last: position of its rightmost corner.
 * Returns false if the sides are not one loop that goes right along the bottom and returns along the top. */
static bool find_loop(const vs_triangulation *t, uint32_t loop[SMALL], uint32_t *last) {
  uint32_t n = (uint32_t)t->sides.count, first = 0, at = 0;
  const vs_border *sides = t->sides.at;
  if (n < 3 || n > SMALL) return false;
  for (uint32_t i = 1; i < n; i++)
    if (before(&t->sweep, sides[i].from, sides[first].from)) first = i;
  at = first;
  for (uint32_t i = 0; i < n; i++) {
    uint32_t next = n;
    loop[i] = sides[at].from;
    for (uint32_t j = 0; j < n; j++) {
      if (sides[j].from != sides[at].to) continue;
      if (next != n) return false; /* two sides begin at this corner, so the border touches itself there */
      next = j;
    }
    if (next == n || (next == first) != (i == n - 1)) return false;
    at = next;
  }
  uint32_t i = 1;
  while (i < n && before(&t->sweep, loop[i - 1], loop[i])) i++;
  *last = i - 1;
  while (i < n && before(&t->sweep, loop[i], loop[i - 1])) i++;
  return i == n;
}

/* Triangulates a small face of 3 to SMALL sides with one stack instead of a sweep. The triangles are equal to those of
 * the sweep. last: position of the loop's rightmost corner. */
static bool cut_loop(cutter *c, const uint32_t *loop, uint32_t last) {
  vs_triangulation *t = c->t;
  const vs_sweep *s = &t->sweep;
  uint32_t n = (uint32_t)t->sides.count, chain[2 * SMALL + 1], head = SMALL, tail = SMALL, low = 1, high = n - 1;
  VS_ASSERT(n >= 3 && n <= SMALL);
  if (!VS_ROOM(c->k, t->triangles.at, t->triangles.room, n)) return false;
  uint32_t (*to)[3] = t->triangles.at;
  size_t count = 0;
#define TURN(x, y, z) (vs_orient2d(s->points, (x), (y), (z), s->u, s->v) > 0)
#define EMIT(x, y, z) (to[count][0] = (x), to[count][1] = (y), to[count++][2] = (z))
  chain[head] = loop[0];
  while (low < last || high > last) {
    bool below = low < last && (high == last || before(s, loop[low], loop[high]));
    uint32_t v = below ? loop[low++] : loop[high--];
    if (below) {
      for (; head < tail && TURN(chain[head + 1], chain[head], v); head++) EMIT(chain[head + 1], chain[head], v);
      chain[--head] = v;
    } else {
      for (; head < tail && TURN(v, chain[tail], chain[tail - 1]); tail--) EMIT(v, chain[tail], chain[tail - 1]);
      chain[++tail] = v;
    }
  }
  for (size_t was = SIZE_MAX; head < tail && was != count;) {
    was = count;
    for (; head < tail && TURN(loop[last], chain[tail], chain[tail - 1]); tail--)
      EMIT(loop[last], chain[tail], chain[tail - 1]);
    for (; head < tail && TURN(chain[head + 1], chain[head], loop[last]); head++)
      EMIT(chain[head + 1], chain[head], loop[last]);
  }
#undef TURN
#undef EMIT
  t->triangles.count = count;
  return head == tail || VS_BROKEN(c->k, "a face does not close");
}

static int boundary_order(const void *a, const void *b) {
  const vs_boundary *x = a, *y = b;
  if (x->l != y->l) return x->l < y->l ? -1 : 1;
  if (x->r != y->r) return x->r < y->r ? -1 : 1;
  return x->inside < y->inside ? -1 : x->inside > y->inside;
}

bool vs_plane_triangulate(vs_kernel *k, vs_triangulation *t, const vs_points_table *points, const vs_plane *plane) {
  cutter c = { k, t };
  size_t n = t->sides.count;
  uint32_t loop[SMALL], last;
  t->triangles.count = t->nodes.count = t->boundary.count = t->sweep.edges.count = 0;
  t->sweep.points = vs_points_of(points);
  t->sweep.u = plane->u;
  t->sweep.v = plane->v;
  if (find_loop(t, loop, &last)) return cut_loop(&c, loop, last);
  if (!VS_ROOM(k, t->list.at, t->list.room, 2 * n + 1) || !VS_ROOM(k, t->scratch.at, t->scratch.room, 2 * n + 1) ||
      !VS_ROOM(k, t->local.at, t->local.room, points->all.count) || !VS_ROOM(k, t->chains.at, t->chains.room, n + 1))
    return false;
  for (size_t i = 0; i < n; i++) t->local.at[t->sides.at[i].from] = t->local.at[t->sides.at[i].to] = VS_NONE;
  size_t unique = 0;
  for (size_t i = 0; i < 2 * n; i++) {
    uint32_t p = i & 1 ? t->sides.at[i / 2].to : t->sides.at[i / 2].from;
    if (t->local.at[p] == VS_NONE) t->local.at[p] = 0, t->list.at[unique++] = p;
  }
  if (!vs_sweep_order(k, &t->sweep, t->list.at, unique, t->scratch.at)) return false;
  for (uint32_t i = 0; i < t->sweep.vertices.count; i++) t->local.at[t->sweep.vertices.at[i]] = i;
  for (size_t i = 0; i < n; i++) {
    uint32_t a = t->local.at[t->sides.at[i].from], b = t->local.at[t->sides.at[i].to];
    if (!VS_PUSH(k, t->boundary, ((vs_boundary){ a < b ? a : b, a < b ? b : a, a < b ? 1 : 2 }))) return false;
  }
  if (n) qsort(t->boundary.at, t->boundary.count, sizeof *t->boundary.at, boundary_order);
  size_t kept = 0;
  for (size_t i = 0; i < t->boundary.count; i++) {
    vs_boundary b = t->boundary.at[i];
    if (kept && t->boundary.at[kept - 1].l == b.l && t->boundary.at[kept - 1].r == b.r)
      t->boundary.at[kept - 1].inside |= b.inside;
    else t->boundary.at[kept++] = b;
  }
  t->boundary.count = kept;
  for (size_t i = 0; i < kept; i++)
    if (!VS_PUSH(k, t->sweep.edges, ((vs_sweep_edge){ t->boundary.at[i].l, t->boundary.at[i].r }))) return false;
  if (!vs_sweep_begin(k, &t->sweep)) return false;
  vs_sweep_event e;
  while (vs_sweep_next(k, &t->sweep, &e))
    if (!step(&c, &e)) return false;
  return vs_sweep_done(&t->sweep);
}

void vs_triangulation_free(vs_kernel *k, vs_triangulation *t) {
  VS_DROP(k, t->sides);
  VS_DROP(k, t->triangles);
  vs_sweep_free(k, &t->sweep);
  VS_DROP(k, t->list);
  VS_DROP(k, t->scratch);
  VS_DROP(k, t->local);
  VS_DROP(k, t->boundary);
  VS_DROP(k, t->nodes);
  VS_DROP(k, t->chains);
}
