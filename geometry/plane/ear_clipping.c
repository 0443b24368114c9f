/* Triangulates planar polygons with holes by ear clipping.
 *
 * The ring is a doubly linked list of corners. A hole is inserted by a bridge from its leftmost corner to a visible
 * corner of the ring. The ring then contains the bridge in both directions. An ear is a convex corner whose triangle
 * contains no other corner, even on its border. Therefore a corner in the middle of a straight edge never lies on a
 * side of another triangle. After an ear the next corner is skipped. Thus a circle is halved repeatedly instead of
 * becoming a fan of slivers. If rounding or a loop that crosses itself leaves no ear, the most convex corner is cut.
 * The boundary is still correct, and the mesh closed.
 *
 * If a hole and the ring have a corner at the same point, they are joined there by a bridge of length 0. Otherwise the
 * ring would visit that point twice, and an ear there could not be distinguished from the removed part. Therefore holes
 * that touch are joined before those that need a bridge. The ends of a bridge of length 0 are cut at once, before they
 * hide the ring's direction there.
 *
 * Rings often have many thousand corners and holes: perforated sheets, maps, text. Only reflex corners can be inside a
 * possible ear, so a tree of points contains only these. If a corner's triangle contains a reflex corner, it waits for
 * that corner to be cut or to become convex. The corners that are still to be tested are a set of positions along the
 * ring. */
#include "geometry/plane/ear_clipping.h"

#include <stdlib.h>

#include "geometry/marks.h"
#include "geometry/plane/point_tree.h"
#include "model/store/array.h"

static const size_t none = SIZE_MAX;

typedef struct { uint32_t point, next, prev; } vs_corner;
typedef struct {
  size_t place;             /* index of this corner in the ring of the polygon's corners, before any corner is cut
                             * off */
  size_t awaited;           /* a reflex corner that lies within this corner's triangle, so that this corner is no ear
                             * until the other is cut off or becomes convex; `none` if there is no such corner */
  size_t waiting;           /* first corner in the list of corners that await this one (member `awaited`); `later` and
                             * `earlier` link the list */
  size_t later, earlier;
  bool gone, idle;          /* gone: true if this corner has been cut off; idle: true if it is in the ring's list
                             * `idle` */
} vs_ear;
typedef struct {
  const vs_vec2 *at;
  vs_corner *corners;
  vs_ear *ears; /* ears[c]: data of corner c beyond its position and neighbours */
  size_t count;
  size_t *by_place;  /* by_place[i]: corner at index i of the ring of the polygon's corners, before any corner is cut
                      * off */
  size_t *points;    /* points[c]: number of the point at which corner c lies */
  vs_point_tree tree; /* tree of the corners' points; only reflex corners that are not cut off are switched on, so that
                       * searches find only these */
  vs_marks open;     /* set of positions along the ring: the corners there may be ears (corners that can be cut off),
                      * and must still be tested */
  size_t *idle;      /* corners at the ends of bridges of length 0, which are cut off before all others */
  size_t idle_count;
  double flat; /* a triangle counts as empty if twice its area is below this value */
  double blur; /* distance from a corner below which a line counts as passing through it */
} vs_ring;

static vs_vec2 ring_at(const vs_ring *r, size_t c) { return r->at[r->corners[c].point]; }

static double ring_turn(const vs_ring *r, size_t a, size_t b, size_t c) {
  return vs_vec2_turn(ring_at(r, a), ring_at(r, b), ring_at(r, c));
}

/* ---- corners that wait for others ---- */

static void ring_wait(vs_ring *r, size_t c, size_t on) {
  vs_ear *k = &r->ears[c], *other = &r->ears[on];
  k->awaited = on;
  k->earlier = none;
  k->later = other->waiting;
  if (k->later != none) r->ears[k->later].earlier = c;
  other->waiting = c;
  vs_marks_set(&r->open, k->place, false);
}

static void ring_wait_no_more(vs_ring *r, size_t c) {
  vs_ear *k = &r->ears[c];
  if (k->awaited == none) return;
  if (k->later != none) r->ears[k->later].earlier = k->earlier;
  if (k->earlier != none) r->ears[k->earlier].later = k->later;
  else r->ears[k->awaited].waiting = k->later;
  k->awaited = none;
}

