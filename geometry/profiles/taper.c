/* Makes extrusions with inclined walls. Every edge of the profile moves inwards or outwards at the same speed, and its
 * wall is the plane of this motion.
 *
 * In the profile's plane, edge i lies on the line sign (n_i . x - c_i) = d. n_i is its unit normal into the material;
 * d, the time, grows from 0 to its end. The corner of two neighbouring edges moves with the velocity sign (n_i + n_j) /
 * (1 + n_i . n_j). Two kinds of event occur (the straight skeleton of the profile). First, an edge vanishes when its
 * two corners come together, and its neighbours become neighbours of each other. Second, a reflex corner hits the edge
 * of another wall and splits it. This also splits the loop, or joins a hole to the loop around it. A loop of two edges
 * ends in a point, or in a ridge if the edges coincide. Events wait in a heap. Each event is checked again when its
 * turn comes, because its edges may have changed. Each wall is one planar polygon. It consists of its edge below, the
 * tracks of the corners on both sides of it (or of its pieces, if it was split), and the parts of the edge that reach
 * the top. The running time is the number of reflex corners times the number of edges, times a logarithm. */
#include "geometry/profiles/taper.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/plane/outline.h"

#include <stdlib.h>

#include "geometry/plane/ear_clipping.h"
#include "geometry/profiles/taper_path.h"
#include "model/store/array.h"

typedef struct { uint32_t *at; size_t count, room; } taper_chain;

typedef struct { /* A piece of an edge of the profile, or the entire edge if it was never split. */
  vs_vec2 normal, way;      /* normal: unit normal of the edge into the material; way: unit direction of the edge, with
                             * the material on its left */
  double line;              /* scalar product of `normal` with any point of the edge at the bottom of the wall */
  size_t before, after;     /* indices of the edges before and after this one in the current loop */
  taper_chain left, right;  /* vertices on the paths of the edge's two corners, upwards. left: path of the corner with
                             * the edge `before`; right: path of the corner with the edge `after`. */
  vs_vec2 corner;           /* the corner between this edge and the edge `after`: its position at the time `since`, when
                             * its velocity last changed */
  double since;
  size_t next_piece;        /* index of the next piece of this edge's wall, to the left; SIZE_MAX if there is none */
  uint32_t stamp, corner_stamp;
  bool gone;
} taper_edge;

typedef struct {
  double d;
  size_t edge, wall /* An event: if wall is SIZE_MAX, `edge` vanishes; otherwise the corner between `edge` and the edge
                     * `after` hits the edge number `wall`. */;
  uint32_t stamp;
} taper_event;

typedef struct {
  taper_edge *edges;
  size_t count, room, walls; /* count: number of edges; walls: number of the profile's own edges, which come first; the
                              * edges after them are pieces of these */
  taper_event *events;
  size_t event_count, event_room;
  double sign, end, size;   /* sign: 1 if the edges move inwards, -1 outwards; end: distance by which the edges move
                             * from the bottom to the top; size: size of the profile */
  vs_mesh *out;
  vs_vec2 *flat;            /* for each vertex of out, from vertex `first` on: flat: its position in the profile's
                             * plane; d: the distance by which edges have moved at its height */
  double *level;
  size_t flat_room;
  uint32_t first;
  const vs_affine *frame;   /* map from (u, v, 0) in the profile's plane to space */
  vs_vec3 rise;             /* vector in space from the bottom to the top, by which the profile moves */
} taper;

static double taper_dot(vs_vec2 a, vs_vec2 b) { return a.x * b.x + a.y * b.y; }
static double taper_cross(vs_vec2 a, vs_vec2 b) { return a.x * b.y - a.y * b.x; }

static bool taper_push(taper_chain *c, uint32_t v) {
  if (c->count && c->at[c->count - 1] == v) return true;
  if (!VS_GROW(c->at, c->room, c->count + 1)) return false;
  c->at[c->count++] = v;
  return true;
}

