/* Implements shortest ways and views in plans (plan_ways.h).
 *
 * A shortest way turns only at corners that jut into a room. Dijkstra's method walks from the exits over places
 * (corners, doors, exits) that see each other. Whether two places see each other is tested only if that could shorten a
 * way. */
#include "geometry/nets/plan_ways.h"

#include <math.h>
#include <string.h>

#include "model/store/array.h"

#define BLUR 1e-9 /* distances below this fraction of the plan's size count as 0 */
#define ASIDE 1e-7 /* angle, in radians, by which a line of sight to a corner is turned so that it passes beside the
                    * corner */

static vs_vec2 minus(vs_vec2 a, vs_vec2 b) { return (vs_vec2){ a.x - b.x, a.y - b.y }; }
static vs_vec2 between(vs_vec2 a, vs_vec2 b, double t) {
  return (vs_vec2){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
}
static double cross(vs_vec2 a, vs_vec2 b) { return a.x * b.y - a.y * b.x; }
static double dot(vs_vec2 a, vs_vec2 b) { return a.x * b.x + a.y * b.y; }
static double length(vs_vec2 a) { return hypot(a.x, a.y); }

static double blur(const vs_plan *p) {
  double most = 0;
  for (size_t i = 0; i < p->count; i++) most = fmax(most, fmax(fabs(p->at[i].x), fabs(p->at[i].y)));
  return BLUR * (most > 0 ? most : 1);
}

/* ---- edges ---- */

/* An iteration over the edges of a room's walls and obstacles. */
typedef struct { const vs_plan *p; size_t room, loop, first, i; } edges;

static edges edges_of(const vs_plan *p, size_t room) { return (edges){ .p = p, .room = room }; }

/* Sets *a and *b to the ends of the next edge; returns false after the last one. */
static bool next_edge(edges *e, vs_vec2 *a, vs_vec2 *b) {
  const vs_plan *p = e->p;
  while (e->loop < p->loops && (p->room[e->loop] != e->room || e->i == p->size[e->loop])) {
    e->first += p->size[e->loop++];
    e->i = 0;
  }
  if (e->loop == p->loops) return false;
  VS_ASSERT(e->first + e->i < p->count);
  *a = p->at[e->first + e->i];
  e->i++;
  *b = p->at[e->first + e->i % p->size[e->loop]];
  return true;
}

static double distance_to_edge(vs_vec2 q, vs_vec2 a, vs_vec2 b) {
  vs_vec2 along = minus(b, a);
  double size = dot(along, along), t = size > 0 ? dot(minus(q, a), along) / size : 0;
  return length(minus(q, between(a, b, fmin(1, fmax(0, t)))));
}

/* Returns true if the point q is inside the room, or on its border and `border` is true. */
static bool in_room(const vs_plan *p, size_t room, vs_vec2 q, bool border, double eps) {
  bool inside = false;
  vs_vec2 a, b;
  for (edges e = edges_of(p, room); next_edge(&e, &a, &b);) {
    if (distance_to_edge(q, a, b) <= eps) return border;
    if ((a.y > q.y) != (b.y > q.y) && q.x < a.x + (q.y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

bool vs_plan_contains(const vs_plan *p, vs_vec2 at) {
  double eps = blur(p);
  for (size_t r = 0; r < p->rooms; r++)
    if (in_room(p, r, at, true, eps)) return true;
  return false;
}

/* ---- lines of sight ---- */

/* Intervals of a line of sight in which it touches the room's walls. */
typedef struct { double *at; size_t count, room; } touches;

static bool touch(touches *t, double at) {
  if (!(at > 0 && at < 1)) return true;
  if (!VS_GROW(t->at, t->room, t->count + 1)) return false;
  t->at[t->count++] = at;
  return true;
}

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

typedef enum { SEEN, HIDDEN, NO_MEMORY } sight;

/* Adds to t the interval in which the edge from a to b touches the segment that begins at p with the vector d. Returns
 * HIDDEN if the edge crosses the segment. */
static sight meet_edge(vs_vec2 p, vs_vec2 d, vs_vec2 a, vs_vec2 b, double eps, touches *t) {
  vs_vec2 e = minus(b, a), w = minus(a, p);
  double long_d = length(d), long_e = length(e), across = cross(d, e);
  if (long_e <= 0) return SEEN;
  if (fabs(across) <= BLUR * long_d * long_e) {
    if (fabs(cross(w, d)) > eps * long_d) return SEEN;
    double size = long_d * long_d;
    return touch(t, dot(w, d) / size) && touch(t, dot(minus(b, p), d) / size) ? SEEN : NO_MEMORY;
  }
  double at = cross(w, e) / across, on = cross(w, d) / across;
  double near_d = eps / long_d, near_e = eps / long_e;
  if (on < -near_e || on > 1 + near_e || at < -near_d || at > 1 + near_d) return SEEN;
  if (on > near_e && on < 1 - near_e && at > near_d && at < 1 - near_d) return HIDDEN;
  return touch(t, at) ? SEEN : NO_MEMORY;
}

/* Returns SEEN if the whole segment from p to q lies in the room (it may touch the walls), else HIDDEN; NO_MEMORY when
 * memory is out. */
static sight sees_in(const vs_plan *plan, size_t room, vs_vec2 p, vs_vec2 q, double eps, touches *t) {
  vs_vec2 d = minus(q, p), a, b;
  if (length(d) <= eps) return in_room(plan, room, p, true, eps) ? SEEN : HIDDEN;
  t->count = 0;
  for (edges e = edges_of(plan, room); next_edge(&e, &a, &b);) {
    sight s = meet_edge(p, d, a, b, eps, t);
    if (s != SEEN) return s;
  }
  if (t->count) qsort(t->at, t->count, sizeof *t->at, by_size);
  double from = 0;
  for (size_t i = 0; i <= t->count; i++) {
    double to = i < t->count ? t->at[i] : 1;
    bool counts = (to - from) * length(d) > 2 * eps;
    if (counts && !in_room(plan, room, between(p, q, (from + to) / 2), true, eps)) return HIDDEN;
    from = to;
  }
  return SEEN;
}

static sight sees(const vs_plan *plan, vs_vec2 p, vs_vec2 q, double eps, touches *t) {
  for (size_t r = 0; r < plan->rooms; r++) {
    sight s = sees_in(plan, r, p, q, eps, t);
    if (s != HIDDEN) return s;
  }
  return HIDDEN;
}

/* ---- ways ---- */

/* Returns true if the corner c between a and b juts into the room: a short chord there leaves the room. */
static bool juts(const vs_plan *p, size_t room, vs_vec2 a, vs_vec2 c, vs_vec2 b, double eps) {
  vs_vec2 u = minus(a, c), v = minus(b, c);
  double lu = length(u), lv = length(v), step = 1e-3 * fmin(lu, lv);
  if (lu <= eps || lv <= eps || fabs(cross(u, v)) <= 1e-9 * lu * lv) return false;
  vs_vec2 middle = { c.x + step / 2 * (u.x / lu + v.x / lv), c.y + step / 2 * (u.y / lu + v.y / lv) };
  return !in_room(p, room, middle, true, 0);
}

static bool add_place(vs_plan_place **out, size_t *count, size_t *room, vs_vec2 at, double far) {
  if (!VS_GROW(*out, *room, *count + 1)) return false;
  (*out)[(*count)++] = (vs_plan_place){ at, far, VS_NO_PLACE };
  return true;
}

static bool add_corners(const vs_plan *p, double eps, vs_plan_place **out, size_t *count, size_t *room) {
  size_t first = 0;
  for (size_t l = 0; l < p->loops; first += p->size[l++])
    for (size_t i = 0, n = p->size[l]; i < n; i++) {
      vs_vec2 c = p->at[first + i];
      if (juts(p, p->room[l], p->at[first + (i + n - 1) % n], c, p->at[first + (i + 1) % n], eps) &&
          !add_place(out, count, room, c, INFINITY))
        return false;
    }
  return true;
}

/* Finds the shortest ways from all places (corners, doors, exits) to the exits, by Dijkstra's method. */
static vs_plan_outcome walk(const vs_plan *p, vs_plan_place *places, size_t count, vs_long_work work) {
  double eps = blur(p);
  touches t = { 0 };
  bool *done = vs_zeros(count, sizeof *done);
  vs_plan_outcome outcome = done ? VS_PLAN_DONE : VS_PLAN_MEMORY;
  for (size_t turn = 0; outcome == VS_PLAN_DONE && turn < count; turn++) {
    size_t k = count;
    for (size_t i = 0; i < count; i++)
      if (!done[i] && places[i].far < INFINITY && (k == count || places[i].far < places[k].far)) k = i;
    if (k == count) break;
    done[k] = true;
    if (work.going && !work.going(work.context, (double)turn / (double)count)) outcome = VS_PLAN_STOPPED;
    for (size_t i = 0; outcome == VS_PLAN_DONE && i < count; i++) {
      double far = places[k].far + length(minus(places[i].at, places[k].at));
      if (done[i] || far >= places[i].far) continue;
      sight s = sees(p, places[k].at, places[i].at, eps, &t);
      if (s == NO_MEMORY) outcome = VS_PLAN_MEMORY;
      if (s == SEEN) places[i].far = far, places[i].next = (uint32_t)k;
    }
  }
  free(t.at), free(done);
  return outcome;
}

vs_plan_outcome vs_plan_ways(const vs_plan *p, const vs_vec2 *exits, size_t exit_count, const vs_vec2 *doors,
                             size_t door_count, vs_long_work work, vs_plan_place **out, size_t *count) {
  size_t room = 0;
  bool ok = true;
  *out = NULL, *count = 0;
  for (size_t i = 0; ok && i < exit_count; i++) ok = add_place(out, count, &room, exits[i], 0);
  for (size_t i = 0; ok && i < door_count; i++) ok = add_place(out, count, &room, doors[i], INFINITY);
  ok = ok && add_corners(p, blur(p), out, count, &room) && *count < VS_NO_PLACE;
  return ok ? walk(p, *out, *count, work) : VS_PLAN_MEMORY;
}

bool vs_plan_way(const vs_plan *p, const vs_plan_place *places, size_t count, vs_vec2 from, double *far,
                 uint32_t *first) {
  double eps = blur(p);
  touches t = { 0 };
  sight s = HIDDEN;
  *far = INFINITY, *first = VS_NO_PLACE;
  for (size_t i = 0; s != NO_MEMORY && i < count; i++) {
    double all = places[i].far + length(minus(places[i].at, from));
    if (!(all < *far)) continue;
    s = sees(p, from, places[i].at, eps, &t);
    if (s == SEEN) *far = all, *first = (uint32_t)i;
  }
  free(t.at);
  return s != NO_MEMORY;
}

/* ---- views ---- */

/* Finds the first wall of the room that a ray from p in the direction d hits; returns false if there is none. *q: the
 * point where a ray in the direction `exact` meets the line of this wall. */
static bool reach(const vs_plan *plan, size_t room, vs_vec2 p, vs_vec2 d, vs_vec2 exact, double eps, vs_vec2 *q) {
  double most = INFINITY;
  vs_vec2 a, b;
  for (edges e = edges_of(plan, room); next_edge(&e, &a, &b);) {
    vs_vec2 along = minus(b, a), w = minus(a, p);
    double across = cross(d, along);
    if (across == 0) continue;
    double at = cross(w, along) / across, on = cross(w, d) / across;
    if (!(on >= 0 && on <= 1 && at > eps && at < most)) continue;
    double turned = cross(exact, along), far = turned == 0 ? at : cross(w, along) / turned;
    *q = (vs_vec2){ p.x + far * exact.x, p.y + far * exact.y };
    most = at;
  }
  return most < INFINITY;
}

/* Returns the corner of the room within the distance `near` of q; returns q itself if there is none. */
static vs_vec2 nearly_corner(const vs_plan *plan, size_t room, vs_vec2 q, double near) {
  vs_vec2 a, b;
  for (edges e = edges_of(plan, room); next_edge(&e, &a, &b);)
    if (length(minus(q, a)) <= near) return a;
  return q;
}

bool vs_plan_view(const vs_plan *p, vs_vec2 from, vs_vec2 **out, size_t *count) {
  double eps = blur(p), *angles; /* angles: directions from the viewpoint to the corners of the room, in radians */
  size_t room = 0, corners = 0;
  *out = NULL, *count = 0;
  while (room < p->rooms && !in_room(p, room, from, false, eps)) room++;
  if (room == p->rooms) return true;
  if (!VS_FRESH(angles, p->count) || !VS_FRESH(*out, 2 * p->count)) return free(angles), false;
  vs_vec2 a, b, q;
  for (edges e = edges_of(p, room); next_edge(&e, &a, &b);) angles[corners++] = atan2(a.y - from.y, a.x - from.x);
  VS_ASSERT(corners <= p->count);
  qsort(angles, corners, sizeof *angles, by_size);
  for (size_t i = 0; i < 2 * corners; i++) {
    double angle = angles[i / 2], aside = angle + (i % 2 ? ASIDE : -ASIDE);
    vs_vec2 exact = { cos(angle), sin(angle) }, d = { cos(aside), sin(aside) };
    if (!reach(p, room, from, d, exact, eps, &q)) continue;
    q = nearly_corner(p, room, q, 2 * eps);
    if (!*count || length(minus(q, (*out)[*count - 1])) > eps) (*out)[(*count)++] = q;
  }
  if (*count > 1 && length(minus((*out)[0], (*out)[*count - 1])) <= eps) (*count)--;
  free(angles);
  return true;
}
