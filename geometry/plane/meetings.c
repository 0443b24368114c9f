/* Finds the points where two curves intersect or touch (meetings.h).
 *
 * Bounding boxes contain spans (pieces between samples) of both curves, and larger boxes contain several boxes. If two
 * boxes are close to each other, their spans are compared in pairs. Newton's method starts from the nearest points of
 * the two spans' chords, and moves along the curves to where they are nearest to each other. */
#include "geometry/plane/meetings.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

enum { GROUP = 16, STEPS = 40 };

static size_t spans(const vs_stations *s) { return s->path.count - (s->path.closed ? 0 : 1); }
static vs_vec3 end_of(const vs_stations *s, size_t i) { return s->path.at[i < s->path.count ? i : 0].at; }

/* Returns the bounding box of the curve's spans from first to last - 1. It is enlarged by the largest distance of an
 * arc from its chord. first <= last. */
static vs_bounds box_of(const vs_stations *s, size_t first, size_t last) {
  vs_bounds b = vs_bounds_empty();
  double arcs = 0;
  VS_ASSERT(first <= last);
  for (size_t i = first; i <= last; i++) vs_bounds_add(&b, end_of(s, i));
  for (size_t i = first; i < last; i++) {
    double chord = vs_v3_length(vs_v3_sub(end_of(s, i + 1), end_of(s, i))), arc = s->along[i + 1] - s->along[i];
    arcs = fmax(arcs, sqrt(fmax(0, arc * arc - chord * chord)));
  }
  b.min = vs_v3_sub(b.min, vs_v3(arcs, arcs, arcs)), b.max = vs_v3_add(b.max, vs_v3(arcs, arcs, arcs));
  return b;
}

static bool boxes_near(const vs_bounds *a, const vs_bounds *b, double near) {
  return a->min.x <= b->max.x + near && b->min.x <= a->max.x + near && a->min.y <= b->max.y + near &&
         b->min.y <= a->max.y + near && a->min.z <= b->max.z + near && b->min.z <= a->max.z + near;
}

static double held(double x, double high) { return x < 0 ? 0 : x > high ? high : x; }

/* Returns the arc length s, brought into the curve's range: modulo its length if the curve is closed, else limited to 0
 * and its length. */
static double along(const vs_stations *c, double s) {
  return c->path.closed ? s - c->length * floor(s / c->length) : held(s, c->length);
}

/* Moves the arc lengths s and t to where the curves a and b are nearest to each other, by Newton's method. Returns the
 * distance of these two points. */
static double nearest(const vs_stations *a, const vs_stations *b, double *s, double *t, double most) {
  double best = INFINITY;
  for (int i = 0; i < STEPS; i++) {
    vs_station p = vs_station_at(a, *s), q = vs_station_at(b, *t);
    vs_vec3 d = vs_v3_sub(q.at, p.at);
    best = vs_v3_length(d);
    double c = vs_v3_dot(p.tangent, q.tangent), x = vs_v3_dot(d, p.tangent), y = vs_v3_dot(d, q.tangent);
    double det = 1 - c * c, ds, dt;
    if (det > 1e-12)
      ds = (x - c * y) / det, dt = (c * x - y) / det;
    else
      ds = x / 2, dt = -y / 2;
    double s1 = along(a, *s + fmax(-most, fmin(most, ds))), t1 = along(b, *t + fmax(-most, fmin(most, dt)));
    bool still = fabs(s1 - *s) <= 1e-14 * a->length && fabs(t1 - *t) <= 1e-14 * b->length;
    *s = s1, *t = t1;
    if (still) break;
  }
  vs_station p = vs_station_at(a, *s), q = vs_station_at(b, *t);
  return fmin(best, vs_v3_length(vs_v3_sub(q.at, p.at)));
}

static int by_s(const void *p, const void *q) {
  const vs_meeting *a = p, *b = q;
  return a->s < b->s ? -1 : a->s > b->s;
}

static bool same_place(const vs_stations *c, double a, double b, double near) {
  double d = fabs(a - b);
  return d <= near || (c->path.closed && c->length - d <= near);
}

/* Sets s and t to the nearest points of the chords p-q and r-w, as fractions of the chords' lengths. */
static void chords(vs_vec3 p, vs_vec3 q, vs_vec3 r, vs_vec3 w, double *s, double *t) {
  vs_vec3 u = vs_v3_sub(q, p), v = vs_v3_sub(w, r), d = vs_v3_sub(r, p);
  double uu = vs_v3_dot(u, u), vv = vs_v3_dot(v, v), uv = vs_v3_dot(u, v), du = vs_v3_dot(d, u), dv = vs_v3_dot(d, v);
  double det = uu * vv - uv * uv;
  *s = det > 1e-12 * uu * vv ? held((du * vv - dv * uv) / det, 1) : .5;
  *t = vv > 0 ? held((*s * uv - dv) / vv, 1) : 0;
  *s = uu > 0 ? held((*t * uv + du) / uu, 1) : 0;
}