static bool taper_vertex(taper *t, vs_vec2 p, double d, uint32_t *index) {
  size_t k = t->out->vertex_count - t->first;
  if (k >= t->flat_room) {
    size_t flats = t->flat_room, levels = t->flat_room;
    if (!VS_GROW(t->flat, flats, k + 1) || !VS_GROW(t->level, levels, k + 1)) return false;
    t->flat_room = levels;
  }
  t->flat[k] = p;
  t->level[k] = d;
  vs_vec3 at = vs_v3_add(vs_affine_point(t->frame, vs_v3(p.x, p.y, 0)), vs_v3_scale(t->rise, d / t->end));
  return vs_mesh_add_vertex(t->out, at, index);
}

/* ---- corners of two edges ---- */

/* Computes the velocity of the corner between edges i and j, as movement for each unit by which the edges move. Returns
 * false if the edges are antiparallel, so that the corner has no velocity. */
static bool taper_speed(const taper *t, size_t i, size_t j, vs_vec2 *speed) {
  vs_vec2 a = t->edges[i].normal, b = t->edges[j].normal;
  double k = 1 + taper_dot(a, b);
  *speed = (vs_vec2){ 0, 0 };
  if (k < 1e-9) return false;
  *speed = (vs_vec2){ t->sign * (a.x + b.x) / k, t->sign * (a.y + b.y) / k };
  return true;
}

static vs_vec2 taper_corner(const taper *t, size_t i, double d) { /* returns the position of the corner between edge i
                                                                   * and the edge after it, when the edges have moved by
                                                                   * d */
  const taper_edge *e = &t->edges[i];
  vs_vec2 speed;
  taper_speed(t, i, e->after, &speed);
  return (vs_vec2){ e->corner.x + speed.x * (d - e->since), e->corner.y + speed.y * (d - e->since) };
}

static bool taper_runs_ahead(const taper *t, size_t i) {
  return t->sign * taper_cross(t->edges[i].way, t->edges[t->edges[i].after].way) < -1e-9;
}

static double taper_length(const taper *t, size_t i, double d) {
  vs_vec2 a = taper_corner(t, t->edges[i].before, d), b = taper_corner(t, i, d);
  return hypot(b.x - a.x, b.y - a.y);
}

static bool taper_near(const taper *t, vs_vec2 a, vs_vec2 b) { return hypot(a.x - b.x, a.y - b.y) <= 1e-9 * t->size; }

/* ---- events ---- */

static bool taper_sooner(const taper_event *a, const taper_event *b) {
  if (a->d != b->d) return a->d < b->d;
  if ((a->wall == SIZE_MAX) != (b->wall == SIZE_MAX)) return a->wall == SIZE_MAX; /* an event in which an edge vanishes
                                                                                   * comes before an event in which a
                                                                                   * corner hits a wall */
  return a->edge != b->edge ? a->edge < b->edge : a->wall < b->wall;
}

static bool taper_expect(taper *t, taper_event e) {
  if (!(e.d < t->end)) return true;
  if (!VS_GROW(t->events, t->event_room, t->event_count + 1)) return false;
  size_t i = t->event_count++;
  for (; i && taper_sooner(&e, &t->events[(i - 1) / 2]); i = (i - 1) / 2) t->events[i] = t->events[(i - 1) / 2];
  t->events[i] = e;
  return true;
}

static taper_event taper_next(taper *t) {
  taper_event first = t->events[0], last = t->events[--t->event_count];
  size_t i = 0;
  for (size_t child; (child = 2 * i + 1) < t->event_count; i = child) {
    if (child + 1 < t->event_count && taper_sooner(&t->events[child + 1], &t->events[child])) child++;
    if (!taper_sooner(&t->events[child], &last)) break;
    t->events[i] = t->events[child];
  }
  if (t->event_count) t->events[i] = last;
  return first;
}

/* Returns the time d at which edge i vanishes. Returns INFINITY if it does not vanish as long as its neighbours stay.
 * now: the present time. */