static void ring_release(vs_ring *r, size_t c) { /* after corner c has been cut off or become convex: marks all corners
                                                  * that await it (member `awaited`) as corners that may be ears */
  for (size_t w = r->ears[c].waiting; w != none; w = r->ears[c].waiting) {
    ring_wait_no_more(r, w);
    vs_marks_set(&r->open, r->ears[w].place, true);
  }
}

/* ---- ears ---- */

static bool same_place(vs_vec2 p, vs_vec2 q) { return p.x == q.x && p.y == q.y; }

/* Returns true if corner c is an end of a bridge of length 0, which joins two corners at one point. */
static bool ring_is_idle(const vs_ring *r, size_t c) {
  vs_vec2 p = ring_at(r, c);
  return same_place(p, ring_at(r, r->corners[c].prev)) || same_place(p, ring_at(r, r->corners[c].next));
}

static void ring_note_idle(vs_ring *r, size_t c) {
  if (r->ears[c].idle || !ring_is_idle(r, c)) return;
  r->ears[c].idle = true;
  r->idle[r->idle_count++] = c;
}

/* Returns a corner of the list `idle` that is not cut off yet, or `none`. */
static size_t ring_next_idle(vs_ring *r) {
  while (r->idle_count > 0) {
    size_t c = r->idle[--r->idle_count];
    r->ears[c].idle = false;
    if (!r->ears[c].gone && ring_is_idle(r, c)) return c;
  }
  return none;
}

static void ring_look(vs_ring *r, size_t c) { /* tests again whether corner c is reflex or may be an ear, after it or
                                               * one of its neighbours has changed */
  bool reflex = ring_turn(r, r->corners[c].prev, c, r->corners[c].next) <= r->flat;
  ring_wait_no_more(r, c);
  if (!reflex) ring_release(r, c);
  vs_point_tree_switch(&r->tree, c, reflex);
  vs_marks_set(&r->open, r->ears[c].place, !reflex);
  ring_note_idle(r, c);
}

/* returns true if corner b is an ear: it is convex, and no other corner lies in its triangle; if one does, b waits for
 * that corner */
static bool ring_is_ear(vs_ring *r, size_t b) {
  size_t inside = vs_point_tree_in(&r->tree, ring_at(r, r->corners[b].prev), ring_at(r, b),
                                   ring_at(r, r->corners[b].next), r->flat);
  if (inside != SIZE_MAX) ring_wait(r, b, inside);
  return inside == SIZE_MAX;
}

/* Returns the first ear (corner that can be cut off) along the ring after position `at`. Searches the whole ring;
 * returns `none` if it has no ear. */
static size_t ring_next_ear(vs_ring *r, size_t at) {
  size_t place = r->ears[at].place, end = none;
  for (int turn = 0; turn < 2; turn++, end = place) {
    for (size_t p = vs_marks_next(&r->open, turn ? 0 : place); p != SIZE_MAX && (turn == 0 || p < end);
         p = vs_marks_next(&r->open, p + 1))
      if (ring_is_ear(r, r->by_place[p])) return r->by_place[p];
  }
  return none;
}

static void ring_cut(vs_ring *r, size_t ear) {
  uint32_t prev = r->corners[ear].prev, next = r->corners[ear].next;
  ring_wait_no_more(r, ear);
  vs_point_tree_switch(&r->tree, ear, false);
  vs_marks_set(&r->open, r->ears[ear].place, false);
  r->ears[ear].gone = true;
  r->corners[prev].next = next;
  r->corners[next].prev = prev;
  ring_release(r, ear);
  ring_look(r, prev);
  ring_look(r, next);
}

/* ---- holes ---- */

/* A link in a list of edges of the ring. A binary tree divides the range of y into bands. An edge is in the lists of
 * the few tree nodes that together cover its height. edge: corner where the edge begins. */
typedef struct { uint32_t edge, next; } vs_band_link; /* next: index of the next link of the list, from 1 on; 0 marks
                                                       * the end */