typedef struct {
  const vs_stations *a, *b;
  double near;
  vs_meeting *found;
  size_t count, room;
  vs_vec3 at;
} search;

static vs_meetings_outcome pair(search *w, size_t i, size_t j) {
  double x, y, span = fmax(w->a->along[i + 1] - w->a->along[i], w->b->along[j + 1] - w->b->along[j]);
  vs_bounds p = box_of(w->a, i, i + 1), q = box_of(w->b, j, j + 1);
  if (!boxes_near(&p, &q, w->near)) return VS_MEETINGS_DONE;
  chords(end_of(w->a, i), end_of(w->a, i + 1), end_of(w->b, j), end_of(w->b, j + 1), &x, &y);
  double s = w->a->along[i] + x * (w->a->along[i + 1] - w->a->along[i]);
  double t = w->b->along[j] + y * (w->b->along[j + 1] - w->b->along[j]);
  double s0 = s, t0 = t;
  if (nearest(w->a, w->b, &s, &t, 2 * span) > w->near) return VS_MEETINGS_DONE;
  /* The nearest points are far from these two spans, so they are found from another pair of spans. */
  if (!same_place(w->a, s, s0, 3 * span) || !same_place(w->b, t, t0, 3 * span)) return VS_MEETINGS_DONE;
  double blur = fmax(w->near, 1e-7 * fmax(w->a->length, w->b->length));
  for (size_t k = 0; k < w->count; k++)
    if (same_place(w->a, w->found[k].s, s, blur) && same_place(w->b, w->found[k].t, t, blur)) return VS_MEETINGS_DONE;
  vs_station here = vs_station_at(w->a, s), there = vs_station_at(w->b, t);
  w->at = here.at;
  if (fabs(vs_v3_dot(here.tangent, there.tangent)) > 1 - 1e-9) { /* if the tangents are parallel, the curves touch, or
                                                                  * coincide along a part */
    double step = .3 * fmin(w->a->along[i + 1] - w->a->along[i], w->b->along[j + 1] - w->b->along[j]);
    int on = 0;
    for (int side = -1; side <= 1; side += 2) {
      double s2 = along(w->a, s + side * step),
             t2 = along(w->b, t + side * step * vs_v3_dot(here.tangent, there.tangent));
      if (same_place(w->a, s2, s, step / 2)) continue;
      vs_vec3 far = vs_station_at(w->a, s2).at;
      double moved = t2;
      for (int turn = 0; turn < STEPS; turn++) {
        vs_station beside = vs_station_at(w->b, moved);
        moved = along(w->b, moved + vs_v3_dot(vs_v3_sub(far, beside.at), beside.tangent));
      }
      if (vs_v3_length(vs_v3_sub(vs_station_at(w->b, moved).at, far)) <= w->near) on++;
    }
    if (on) return VS_MEETINGS_ALONG;
  }
  if (!VS_GROW(w->found, w->room, w->count + 1)) return VS_MEETINGS_MEMORY;
  w->found[w->count++] = (vs_meeting){ vs_v3_scale(vs_v3_add(here.at, there.at), .5), s, t };
  return VS_MEETINGS_DONE;
}

vs_meetings_outcome vs_curves_meet(const vs_stations *a, const vs_stations *b, double near, vs_meeting **out,
                                   size_t *count, vs_vec3 *at) {
  search w = { .a = a, .b = b, .near = near };
  size_t n = spans(a), m = spans(b), groups = (m + GROUP - 1) / GROUP, room = 0;
  vs_bounds *box = NULL;
  vs_meetings_outcome outcome = VS_GROW(box, room, groups + 1) ? VS_MEETINGS_DONE : VS_MEETINGS_MEMORY;
  VS_ASSERT(near >= 0);
  for (size_t g = 0; outcome == VS_MEETINGS_DONE && g < groups; g++)
    box[g] = box_of(b, g * GROUP, (g + 1) * GROUP < m ? (g + 1) * GROUP : m);
  for (size_t i = 0; outcome == VS_MEETINGS_DONE && i < n; i += GROUP) {
    size_t last = i + GROUP < n ? i + GROUP : n;
    vs_bounds here = box_of(a, i, last);
    for (size_t g = 0; outcome == VS_MEETINGS_DONE && g < groups; g++) {
      if (!boxes_near(&here, &box[g], near)) continue;
      for (size_t k = i; outcome == VS_MEETINGS_DONE && k < last; k++)
        for (size_t j = g * GROUP; outcome == VS_MEETINGS_DONE && j < m && j < (g + 1) * GROUP; j++)
          outcome = pair(&w, k, j);
    }
  }
  free(box);
  *at = w.at;
  if (outcome != VS_MEETINGS_DONE) return free(w.found), outcome;
  if (w.count) qsort(w.found, w.count, sizeof *w.found, by_s);
  *out = w.found, *count = w.count;
  return VS_MEETINGS_DONE;
}