static double taper_vanishes(const taper *t, size_t i, double now) {
  size_t p = t->edges[i].before, q = t->edges[i].after;
  vs_vec2 left, right, way = t->edges[i].way;
  bool stuck_p = !taper_speed(t, p, i, &left), stuck_q = !taper_speed(t, i, q, &right);
  VS_ASSERT(i < t->count);
  if (stuck_p || stuck_q) { /* a neighbour lies on the line of edge i with the opposite direction, so the shorter of the
                             * two vanishes at once */
    double own = taper_length(t, i, now), other = stuck_p ? taper_length(t, p, now) : taper_length(t, q, now);
    return own <= other ? now : INFINITY;
  }
  double closing = taper_dot((vs_vec2){ left.x - right.x, left.y - right.y }, way);
  vs_vec2 a = taper_corner(t, p, now), b = taper_corner(t, i, now);
  double length = taper_dot((vs_vec2){ b.x - a.x, b.y - a.y }, way);
  if (fabs(closing) <= 1e-9) return fabs(length) <= 1e-9 * t->size ? now : INFINITY;
  return closing < 0 ? INFINITY : now + fmax(length, 0) / closing;
}

static bool taper_expect_vanishing(taper *t, size_t i, double now) {
  return taper_expect(t, (taper_event){ taper_vanishes(t, i, now), i, SIZE_MAX, ++t->edges[i].stamp });
}

/* Adds events for the edges that the corner between edge i and the edge after it may hit. Returns false when memory is
 * out. */
static bool taper_expect_hits(taper *t, size_t i, double now) {
  vs_vec2 speed, at = taper_corner(t, i, now);
  uint32_t stamp = ++t->edges[i].corner_stamp;
  if (!taper_runs_ahead(t, i) || !taper_speed(t, i, t->edges[i].after, &speed)) return true;
  for (size_t w = 0; w < t->walls; w++) {
    const taper_edge *e = &t->edges[w];
    double gap = t->sign * (taper_dot(e->normal, at) - e->line) - now,
           closing = 1 - t->sign * taper_dot(e->normal, speed);
    if (closing <= 1e-9 || gap < -1e-9 * t->size) continue;
    if (!taper_expect(t, (taper_event){ now + fmax(gap, 0) / closing, i, w, stamp })) return false;
  }
  return true;
}

/* Makes edges p and q, which differ, neighbours. The corner between them is at the position `at` at the time d. */
static void taper_join(taper *t, size_t p, size_t q, vs_vec2 at, double d) {
  VS_ASSERT(p != q);
  t->edges[p].after = q;
  t->edges[q].before = p;
  t->edges[p].corner = at;
  t->edges[p].since = d;
}

/* Ends a loop that consists of only two edges, p and q. The vertex v is at their corner, at the position `at`. Returns
 * false when memory is out. */
static bool taper_finish(taper *t, size_t p, size_t q, double d, vs_vec2 at, uint32_t v) {
  vs_vec2 other = taper_corner(t, q, d);
  uint32_t w = v;
  bool ok = taper_near(t, other, at) || taper_vertex(t, other, d, &w);
  VS_ASSERT(p != q);
  t->edges[p].gone = t->edges[q].gone = true;
  return ok && taper_push(&t->edges[q].right, w) && taper_push(&t->edges[p].left, w);
}

/* Continues after an event at the corner between edge p and the edge after it: ends the loop if it has only two edges,
 * else adds new events. Returns false when memory is out. */
static bool taper_settle(taper *t, size_t p, double d, uint32_t v) {
  size_t q = t->edges[p].after;
  if (t->edges[p].gone) return true;
  if (t->edges[q].after == p) return taper_finish(t, p, q, d, t->edges[p].corner, v);
  return taper_expect_vanishing(t, p, d) && taper_expect_vanishing(t, q, d) && taper_expect_hits(t, p, d);
}

/* Removes edge i, which vanishes at the time d, and makes its two neighbours neighbours of each other. Returns false
 * when memory is out. */