typedef struct {
  double low, scale;    /* band number of a coordinate y: (y - low) * scale */
  size_t leaves;        /* number of bands, a power of two; in the binary tree, node 1 is the root, and node i has the
                         * children 2 i and 2 i + 1 */
  uint32_t *first;      /* first[i]: first link in the list of edges of node i */
  vs_band_link *links;
  size_t count, room;   /* number of links, including link 0, which is not used */
  vs_point_tree points; /* tree of the corners' points; only corners in the ring (the polygon with the holes joined so
                         * far) are switched on, so that searches find only these */
  uint32_t *copies;     /* copies[i]: index + 1 of the next corner at the position of corner i; 0 if there is none */
} vs_bands;

static bool bands_make(vs_bands *b, const vs_ring *r, size_t total, size_t most) {
  double low = INFINITY, high = -INFINITY;
  for (size_t i = 0; i < total; i++) low = fmin(low, r->at[i].y), high = fmax(high, r->at[i].y), r->points[i] = i;
  *b = (vs_bands){ .low = low, .leaves = 1, .count = 1 };
  while (b->leaves * 4 < total) b->leaves *= 2;
  b->scale = high > low ? (double)b->leaves / (high - low) : 0;
  b->first = vs_zeros(2 * b->leaves, sizeof *b->first);
  b->copies = vs_zeros(most, sizeof *b->copies);
  return b->first && b->copies && vs_point_tree_make(&b->points, r->at, r->points, total);
}

static void bands_free(vs_bands *b) {
  free(b->first);
  free(b->links);
  free(b->copies);
  vs_point_tree_free(&b->points);
}

static size_t band_of(const vs_bands *b, double y) {
  double band = (y - b->low) * b->scale;
  return band >= (double)b->leaves ? b->leaves - 1 : band > 0 ? (size_t)band : 0;
}

/* adds the edge of the ring that begins at corner c to the index of edges */
static bool bands_add(vs_bands *b, const vs_ring *r, size_t c) {
  double from = ring_at(r, c).y, to = ring_at(r, r->corners[c].next).y;
  if (!(from > to)) return true;
  for (size_t low = b->leaves + band_of(b, to), high = b->leaves + band_of(b, from) + 1; low < high;
       low /= 2, high /= 2) {
    size_t nodes[2] = { low % 2 ? low++ : 0, high % 2 ? --high : 0 };
    for (int i = 0; i < 2; i++) {
      if (!nodes[i]) continue;
      if (!VS_GROW(b->links, b->room, b->count + 1) || b->count > UINT32_MAX) return false;
      b->links[b->count] = (vs_band_link){ (uint32_t)c, b->first[nodes[i]] };
      b->first[nodes[i]] = (uint32_t)b->count++;
    }
  }
  return true;
}

static bool bands_add_loop(vs_bands *b, const vs_ring *r, size_t first, size_t size) {
  for (size_t c = first; c < first + size; c++) {
    vs_point_tree_switch(&b->points, c, true);
    if (!bands_add(b, r, c)) return false;
  }
  return true;
}

/* A search for a corner of the ring to which h, the leftmost corner of a hole, can be joined by a bridge. A ray from h
 * towards -x hits an edge at `hit`; m is an end of this edge. The corner lies in the triangle of these points. */
typedef struct {
  const vs_ring *ring;
  const uint32_t *copies;
  vs_vec2 h, m, hit;
  double least, slack; /* least: smallest slope, found so far, of a line from h to a candidate; slack: slopes that
                        * differ by less are equal */
  bool choosing;       /* true in the second pass: the least slope is known, and a candidate with this slope is
                        * chosen */
  size_t best;
} vs_sight;

/* Returns true if p lies within the triangle of s->h, s->hit and s->m, or nearly on its side from h to m. *slope: slope
 * of the line from h to p. */
static bool sight_has(const vs_sight *s, vs_vec2 p, double *slope) {
  double up = s->m.y < s->h.y ? s->h.y - p.y : p.y - s->h.y, side = vs_vec2_turn(s->m, s->hit, p);
  if (!(p.x < s->h.x && p.x >= s->m.x && up >= 0)) return false;
  *slope = up / (s->h.x - p.x);
  if (*slope > fabs(s->m.y - s->h.y) / (s->h.x - s->m.x) + s->slack) return false;
  return vs_vec2_turn(s->m, s->hit, s->h) < 0 ? side <= 0 : side >= 0;
}

