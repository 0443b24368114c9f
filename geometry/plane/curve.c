/* Converts curves to paths. Lines, arcs, circles and interpolating splines are sampled by the rule of tolerance.h, with
 * exact ends.
 *
 * On its i-th span, a spline through P_0..P_n has the parameter length h_i = |P_{i+1} - P_i|. The second derivatives
 * M_i at the knots determine it. They are the solution of the usual tridiagonal system: with natural ends (M = 0), with
 * given unit tangents, or closed (Sherman-Morrison). |S''| is largest at an end of a span. Therefore a chord of
 * parameter length d deviates from the curve by at most d*d/8*max(|M_i|, |M_{i+1}|). */
#include "geometry/plane/curve.h"
#include "model/store/array.h"

#include <stdlib.h>

enum { HALVINGS = 40 };
static const double full_turn = 6.28318530717958647693, STANDS = 1e-9, TURNS_BACK = -.75;
static const double SIXTEENTH = .92387953251128675613; /* Cosine of a sixteenth of a turn, the largest angle by which a
                                                        * spline may turn from one sample to the next. */

void vs_path_free(vs_path *p) {
  free(p->at);
  *p = (vs_path){ 0 };
}

bool vs_path_add(vs_path *p, vs_vec3 at, vs_vec3 arriving, vs_vec3 leaving) {
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = (vs_path_point){ at, arriving, leaving, 0 };
  return true;
}

void vs_path_measure(vs_path *p) {
  p->length = 0;
  for (size_t i = 0; i < p->count; i++) {
    if (i) p->length += vs_v3_length(vs_v3_sub(p->at[i].at, p->at[i - 1].at));
    p->at[i].along = p->length;
  }
  if (p->closed && p->count) p->length += vs_v3_length(vs_v3_sub(p->at[0].at, p->at[p->count - 1].at));
}

void vs_path_reverse(vs_path *p) {
  for (size_t i = 0, j = p->count; i < j; i++) {
    j--;
    vs_path_point swap = p->at[i];
    p->at[i] = p->at[j];
    p->at[j] = swap;
  }
  for (size_t i = 0; i < p->count; i++) {
    vs_vec3 arriving = vs_v3_scale(p->at[i].leaving, -1);
    p->at[i].leaving = vs_v3_scale(p->at[i].arriving, -1);
    p->at[i].arriving = arriving;
  }
  vs_path_measure(p);
}

static bool curve_line(vs_path *out, const vs_vec3 *at, size_t n, bool closed) {
  bool ok = true;
  vs_vec3 none = { 0, 0, 0 };
  for (size_t i = 0; ok && i < n; i++)
    if (!out->count || !vs_v3_equal(out->at[out->count - 1].at, at[i])) ok = vs_path_add(out, at[i], none, none);
  while (closed && out->count > 1 && vs_v3_equal(out->at[0].at, out->at[out->count - 1].at)) out->count--;
  out->closed = closed && out->count > 2;
  size_t m = out->count;
  for (size_t i = 0; m > 1 && i < m; i++) {
    size_t before = i ? i - 1 : out->closed ? m - 1 : 0, after = i + 1 < m ? i + 1 : out->closed ? 0 : m - 1;
    vs_vec3 arriving = vs_v3_unit(vs_v3_sub(out->at[i].at, out->at[before].at)),
            leaving = vs_v3_unit(vs_v3_sub(out->at[after].at, out->at[i].at));
    out->at[i].arriving = before == i ? leaving : arriving;
    out->at[i].leaving = after == i ? arriving : leaving;
  }
  return ok;
}

static bool curve_circle(vs_path *out, vs_vec3 c, double r, int n) {
  bool ok = true;
  for (int i = 0; ok && i < n; i++) {
    double sine, cosine;
    vs_turn_sincos(i, n, &sine, &cosine);
    vs_vec3 t = { -sine, cosine, 0 };
    ok = vs_path_add(out, vs_v3(c.x + r * cosine, c.y + r * sine, c.z), t, t);
  }
  out->closed = true;
  return ok;
}