static bool taper_remove(taper *t, size_t i, double d) {
  taper_edge *e = &t->edges[i];
  size_t p = e->before, q = e->after;
  vs_vec2 speed, a = taper_corner(t, p, d), b = taper_corner(t, i, d);
  bool stuck_p = !taper_speed(t, p, i, &speed), stuck_q = !taper_speed(t, i, q, &speed);
  /* A neighbour with the opposite direction lies on the edge: the edge vanishes at once, at its other corner. Otherwise
   * it vanishes at its middle. */
  vs_vec2 at = stuck_p ? b : stuck_q ? a : (vs_vec2){ (a.x + b.x) / 2, (a.y + b.y) / 2 };
  uint32_t v, w;
  bool ok = taper_vertex(t, at, d, &v);
  VS_ASSERT(!t->edges[i].gone);
  if (stuck_p && t->edges[p].since < d)
    ok = ok && taper_vertex(t, a, d, &w) && taper_push(&t->edges[p].right, w) && taper_push(&e->left, w);
  if (stuck_q && !stuck_p && e->since < d)
    ok = ok && taper_vertex(t, b, d, &w) && taper_push(&t->edges[q].left, w) && taper_push(&e->right, w);
  ok = ok && taper_push(&e->left, v) && taper_push(&e->right, v) && taper_push(&t->edges[p].right, v) &&
       taper_push(&t->edges[q].left, v);
  e->gone = true;
  taper_join(t, p, q, at, d);
  return ok && taper_settle(t, p, d, v);
}

/* Returns the piece of a wall's edge that contains the position `at` at the time d, or SIZE_MAX if there is none.
 * Pieces p and q are ignored. */
static size_t taper_piece_at(const taper *t, size_t wall, vs_vec2 at, double d, size_t p, size_t q) {
  double slack = 1e-9 * t->size;
  for (size_t i = wall; i != SIZE_MAX; i = t->edges[i].next_piece) {
    const taper_edge *e = &t->edges[i];
    if (e->gone || i == p || i == q || e->before == q || e->after == p) continue;
    vs_vec2 a = taper_corner(t, e->before, d), b = taper_corner(t, i, d);
    double from = taper_dot((vs_vec2){ at.x - a.x, at.y - a.y }, e->way),
           to = taper_dot((vs_vec2){ b.x - at.x, b.y - at.y }, e->way);
    if (from >= -slack && to >= -slack) return i;
  }
  return SIZE_MAX;
}

/* Splits a piece of a wall's edge at the corner between edge p and the edge after it. The first part (ahead) follows p
 * in p's loop; the second part (behind) precedes the edge after p in its loop. Returns false when memory is out. */
static bool taper_split(taper *t, size_t p, size_t wall, double d) {
  size_t q = t->edges[p].after;
  vs_vec2 at = taper_corner(t, p, d);
  size_t ahead = taper_piece_at(t, wall, at, d, p, q);
  /* Each corner can split an edge only once. If there are more pieces, rounding errors have made them, and they are
   * ignored. */
  if (ahead == SIZE_MAX || t->count >= 3 * t->walls) return true;
  if (!VS_GROW(t->edges, t->room, t->count + 1)) return false;
  size_t behind = t->count++;
  taper_edge *e = &t->edges[ahead], *l = &t->edges[behind];
  *l = (taper_edge){ .normal = e->normal,
                     .way = e->way,
                     .line = e->line,
                     .before = e->before,
                     .left = e->left,
                     .next_piece = e->next_piece };
  e->left = (taper_chain){ 0 };
  e->next_piece = behind;
  t->edges[l->before].after = behind;
  uint32_t v;
  bool ok = taper_vertex(t, at, d, &v) && taper_push(&e->left, v) && taper_push(&l->right, v) &&
            taper_push(&t->edges[p].right, v) && taper_push(&t->edges[q].left, v);
  taper_join(t, p, ahead, at, d);
  taper_join(t, behind, q, at, d);
  return ok && taper_settle(t, p, d, v) && taper_settle(t, behind, d, v);
}

static bool taper_run(taper *t) {
  double now = 0;
  size_t edges = t->count;
  for (size_t i = 0; i < edges; i++)
    if (!taper_expect_vanishing(t, i, 0) || !taper_expect_hits(t, i, 0)) return false;
  while (t->event_count) {
    taper_event e = taper_next(t);
    if (t->edges[e.edge].gone ||
        e.stamp != (e.wall == SIZE_MAX ? t->edges[e.edge].stamp : t->edges[e.edge].corner_stamp))
      continue;
    if (e.d > now) now = e.d;
    if (!(e.wall == SIZE_MAX ? taper_remove(t, e.edge, now) : taper_split(t, e.edge, e.wall, now))) return false;
  }
  for (size_t i = 0; i < t->count; i++) { /* the edges that are left have not vanished, so they reach the top */
    if (t->edges[i].gone) continue;
    uint32_t v;
    if (!taper_vertex(t, taper_corner(t, i, t->end), t->end, &v) || !taper_push(&t->edges[i].right, v) ||
        !taper_push(&t->edges[t->edges[i].after].left, v))
      return false;
  }
  return true;
}