/* Sets *before and *behind to the positions of the ring's neighbours of corner c. At a bridge of length 0, skips
 * corners at the position of c. */
static void ring_beside(const vs_ring *r, size_t c, vs_vec2 *before, vs_vec2 *behind) {
  size_t a = r->corners[c].prev, b = r->corners[c].next;
  while (a != c && same_place(ring_at(r, a), ring_at(r, c))) a = r->corners[a].prev;
  while (b != c && same_place(ring_at(r, b), ring_at(r, c))) b = r->corners[b].next;
  *before = ring_at(r, a);
  *behind = ring_at(r, b);
}

/* Returns true if the two edges at the corner leave the corner visible from the point h. */
static bool ring_sees(const vs_ring *r, size_t corner, vs_vec2 h) {
  vs_vec2 p = ring_at(r, corner), a, c;
  ring_beside(r, corner, &a, &c);
  /* to_after is above 0 if h is to the left of the edge that leaves the corner */
  double to_after = (c.x - p.x) * (h.y - p.y) - (c.y - p.y) * (h.x - p.x);
  double to_before = (p.x - a.x) * (h.y - a.y) - (p.y - a.y) * (h.x - a.x);
  bool convex = (p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x) > 0;
  return convex ? to_after >= 0 && to_before >= 0 : to_after >= 0 || to_before >= 0;
}

static void sight_look(void *context, size_t point) {
  vs_sight *s = context;
  const vs_ring *r = s->ring;
  vs_vec2 p = r->at[point];
  double slope;
  if (!sight_has(s, p, &slope) || slope > s->least + s->slack) return;
  for (size_t i = point;; i = s->copies[i] - 1) {
    if (ring_sees(r, i, s->h)) {
      double best_x = s->best == none ? -INFINITY : ring_at(r, s->best).x;
      if (!s->choosing) s->least = fmin(s->least, slope);
      else if (p.x > best_x || (p.x == best_x && i < s->best)) s->best = i;
    }
    if (!s->copies[i]) return;
  }
}

/* Chooses, among the ring's corners at the position of a hole's corner, the corner whose edges enclose the hole. Called
 * for each of these corners. s->h: next corner of the hole. */
static void touch_look(void *context, size_t point) {
  vs_sight *s = context;
  for (size_t i = point;; i = s->copies[i] - 1) {
    if (ring_sees(s->ring, i, s->h) && i < s->best) s->best = i;
    if (!s->copies[i]) return;
  }
}

/* Returns a corner of the ring (polygon with joined holes) at the position p that is visible from the point h, or
 * `none`. */
static size_t ring_seeing(const vs_ring *r, const vs_bands *b, vs_vec2 p, vs_vec2 h) {
  vs_sight s = { .ring = r, .copies = b->copies, .h = h, .best = none };
  vs_point_tree_each(&b->points, &(vs_point_box){ p.x, p.y, p.x, p.y, 0 }, touch_look, &s);
  return s.best;
}

/* Returns a corner of the ring (polygon with joined holes) at the position of `hole`, a corner of a hole, or `none`. */
static size_t ring_touch(const vs_ring *r, const vs_bands *b, size_t hole) {
  return ring_seeing(r, b, ring_at(r, hole), ring_at(r, r->corners[hole].next));
}

/* A ray from h towards -x. edge: corner where the first edge begins that the ray hits, of the edges tested so far, or
 * `none`; x: coordinate x of the hit. */
typedef struct { vs_vec2 h; size_t edge; double x; } vs_ray;

/* Tests the ray against all edges in the list of node `band` of the index of edges. */
static void band_meet(const vs_ring *r, const vs_bands *b, size_t band, vs_ray *ray) {
  vs_vec2 h = ray->h;
  double blur = r->blur;
  for (size_t node = b->leaves + band; node > 0; node /= 2) {
    for (size_t l = b->first[node]; l; l = b->links[l].next) {
      size_t i = b->links[l].edge;
      vs_vec2 p = ring_at(r, i), q = ring_at(r, r->corners[i].next);
      if (p.y < h.y - blur || q.y > h.y + blur) continue;
      double share = fmin(1, fmax(0, (h.y - p.y) / (q.y - p.y))), at = p.x + share * (q.x - p.x);
      if (p.y - q.y <= 2 * blur) at = fmax(p.x, q.x) <= h.x ? fmax(p.x, q.x) : fmin(p.x, q.x);
      if (at <= h.x && (at > ray->x || (at == ray->x && i < ray->edge))) ray->x = at, ray->edge = i;
    }
  }
}