static bool curve_arc(vs_path *out, vs_vec3 c, double r, double start, double end, int turn) {
  int n = (int)ceil(fabs(end - start) / full_turn * turn - 1e-9);
  double way = end < start ? -1 : 1;
  bool ok = true;
  if (n < 1) n = 1;
  for (int i = 0; ok && i <= n; i++) {
    double sine, cosine;
    vs_sincos(i == n ? end : start + (end - start) * i / n, &sine, &cosine);
    vs_vec3 t = { -way * sine, way * cosine, 0 };
    ok = vs_path_add(out, vs_v3(c.x + r * cosine, c.y + r * sine, c.z), t, t);
  }
  return ok;
}

/* ---- splines through knots (given points) ---- */

typedef struct { size_t n; /* n: number of knots */ bool closed; vs_vec3 *p, *m; double *h, *scratch; } vs_spline_work;

/* Solves the tridiagonal system of n > 0 equations with the diagonals sub, diag and sup and the right sides rhs, which
 * the solution overwrites. scratch has room for n doubles. */
static void spline_tridiagonal(size_t n, const double *sub, const double *diag, const double *sup, vs_vec3 *rhs,
                               double *scratch) {
  double d = diag[0];
  VS_ASSERT(n > 0);
  rhs[0] = vs_v3_scale(rhs[0], 1 / d);
  for (size_t i = 1; i < n; i++) {
    scratch[i] = sup[i - 1] / d;
    d = diag[i] - sub[i] * scratch[i];
    rhs[i] = vs_v3_scale(vs_v3_sub(rhs[i], vs_v3_scale(rhs[i - 1], sub[i])), 1 / d);
  }
  for (size_t i = n - 1; i-- > 0;) rhs[i] = vs_v3_sub(rhs[i], vs_v3_scale(rhs[i + 1], scratch[i + 1]));
}

static void spline_solve(vs_spline_work *w, vs_vec3 start, vs_vec3 end) {
  size_t n = w->n;
  double *sub = w->scratch, *diag = sub + n, *sup = diag + n, *rest = sup + n;
  vs_vec3 none = { 0, 0, 0 };
  for (size_t i = 0; i < n; i++) {
    size_t before = i ? i - 1 : n - 1, after = i + 1 < n ? i + 1 : 0;
    vs_vec3 ahead = vs_v3_scale(vs_v3_sub(w->p[after], w->p[i]), 1 / w->h[i]),
            behind = vs_v3_scale(vs_v3_sub(w->p[i], w->p[before]), 1 / w->h[before]);
    sub[i] = w->h[before];
    diag[i] = 2 * (w->h[before] + w->h[i]);
    sup[i] = w->h[i];
    w->m[i] = vs_v3_scale(vs_v3_sub(ahead, behind), 6);
    if (w->closed || (i && i + 1 < n)) continue;
    bool first = i == 0;
    vs_vec3 tangent = first ? start : end;
    double h = first ? w->h[0] : w->h[n - 2];
    bool natural = vs_v3_equal(tangent, none);
    diag[i] = natural ? 1 : 2 * h;
    sub[i] = sup[i] = natural ? 0 : h;
    tangent = vs_v3_unit(tangent);
    w->m[i] = natural ? none : vs_v3_scale(first ? vs_v3_sub(ahead, tangent) : vs_v3_sub(tangent, behind), 6);
  }
  if (!w->closed) {
    spline_tridiagonal(n, sub, diag, sup, w->m, rest);
    return;
  }
  /* Both corners of the cyclic matrix A are h[n - 1]. To solve with it, A is split into B + u v^T, where B is
   * tridiagonal, u = (g, 0.., c) and v = (1, 0.., c/g). */
  double c = w->h[n - 1], g = -diag[0];
  diag[0] -= g;
  diag[n - 1] -= c * c / g;
  vs_vec3 *u = (vs_vec3 *)(void *)(rest + n);
  for (size_t i = 0; i < n; i++) u[i] = vs_v3(i == 0 ? g : i == n - 1 ? c : 0, 0, 0);
  spline_tridiagonal(n, sub, diag, sup, w->m, rest);
  spline_tridiagonal(n, sub, diag, sup, u, rest);
  double below = 1 + u[0].x + c / g * u[n - 1].x;
  vs_vec3 factor = vs_v3_scale(vs_v3_add(w->m[0], vs_v3_scale(w->m[n - 1], c / g)), 1 / below);
  for (size_t i = 0; i < n; i++) w->m[i] = vs_v3_sub(w->m[i], vs_v3_scale(factor, u[i].x));
}