/* ---- walls and caps ---- */

/* Appends the faces of the wall over an edge of the profile. Returns false when memory is out. */
static bool taper_wall(taper *t, size_t wall) {
  const taper_edge *e = &t->edges[wall];
  size_t n = 0, k = 0;
  VS_ASSERT(wall < t->count);
  for (size_t i = wall; i != SIZE_MAX; i = t->edges[i].next_piece)
    n += t->edges[i].left.count + t->edges[i].right.count;
  vs_vec2 *at = vs_fresh(n, sizeof *at);
  uint32_t *index = vs_fresh(n, sizeof *index);
  bool ok = at && index;
  /* Collects the border of the wall: visits its pieces from right to left, and goes upwards on the right side of each
   * piece and downwards on its left side. */
  for (size_t i = wall; ok && i != SIZE_MAX; i = t->edges[i].next_piece) {
    const taper_edge *p = &t->edges[i];
    for (size_t j = 0; j < p->right.count; j++)
      if (!(k && index[k - 1] == p->right.at[j])) index[k++] = p->right.at[j];
    for (size_t j = p->left.count; j-- > 0;)
      if (!(k && index[k - 1] == p->left.at[j])) index[k++] = p->left.at[j];
  }
  while (k > 1 && index[k - 1] == index[0]) k--;
  for (size_t i = 0; ok && i < k; i++) { /* Triangulates the wall in the coordinates (position along the edge, d), in
                                          * which its slope does not appear. */
    vs_vec2 p = t->flat[index[i] - t->first];
    at[i] = (vs_vec2){ taper_dot(p, e->way), t->level[index[i] - t->first] };
  }
  ok = ok && (k < 3 || vs_triangulate(at, &k, 1, t->out, index, false));
  free(at);
  free(index);
  return ok;
}

static void taper_free(taper *t) {
  for (size_t i = 0; t->edges && i < t->count; i++) {
    free(t->edges[i].left.at);
    free(t->edges[i].right.at);
  }
  free(t->edges);
  free(t->events);
  free(t->flat);
  free(t->level);
}

/* Returns true if the corner of two edges with the directions a and b would move more than four times as fast as the
 * edges. The caller then cuts it off with an edge of length 0. */
static bool taper_is_sharp(const taper *t, vs_vec2 a, vs_vec2 b) {
  return t->sign * taper_cross(a, b) < 0 && 1 + taper_dot(a, b) < 0.125;
}

static void taper_add_edge(taper *t, vs_vec2 to, vs_vec2 way) {
  vs_vec2 normal = { -way.y, way.x };
  t->edges[t->count++] =
      (taper_edge){ .way = way, .normal = normal, .line = taper_dot(normal, to), .corner = to, .next_piece = SIZE_MAX };
}

/* Appends the edges of a loop of n points, and vertices at the bottom. below: receives these vertices. Returns false
 * when memory is out. */