static size_t ring_bridge(const vs_ring *r, const vs_bands *b, size_t start, size_t hole) {
  vs_vec2 h = ring_at(r, hole);
  vs_ray ray = { h, none, -INFINITY };
  double blur = r->blur;
  size_t last = none;
  for (int side = -1; side <= 1; side++) {
    size_t band = band_of(b, h.y + side * blur);
    if (band != last) band_meet(r, b, band, &ray);
    last = band;
  }
  size_t edge = ray.edge;
  if (edge == none) return start; /* The ray hits no edge, so the hole lies outside of its outer loop. With any bridge,
                                   * the triangles still have the right boundary. */
  size_t next = r->corners[edge].next;
  vs_vec2 p = ring_at(r, edge), q = ring_at(r, next);
  bool at_p = fabs(p.y - h.y) <= blur && p.x <= h.x, at_q = fabs(q.y - h.y) <= blur && q.x <= h.x;
  if (at_p || at_q) {
    size_t end = at_p && !(at_q && q.x > p.x) ? edge : next, seeing = ring_seeing(r, b, ring_at(r, end), h);
    return seeing == none ? end : seeing;
  }
  if (ray.x == h.x) return h.y == p.y ? edge : next;
  vs_sight s = { .ring = r, .copies = b->copies, .h = h, .hit = { ray.x, h.y }, .least = INFINITY, .best = none };
  size_t end = p.x < q.x ? edge : next;
  s.m = ring_at(r, end);
  s.slack = blur / (h.x - s.m.x);
  vs_point_box box = { s.m.x, fmin(s.m.y, h.y), h.x, fmax(s.m.y, h.y), 0 };
  box.min_y -= blur, box.max_y += blur;
  vs_point_tree_each(&b->points, &box, sight_look, &s);
  s.choosing = true;
  vs_point_tree_each(&b->points, &box, sight_look, &s);
  return s.best == none ? end : s.best;
}

/* Joins the hole with corner b to the ring at its corner a. The order of corners becomes: the corner before a, a copy
 * of a, b, around the hole, a copy of b, a, and the corner after a. a and b differ. */
static bool ring_splice(vs_ring *r, vs_bands *bands, size_t a, size_t b) {
  uint32_t a2 = (uint32_t)r->count++, b2 = (uint32_t)r->count++, before = r->corners[a].prev, last = r->corners[b].prev;
  VS_ASSERT(a != b);
  r->corners[a2] = (vs_corner){ r->corners[a].point, (uint32_t)b, before };
  r->corners[b2] = (vs_corner){ r->corners[b].point, (uint32_t)a, last };
  r->corners[before].next = a2;
  r->corners[last].next = b2;
  r->corners[a].prev = b2;
  r->corners[b].prev = a2;
  uint32_t pairs[2][2] = { { r->corners[a].point, a2 }, { r->corners[b].point, b2 } };
  for (int i = 0; i < 2; i++) {
    bands->copies[pairs[i][1]] = bands->copies[pairs[i][0]];
    bands->copies[pairs[i][0]] = pairs[i][1] + 1;
  }
  return bands_add(bands, r, a2) && bands_add(bands, r, b2);
}

typedef struct { size_t corner, first, size; vs_vec2 at; bool joined; } vs_hole;

static int hole_compare(const void *a, const void *b) {
  const vs_hole *p = a, *q = b;
  if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
  return p->at.y < q->at.y ? -1 : p->at.y > q->at.y;
}

/* The state of joining the holes to the ring (outer loop and joined holes). */
typedef struct {
  vs_ring *ring;
  vs_bands bands;
  vs_hole *holes;
  vs_point_tree outside; /* tree of the holes' points; only corners of holes that are not joined yet are switched on */
  uint32_t *hole_of;     /* hole_of[i]: number of the hole that contains point i */
  size_t *queue, queued; /* queue: joined holes around which a search for other holes that touch them is still to be
                          * made; queued: length of the queue */
  size_t start;          /* start: corner at which the ring (outer loop and joined holes) begins */
} vs_joining;