/* Returns the point of span i at the parameter t, 0 to 1, and the spline's directions before and after it. The
 * directions are opposite at a cusp, where the speed is 0 and the curve turns back. */
static vs_path_point spline_at(const vs_spline_work *w, size_t i, double t) {
  size_t j = i + 1 < w->n ? i + 1 : 0;
  double h = w->h[i], b = t, a = 1 - t;
  vs_vec3 p = w->p[i], q = w->p[j], m = w->m[i], k = w->m[j];
  vs_vec3 bends = vs_v3_add(vs_v3_scale(m, a * a * a - a), vs_v3_scale(k, b * b * b - b));
  vs_vec3 at = vs_v3_add(vs_v3_add(vs_v3_scale(p, a), vs_v3_scale(q, b)), vs_v3_scale(bends, h * h / 6));
  vs_vec3 speed =
      vs_v3_add(vs_v3_scale(vs_v3_sub(q, p), 1 / h),
                vs_v3_scale(vs_v3_add(vs_v3_scale(m, 1 - 3 * a * a), vs_v3_scale(k, 3 * b * b - 1)), h / 6));
  vs_vec3 force = vs_v3_add(vs_v3_scale(m, a), vs_v3_scale(k, b)), ahead = vs_v3_unit(speed), behind = ahead;
  VS_ASSERT(i < w->n && t >= 0 && t <= 1);
  if (vs_v3_length(speed) < STANDS) { /* true if the speed at t is practically 0, as at a cusp */
    ahead = vs_v3_unit(force), behind = vs_v3_scale(ahead, -1);
    if (vs_v3_length(force) * h < STANDS) ahead = behind = vs_v3_unit(vs_v3_sub(k, m));
  }
  return (vs_path_point){ at, behind, ahead, 0 };
}

/* Adds samples between the parameters `from` and `to` of span i, which is the piece of the spline between two knots.
 * From one sample to the next, the direction turns by at most the angle with the cosine `most`. */
static bool spline_turn(const vs_spline_work *w, size_t i, double from, double to, double most, vs_path *out) {
  struct { double to; int halvings; } parts[HALVINGS + 1] = { { to, 0 } }; /* stack of the ranges of the parameter that
                                                                            * are still to be sampled, the earliest on
                                                                            * top; a range ends at `to` */
  vs_path_point p = spline_at(w, i, from);
  bool ok = true;
  VS_ASSERT(from < to);
  for (size_t n = 1; ok && n > 0;) {
    double end = parts[n - 1].to, goes;
    vs_path_point q = spline_at(w, i, end);
    goes = vs_v3_dot(p.leaving, q.arriving);
    if (goes < most && parts[n - 1].halvings < HALVINGS) {
      int halvings = ++parts[n - 1].halvings;
      parts[n].to = (from + end) / 2;
      parts[n++].halvings = halvings;
      continue;
    }
    if (goes < TURNS_BACK) ok = vs_path_add(out, spline_at(w, i, (from + end) / 2).at, p.leaving, q.arriving);
    if (--n > 0) ok = ok && vs_path_add(out, q.at, q.arriving, q.leaving);
    from = end;
    p = q;
  }
  return ok;
}

static double spline_angle(vs_vec3 a, vs_vec3 b) { return atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)); }

/* Returns true if the spline has too few different knots for a curve: a line joins them. */
static bool spline_is_line(const vs_spline_work *w) { return w->n < 2 || (w->closed && w->n < 3); }