static bool taper_loop(taper *t, const vs_vec2 *p, size_t n, uint32_t *below) {
  size_t first = t->count;
  for (size_t i = 0; i < n; i++) {
    vs_vec2 a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
    double l = hypot(b.x - a.x, b.y - a.y), m = hypot(c.x - b.x, c.y - b.y);
    vs_vec2 way = { (b.x - a.x) / l, (b.y - a.y) / l }, next = { (c.x - b.x) / m, (c.y - b.y) / m };
    taper_add_edge(t, b, way);
    if (!taper_is_sharp(t, way, next)) continue;
    vs_vec2 sum = { way.x + next.x, way.y + next.y };
    double s = hypot(sum.x, sum.y);
    if (s > 1e-6) sum = (vs_vec2){ sum.x / s, sum.y / s };
    else sum = t->sign > 0 ? (vs_vec2){ way.y, -way.x } : (vs_vec2){ -way.y, way.x }; /* at the tip of a slit, the
                                                                                       * additional edge of length 0 is
                                                                                       * perpendicular to the slit */
    taper_add_edge(t, b, sum);
  }
  size_t count = t->count - first;
  bool ok = true;
  for (size_t i = 0, shown = 0; ok && i < count; i++) {
    taper_edge *e = &t->edges[first + i];
    e->before = first + (i + count - 1) % count;
    e->after = first + (i + 1) % count;
    /* An edge of length 0 has the bottom vertex of the edge before it, instead of its own. */
    vs_vec2 q = e->corner, before = t->edges[e->before].corner;
    uint32_t v = 0;
    if (i && q.x == before.x && q.y == before.y) v = t->edges[e->before].right.at[0];
    else {
      ok = taper_vertex(t, q, 0, &v);
      below[shown++] = v; /* below begins with the vertex of p[1] and ends with the vertex of p[0] */
    }
    ok = ok && taper_push(&e->right, v);
  }
  for (size_t i = 0; ok && i < count; i++)
    ok = taper_push(&t->edges[first + i].left, t->edges[t->edges[first + i].before].right.at[0]);
  return ok;
}

/* A loop at the top of the extrusion: its points have the indices first to first + size - 1. */
typedef struct { size_t first, size; double area; } taper_ring;