static bool join_at(vs_joining *j, size_t a, size_t b) { /* joins corner a of the ring to corner b of the hole */
  vs_ring *r = j->ring;
  vs_hole *hole = &j->holes[j->hole_of[b]];
  hole->joined = true;
  j->queue[j->queued++] = j->hole_of[b];
  for (size_t c = hole->first; c < hole->first + hole->size; c++) vs_point_tree_switch(&j->outside, c, false);
  if (!ring_splice(r, &j->bands, a, b) || !bands_add_loop(&j->bands, r, hole->first, hole->size)) return false;
  if (a == j->start) j->start = r->corners[b].prev; /* if a was the start of the ring, the start is now the copy of a,
                                                     * which precedes the hole */
  return true;
}

static void least_look(void *context, size_t point) {
  size_t *least = context;
  if (point < *least) *least = point;
}

/* Joins all holes that touch a corner of a loop in the ring. first, size: range of this loop's corners. */
static bool join_touching(vs_joining *j, size_t first, size_t size) {
  for (size_t c = first; c < first + size; c++) {
    vs_vec2 p = ring_at(j->ring, c);
    for (;;) {
      size_t found = none;
      vs_point_tree_each(&j->outside, &(vs_point_box){ p.x, p.y, p.x, p.y, 0 }, least_look, &found);
      if (found == none) break;
      size_t a = ring_touch(j->ring, &j->bands, found);
      if (!join_at(j, a == none ? c : a, found)) return false;
    }
  }
  return true;
}

/* Joins all holes to the ring. Begins with holes that touch the ring or a joined hole. Then joins the remaining holes
 * from left to right, each followed by the holes that touch it. */
static bool join_all(vs_joining *j, size_t count, size_t outer) {
  bool ok = bands_add_loop(&j->bands, j->ring, 0, outer);
  for (size_t i = 0; i < count; i++)
    for (size_t c = 0; c < j->holes[i].size; c++) {
      vs_point_tree_switch(&j->outside, j->holes[i].first + c, true);
      j->hole_of[j->holes[i].first + c] = (uint32_t)i;
    }
  ok = ok && join_touching(j, 0, outer);
  for (size_t i = 0, looked = 0; ok && i <= count; i++) {
    if (i > 0 && !j->holes[i - 1].joined) {
      size_t corner = j->holes[i - 1].corner;
      ok = join_at(j, ring_bridge(j->ring, &j->bands, j->start, corner), corner);
    }
    for (; ok && looked < j->queued; looked++) {
      const vs_hole *h = &j->holes[j->queue[looked]];
      ok = join_touching(j, h->first, h->size);
    }
  }
  return ok;
}

/* Joins all holes to the outer loop; *start becomes the corner with which the ring begins. */
static bool ring_join(vs_ring *r, vs_hole *holes, size_t count, size_t outer, size_t most, size_t *start) {
  vs_joining j = { .ring = r, .holes = holes };
  size_t points_room = 0, queue_room = 0;
  qsort(holes, count, sizeof *holes, hole_compare);
  bool ok = bands_make(&j.bands, r, r->count, most) && vs_point_tree_make(&j.outside, r->at, r->points, r->count) &&
      VS_GROW(j.hole_of, points_room, r->count) && VS_GROW(j.queue, queue_room, count) && join_all(&j, count, outer);
  *start = j.start;
  bands_free(&j.bands);
  vs_point_tree_free(&j.outside);
  free(j.hole_of);
  free(j.queue);
  return ok;
}