/* Copies the knots of s without repetitions into w, and solves for the second derivatives if the knots are enough for a
 * spline (spline_is_line). Returns false when memory is out. The caller calls spline_end in either case. */
static bool spline_begin(vs_spline_work *w, const struct vs_spline *s) {
  size_t given = s->points->count;
  *w = (vs_spline_work){ .closed = s->closed };
  w->p = vs_fresh(given + 1, sizeof *w->p);
  w->m = vs_fresh(given + 1, sizeof *w->m);
  w->h = vs_fresh(given + 1, sizeof *w->h);
  w->scratch = vs_fresh((given + 1) * 7, sizeof *w->scratch);
  if (!w->p || !w->m || !w->h || !w->scratch) return false;
  for (size_t i = 0; i < given; i++)
    if (!w->n || !vs_v3_equal(w->p[w->n - 1], s->points->at[i])) w->p[w->n++] = s->points->at[i];
  while (w->closed && w->n > 1 && vs_v3_equal(w->p[0], w->p[w->n - 1])) w->n--;
  if (spline_is_line(w)) return true;
  for (size_t i = 0; i < w->n; i++) w->h[i] = vs_v3_length(vs_v3_sub(w->p[(i + 1) % w->n], w->p[i]));
  spline_solve(w, s->start_tangent, s->end_tangent);
  return true;
}

static void spline_end(vs_spline_work *w) { free(w->p), free(w->m), free(w->h), free(w->scratch); }

static bool curve_spline(vs_path *out, const struct vs_spline *s, const vs_fineness *f) {
  vs_spline_work w;
  bool ok = spline_begin(&w, s);
  if (ok && spline_is_line(&w)) {
    ok = curve_line(out, w.p, w.n, false);
    goto done;
  }
  if (!ok) goto done;
  int segments = s->segments ? s->segments : f->segments;
  double turn = segments > 0 ? segments : vs_fineness_least(f);
  size_t spans = w.closed ? w.n : w.n - 1;
  for (size_t i = 0; ok && i < spans; i++) {
    vs_path_point last = spline_at(&w, i, 0), here;
    double turning = 0, most = fmax(vs_v3_length(w.m[i]), vs_v3_length(w.m[(i + 1) % w.n]));
    for (int k = 1; k <= 8; k++, last = here) {
      here = spline_at(&w, i, k / 8.0);
      turning += spline_angle(last.leaving, here.arriving);
      if (k < 8) turning += spline_angle(here.arriving, here.leaving);
    }
    double pieces = ceil(turning / full_turn * turn - 1e-9);
    if (segments <= 0) pieces = fmax(pieces, ceil(w.h[i] * sqrt(most / (8 * f->tolerance)) - 1e-9));
    int k = pieces < 1 ? 1 : pieces > 4096 ? 4096 : (int)pieces;
    for (int j = 0; ok && j < k; j++) {
      here = spline_at(&w, i, (double)j / k);
      ok = vs_path_add(out, j ? here.at : w.p[i], here.arriving, here.leaving) &&
           spline_turn(&w, i, (double)j / k, (j + 1.0) / k, segments > 0 ? TURNS_BACK : SIXTEENTH, out);
    }
  }
  if (ok && !w.closed) {
    vs_path_point end = spline_at(&w, w.n - 2, 1);
    ok = vs_path_add(out, w.p[w.n - 1], end.arriving, end.leaving);
  }
  out->closed = w.closed;
done:
  spline_end(&w);
  return ok;
}

/* Enlarges the bounding box b by the points of span i, mapped by a, at which a mapped coordinate is largest or
 * smallest. The derivative of each coordinate is u t^2 + v t + w. */