static bool taper_ring_holds(const vs_vec2 *at, const taper_ring *r, vs_vec2 p) {
  bool inside = false;
  for (size_t i = 0; i < r->size; i++) {
    vs_vec2 a = at[r->first + i], b = at[r->first + (i + 1) % r->size];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/* Appends the triangles at the top of the extrusion. A hole belongs to the smallest outer loop that contains it.
 * Returns false when memory is out. */
static bool taper_top(taper *t) {
  size_t total = 0, rings = 0;
  for (size_t i = 0; i < t->count; i++) total += !t->edges[i].gone;
  vs_vec2 *at = vs_fresh(total + 1, sizeof *at), *loop = vs_fresh(total + 1, sizeof *loop);
  uint32_t *index = vs_fresh(total + 1, sizeof *index), *row = vs_fresh(total + 1, sizeof *row);
  size_t *sizes = vs_fresh(total + 1, sizeof *sizes), *holder = vs_fresh(total + 1, sizeof *holder), k = 0;
  taper_ring *ring = vs_fresh(total + 1, sizeof *ring);
  bool ok = at && loop && index && row && sizes && holder && ring;
  for (size_t i = 0; ok && i < t->count; i++) { /* each edge belongs to one loop, so an edge that is already in a loop
                                                 * is marked as gone */
    if (t->edges[i].gone) continue;
    taper_ring *r = &ring[rings++];
    *r = (taper_ring){ .first = k };
    for (size_t j = i; !t->edges[j].gone; j = t->edges[j].after, k++, r->size++) {
      t->edges[j].gone = true;
      index[k] = t->edges[j].right.at[t->edges[j].right.count - 1];
      at[k] = t->flat[index[k] - t->first];
    }
    for (size_t j = 1; j + 1 < r->size; j++) {
      vs_vec2 o = at[r->first], p = at[r->first + j], q = at[r->first + j + 1];
      r->area += taper_cross((vs_vec2){ p.x - o.x, p.y - o.y }, (vs_vec2){ q.x - o.x, q.y - o.y }) / 2;
    }
  }
  for (size_t h = 0; ok && h < rings; h++) {
    holder[h] = h;
    if (ring[h].area >= 0) continue;
    for (size_t o = 0; o < rings; o++)
      if (ring[o].area > 0 && taper_ring_holds(at, &ring[o], at[ring[h].first]) &&
          (holder[h] == h || ring[o].area < ring[holder[h]].area))
        holder[h] = o;
  }
  for (size_t o = 0; ok && o < rings; o++) {
    if (holder[o] != o) continue;
    size_t loops = 0, n = 0;
    for (size_t pass = 0; pass < 2; pass++)
      for (size_t h = 0; h < rings; h++) {
        if (pass ? h == o || holder[h] != o : h != o) continue;
        for (size_t j = 0; j < ring[h].size; j++, n++)
          loop[n] = at[ring[h].first + j], row[n] = index[ring[h].first + j];
        sizes[loops++] = ring[h].size;
      }
    ok = sizes[0] < 3 || vs_triangulate(loop, sizes, loops, t->out, row, false);
  }
  free(at);
  free(loop);
  free(index);
  free(row);
  free(sizes);
  free(holder);
  free(ring);
  return ok;
}

bool vs_taper_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  return n->child_count > 1 ? vs_taper_path_mesh(n, f, out, e)
                            : vs_taper_straight(n, VS_AS(extrude, n)->along, f, out, e);
}

bool vs_taper_straight(const vs_node *n, vs_vec3 way, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_extrude *x = VS_AS(extrude, n);
  vs_outline o;
  if (!vs_region_outline(n->children[0].node, f, &o, e)) return false;
  double height = fabs(vs_v3_dot(way, o.normal)), inwards = height * tan(x->taper);
  size_t points = 0, first_triangle = out->triangle_count;
  for (size_t l = 0; l < o.count; l++) points += o.loops[l].count;
  taper t = {
    .sign = x->taper < 0 ? -1 : 1, .end = fabs(inwards), .out = out, .first = (uint32_t)out->vertex_count, .rise = way
  };
  vs_affine frame = o.frame;
  const double along[3] = { way.x, way.y, way.z };
  for (int i = 0; x->center && n->child_count == 1 && i < 3; i++) frame.m[i][3] -= along[i] / 2;
  t.frame = &frame;
  t.room = 2 * points + 1;
  t.edges = vs_zeros(t.room, sizeof *t.edges);
  vs_vec2 *flat = vs_fresh(points + 1, sizeof *flat);
  uint32_t *below = vs_fresh(points + 1, sizeof *below);
  size_t *sizes = vs_fresh(o.count + 1, sizeof *sizes);
  bool ok = (t.edges && flat && below && sizes) || vs_error_memory(e, NULL);
  if (ok && o.count && !o.loops[0].closed)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "do-extrude: a taper needs a closed profile");
  vs_bounds b = vs_bounds_empty();
  for (size_t l = 0, k = 0; ok && l < o.count; l++) {
    sizes[l] = 0;
    for (size_t i = 0; i < o.loops[l].count; i++) {
      vs_vec3 p = o.loops[l].at[i], next = o.loops[l].at[(i + 1) % o.loops[l].count];
      if (vs_v3_equal(p, next)) continue;
      vs_bounds_add(&b, p);
      sizes[l]++;
      flat[k++] = (vs_vec2){ p.x * frame.m[0][0] + p.y * frame.m[1][0] + p.z * frame.m[2][0],
                             p.x * frame.m[0][1] + p.y * frame.m[1][1] + p.z * frame.m[2][1] };
    }
  }
  t.size = vs_bounds_diagonal(&b);
  for (size_t l = 0, from = 0; ok && l < o.count; from += sizes[l++])
    ok = taper_loop(&t, flat + from, sizes[l], below + from) || vs_error_memory(e, NULL);
  t.walls = t.count;
  ok = ok && (taper_run(&t) || vs_error_memory(e, NULL));
  for (size_t i = 0; ok && i < t.walls; i++) ok = taper_wall(&t, i) || vs_error_memory(e, NULL);
  /* Appends the triangles at the bottom: the profile as seen from below. In `below`, each loop begins with its second
   * point. */
  for (size_t l = 0, from = 0; ok && l < o.count;) {
    size_t end = l + 1, count = sizes[l];
    while (end < o.count && o.hole[end]) count += sizes[end++];
    for (size_t i = 0; i < count; i++) flat[from + i] = t.flat[below[from + i] - t.first];
    ok = vs_triangulate(flat + from, sizes + l, end - l, out, below + from, true) || vs_error_memory(e, NULL);
    from += count;
    l = end;
  }
  ok = ok && (taper_top(&t) || vs_error_memory(e, NULL));
  if (ok && vs_v3_dot(way, o.normal) < 0) vs_mesh_turn(out, first_triangle); /* the extrusion goes down, against the
                                                                              * profile's normal, so its triangles are
                                                                              * reversed */
  taper_free(&t);
  free(flat);
  free(below);
  free(sizes);
  vs_outline_free(&o);
  return ok;
}