static bool ring_clip(vs_ring *r, size_t start, size_t left, vs_mesh *m, const uint32_t *index, bool turned) {
  for (size_t at = start; left >= 3; left--) {
    size_t ear = ring_next_idle(r);
    bool idle = ear != none;
    if (!idle) ear = ring_next_ear(r, at);
    if (ear == none) { /* no corner is an ear, so the corner with the largest area is cut off */
      double best = -INFINITY;
      size_t i = at;
      do {
        double turn = ring_turn(r, r->corners[i].prev, i, r->corners[i].next);
        if (turn > best) {
          best = turn;
          ear = i;
        }
        i = r->corners[i].next;
      } while (i != at);
      if (ear == none) ear = at; /* no area is greater than another because coordinates are NaN, so any corner is cut
                                  * off */
    }
    size_t prev = r->corners[ear].prev, next = r->corners[ear].next;
    uint32_t a = index[r->corners[prev].point], b = index[r->corners[ear].point], c = index[r->corners[next].point];
    if (a != b && b != c && c != a && !vs_mesh_add_triangle(m, a, turned ? c : b, turned ? b : c)) return false;
    ring_cut(r, ear);
    if (!idle) at = r->corners[next].next;
    else if (at == ear) at = next;
  }
  return true;
}

/* Sets each corner's index along the ring, and the set of corners that are to be tested for being ears. Returns false
 * when memory is out. */
static bool ring_begin(vs_ring *r, size_t start, size_t total, size_t size) {
  /* Corners of loops with fewer than three corners are not part of the ring, so they have no position in it. */
  for (size_t i = 0; i < r->count; i++) r->points[i] = i < total ? i : r->corners[i].point;
  if (!vs_point_tree_make(&r->tree, r->at, r->points, r->count) || !vs_marks_make(&r->open, size)) return false;
  size_t c = start;
  for (size_t place = 0; place < size; place++, c = r->corners[c].next) {
    r->ears[c].place = place;
    r->ears[c].gone = r->ears[c].idle = false;
    r->ears[c].awaited = r->ears[c].waiting = none;
    r->by_place[place] = c;
  }
  for (size_t place = 0; place < size; place++) ring_look(r, r->by_place[place]);
  return true;
}

bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index,
                    bool turned) {
  size_t total = 0;
  double extent = 0;
  for (size_t l = 0; l < loop_count; l++) total += sizes[l];
  for (size_t i = 1; i < total; i++) extent = fmax(extent, fmax(fabs(at[i].x - at[0].x), fabs(at[i].y - at[0].y)));
  if (loop_count == 0 || sizes[0] < 3) return true;
  size_t most = total + 2 * loop_count;
  if (most > UINT32_MAX) return false; /* a mesh cannot have more vertices than fit into 32 bits */
  vs_ring r = { .at = at, .flat = 1e-14 * extent * extent, .blur = 1e-12 * extent };
  r.corners = vs_fresh(most, sizeof *r.corners);
  r.ears = vs_fresh(most, sizeof *r.ears);
  r.by_place = vs_fresh(3 * most, sizeof *r.by_place);
  r.points = r.by_place + (r.by_place ? most : 0);
  r.idle = r.by_place + (r.by_place ? 2 * most : 0);
  vs_hole *holes = vs_fresh(loop_count, sizeof *holes);
  bool ok = r.corners && r.ears && r.by_place && holes;
  size_t hole_count = 0, ring_size = sizes[0];
  for (size_t l = 0, first = 0; ok && l < loop_count; first += sizes[l], l++) {
    size_t n = sizes[l], leftmost = first;
    if (l && n < 3) continue;
    for (size_t i = 0; i < n; i++) {
      r.corners[first + i] =
          (vs_corner){ (uint32_t)(first + i), (uint32_t)(first + (i + 1) % n), (uint32_t)(first + (i + n - 1) % n) };
      if (at[first + i].x < at[leftmost].x || (at[first + i].x == at[leftmost].x && at[first + i].y < at[leftmost].y))
        leftmost = first + i;
    }
    if (l) holes[hole_count++] = (vs_hole){ leftmost, first, n, at[leftmost], false };
    if (l) ring_size += n + 2;
  }
  r.count = total;
  if (ok) {
    size_t start = 0;
    ok = hole_count == 0 || ring_join(&r, holes, hole_count, sizes[0], most, &start);
    ok = ok && ring_begin(&r, start, total, ring_size) && ring_clip(&r, start, ring_size, m, index, turned);
  }
  vs_point_tree_free(&r.tree);
  vs_marks_free(&r.open);
  free(holes);
  free(r.by_place);
  free(r.ears);
  free(r.corners);
  return ok;
}