static void spline_reach(const vs_spline_work *s, size_t i, const vs_affine *a, vs_bounds *b) {
  size_t j = i + 1 < s->n ? i + 1 : 0;
  vs_vec3 chord = vs_v3_sub(s->p[j], s->p[i]), m = vs_v3_scale(s->m[i], s->h[i] * s->h[i] / 6),
          k = vs_v3_scale(s->m[j], s->h[i] * s->h[i] / 6);
  for (int axis = 0; axis < 3; axis++) {
    vs_vec3 row = vs_v3(a->m[axis][0], a->m[axis][1], a->m[axis][2]);
    double from = vs_v3_dot(row, m), to = vs_v3_dot(row, k);
    double u = 3 * (to - from), v = 6 * from, w = vs_v3_dot(row, chord) - 2 * from - to, root = v * v - 4 * u * w;
    if (!(root >= 0)) continue;
    double half = -(v + copysign(sqrt(root), v)) / 2, at[2] = { half / u, w / half };
    for (int n = 0; n < 2; n++)
      if (at[n] > 0 && at[n] < 1) vs_bounds_add(b, vs_affine_point(a, spline_at(s, i, at[n]).at));
  }
}

bool vs_spline_bounds(const struct vs_spline *s, const vs_affine *map, vs_bounds *b) {
  vs_spline_work w;
  bool ok = spline_begin(&w, s);
  for (size_t i = 0; ok && i < w.n; i++) vs_bounds_add(b, vs_affine_point(map, w.p[i]));
  size_t spans = !ok || spline_is_line(&w) ? 0 : w.closed ? w.n : w.n - 1;
  for (size_t i = 0; i < spans; i++) spline_reach(&w, i, map, b);
  spline_end(&w);
  return ok;
}

/* ---- sampling of curves of all kinds ---- */

static void curve_place(vs_path *out, const vs_affine *map) {
  for (size_t i = 0; i < out->count; i++) {
    vs_path_point *p = &out->at[i];
    p->at = vs_affine_point(map, p->at);
    p->arriving = vs_v3_unit(vs_affine_vector(map, p->arriving));
    p->leaving = vs_v3_unit(vs_affine_vector(map, p->leaving));
  }
  vs_path_measure(out);
}

bool vs_curve_round(const struct vs_arc *a, bool circle, const vs_affine *map, const vs_fineness *f, vs_path *out) {
  vs_fineness inner = vs_fineness_placed(f, map);
  int turn = vs_fineness_turn(&inner, a->radius, a->segments);
  if (!(circle ? curve_circle(out, a->center, a->radius, turn)
               : curve_arc(out, a->center, a->radius, a->start, a->end, turn)))
    return false;
  curve_place(out, map);
  return true;
}

bool vs_curve_leaf(const vs_node *n, const vs_affine *map, const vs_fineness *f, vs_path *out) {
  vs_fineness inner = vs_fineness_placed(f, map);
  bool ok = false;
  if (n->kind == VS_ARC) return vs_curve_round(VS_AS(arc, n), false, map, f, out);
  if (n->kind == VS_CIRCLE) {
    const struct vs_circle *c = VS_AS(circle, n);
    return vs_curve_round(&(struct vs_arc){ .center = c->center, .radius = c->radius, .segments = c->segments }, true,
                          map, f, out);
  }
  if (n->kind == VS_LINE)
    ok = curve_line(out, VS_AS(line, n)->points->at, VS_AS(line, n)->points->count, VS_AS(line, n)->closed);
  if (n->kind == VS_SPLINE) ok = curve_spline(out, VS_AS(spline, n), &inner);
  if (ok) curve_place(out, map);
  return ok;
}

bool vs_curve_is_straight(const vs_node *n) {
  while (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n)) n = n->children[0].node;
  return n->kind == VS_LINE;
}

bool vs_path_of_polyline(const vs_polyline *p, vs_path *out) {
  VS_ASSERT(out->count == 0);
  bool ok = curve_line(out, p->at, p->count, p->closed);
  if (ok) vs_path_measure(out);
  return ok;
}

bool vs_polyline_from_path(const vs_path *path, vs_polyline *out) {
  if (!VS_GROW(out->at, out->room, path->count)) return false;
  for (size_t i = 0; i < path->count; i++) out->at[i] = path->at[i].at;
  out->count = path->count;
  out->closed = path->closed;
  return true;
}
