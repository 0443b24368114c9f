/* Computes the part of an area's border that lies within another area. If the areas are two successive slices of a
 * solid, it is the visible outline of the higher slice. */
#include "geometry/plane/inner_lines.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

void vs_inner_lines_free(vs_inner_lines *l) {
  free(l->at);
  free(l->lines);
  *l = (vs_inner_lines){ 0 };
}

/* Returns the position of the point nearest to r on the segment from p to q, as a fraction of the segment's length.
 * *distance: distance of this point from r. */
static double nearest(vs_vec2 p, vs_vec2 q, vs_vec2 r, double *distance) {
  double x = q.x - p.x, y = q.y - p.y, square = x * x + y * y;
  double t = square > 0 ? fmin(1, fmax(0, ((r.x - p.x) * x + (r.y - p.y) * y) / square)) : 0;
  *distance = hypot(p.x + t * x - r.x, p.y + t * y - r.y);
  return t;
}

static bool on_border(const vs_area *a, vs_vec2 p, double slack) {
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      double distance;
      nearest(a->at[first + i], a->at[first + (i + 1) % a->size[l]], p, &distance);
      if (distance <= slack) return true;
    }
  return false;
}

typedef struct {
  double *at; /* positions along the current edge, as fractions of its length: 0, 1, and those of corners of the other
               * area on the edge */
  size_t count, room;
} cuts;

static int by_size(const void *p, const void *q) {
  const double *a = p, *b = q;
  return (*a > *b) - (*a < *b);
}

static bool find_cuts(const vs_area *a, vs_vec2 p, vs_vec2 q, double slack, cuts *c) {
  c->count = 0;
  for (size_t i = 0; i <= a->count + 1; i++) {
    double distance = 0, t = i < a->count ? nearest(p, q, a->at[i], &distance) : (double)(i - a->count);
    if (distance > slack) continue;
    if (!VS_GROW(c->at, c->room, c->count + 1)) return false;
    c->at[c->count++] = t;
  }
  qsort(c->at, c->count, sizeof *c->at, by_size);
  return true;
}

/* The state of tracing a line, which is a part of the border of one area within another area. The line begins at point
 * number `first` of the output. */
typedef struct {
  vs_inner_lines *out;
  size_t first;
} tracer;

static bool add(tracer *t, vs_vec2 p) {
  vs_inner_lines *o = t->out;
  if (!VS_GROW(o->at, o->room, o->count + 1)) return false;
  o->at[o->count++] = p;
  return true;
}

static bool end(tracer *t, bool closed) {
  vs_inner_lines *o = t->out;
  size_t n = o->count - t->first;
  if (n < 2) o->count = t->first;
  else {
    if (!VS_GROW(o->lines, o->line_room, o->line_count + 1)) return false;
    o->lines[o->line_count].size = n, o->lines[o->line_count++].closed = closed;
  }
  t->first = o->count;
  return true;
}

/* Traces the parts of a loop that lie within area a. If an edge lies on the border of a, starts there, so that no line
 * continues across the loop's start. */
static bool trace(const vs_area *a, const vs_vec2 *loop, size_t n, double slack, tracer *t) {
  size_t start = 0;
  cuts c = { 0 };
  bool ok = true, broken = false;
  for (size_t i = 0; i < n && !broken; i++) {
    vs_vec2 p = loop[i], q = loop[(i + 1) % n];
    broken = on_border(a, (vs_vec2){ (p.x + q.x) / 2, (p.y + q.y) / 2 }, slack);
    if (broken) start = i;
  }
  for (size_t k = 0; ok && k < n; k++) {
    vs_vec2 p = loop[(start + k) % n], q = loop[(start + k + 1) % n];
    ok = find_cuts(a, p, q, slack, &c);
    for (size_t i = 0; ok && i + 1 < c.count; i++) {
      double low = c.at[i], high = c.at[i + 1], middle = (low + high) / 2;
      if (high - low < 1e-12) continue;
      vs_vec2 from = { p.x + low * (q.x - p.x), p.y + low * (q.y - p.y) },
              to = { p.x + high * (q.x - p.x), p.y + high * (q.y - p.y) };
      if (on_border(a, (vs_vec2){ p.x + middle * (q.x - p.x), p.y + middle * (q.y - p.y) }, slack)) {
        ok = end(t, false), broken = true;
        continue;
      }
      if (t->out->count == t->first) ok = add(t, from);
      ok = ok && add(t, to);
    }
  }
  if (ok && !broken && t->out->count > t->first) t->out->count--; /* the whole loop is one closed line: removes its last
                                                                   * point, which repeats the first */
  ok = ok && end(t, !broken);
  free(c.at);
  return ok;
}

bool vs_area_inner_lines(const vs_area *a, const vs_area *b, double slack, const char *purpose, vs_inner_lines *out,
                         vs_error *e) {
  vs_area both[2] = { *a, *b }, inner = { 0 };
  *out = (vs_inner_lines){ 0 };
  bool ok = vs_area_combine(VS_AREA_INTERSECTION, both, 2, purpose, &inner, e);
  tracer t = { .out = out };
  for (size_t l = 0, first = 0; ok && l < inner.loop_count; first += inner.size[l++])
    ok = trace(a, inner.at + first, inner.size[l], slack, &t) || vs_error_memory(e, NULL);
  vs_area_free(&inner);
  return ok;
}
