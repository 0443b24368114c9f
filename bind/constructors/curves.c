/* Implements the procedures that create curves and regions. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/precision.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/origins.h"
#include "bind/records.h"

#define REAL(i) (f->arg[i].real)
#define POINT(i) (f->arg[i].point)
#define TURN 6.283185307179586

static int32_t segments(const vs_args *f) {
  return f->key[0].given ? (int32_t)f->key[0].integer : vs_bind_segments(f->vm);
}

/* ---- polylines ---- */

static double extent(const vs_vec3 *at, size_t n) { /* returns the greatest distance of a point from the first point,
                                                     * the unit for comparing lengths */
  double size = 0;
  for (size_t i = 1; i < n; i++) size = fmax(size, vs_v3_length(vs_v3_sub(at[i], at[0])));
  return size;
}

static vs_node *points_node(vs_store *s, vs_kind kind, const vs_vec3 *at, size_t n, bool closed,
                            const struct vs_spline *more) {
  if (n > UINT32_MAX) return NULL;
  vs_points *p = vs_points_new(s, at, n);
  if (!p) return NULL;
  struct vs_line line = { .points = p, .closed = closed };
  struct vs_spline spline = more ? *more : (struct vs_spline){ 0 };
  spline.points = p, spline.closed = closed;
  vs_node *node = vs_node_new(s, kind, kind == VS_LINE ? (const void *)&line : &spline, NULL, 0);
  vs_points_release(s, p);
  return node;
}

/* Removes each point that equals the point before it. If the last point equals the first, removes the last and returns
 * true. */
static bool tidy(vs_vec3 *at, size_t *count) {
  size_t n = 0;
  for (size_t i = 0; i < *count; i++)
    if (n == 0 || !vs_v3_equal(at[n - 1], at[i])) at[n++] = at[i];
  bool closed = n > 2 && vs_v3_length(vs_v3_sub(at[n - 1], at[0])) <= 1e-9 * extent(at, n);
  *count = n - closed;
  return closed;
}

static vs_status polyline(vs_args *f, vs_vec3 *at, size_t n, bool close, vs_value *out) {
  if (n < 2) {
    VS_ROOTS(f->vm, r, 1);
    r[0] = VS_NIL;
    if (n == 1 && !vs_bind_give_point(f, at[0], &r[0])) return VS_ERROR;
    return vs_bind_refuse(f, "points", "two points or more", r[0]);
  }
  bool closed = tidy(at, &n) || close;
  if (n < 2) return vs_bind_empty(f, "all points are the same", out);
  if (closed && n < 3) {
    if (close) return vs_bind_empty(f, "fewer than three corners", out);
    closed = false;
  }
  return vs_bind_give_node(f, points_node(f->store, VS_LINE, at, n, closed, NULL), out);
}

vs_status vs_p_make_line(vs_args *f, vs_value *out) {
  return polyline(f, f->arg[0].points.at, f->arg[0].points.count, false, out);
}
vs_status vs_p_make_polygon(vs_args *f, vs_value *out) {
  return polyline(f, f->arg[0].points.at, f->arg[0].points.count, true, out);
}

vs_status vs_p_make_rectangle(vs_args *f, vs_value *out) {
  vs_vec3 p = POINT(0), q = POINT(1), at[4] = { p, p, q, q };
  if (p.z == q.z) at[1].x = q.x, at[3].x = p.x;
  else if (p.y == q.y) at[1].x = q.x, at[3].x = p.x;
  else if (p.x == q.x) at[1].y = q.y, at[3].y = p.y;
  else
    return vs_fail(f->vm, f->vm->sym.range,
                   "p and q must have one coordinate in common: a rectangle lies parallel to XY, XZ or YZ");
  if (vs_v3_equal(at[0], at[1]) || vs_v3_equal(at[1], at[2])) return vs_bind_empty(f, "no width or no height", out);
  return polyline(f, at, 4, true, out);
}

vs_status vs_p_make_regular_polygon(vs_args *f, vs_value *out) {
  size_t n = (size_t)f->arg[2].integer;
  double from = f->arg[3].given ? REAL(3) : 0;
  if (REAL(1) == 0) return vs_bind_empty(f, "r is 0", out);
  vs_vec3 *at = vs_bind_scratch(f, n * sizeof *at);
  if (!at) return VS_ERROR;
  for (size_t i = 0; i < n; i++) {
    double s, c;
    vs_sincos(from + TURN * (double)i / (double)n, &s, &c);
    at[i] = vs_v3(POINT(0).x + REAL(1) * c, POINT(0).y + REAL(1) * s, POINT(0).z);
  }
  return vs_bind_give_node(f, points_node(f->store, VS_LINE, at, n, true, NULL), out);
}

/* ---- circles, ellipses and arcs ---- */

static vs_node *circle(vs_store *s, vs_vec3 c, double r, int32_t n) {
  return vs_node_new(s, VS_CIRCLE, &(struct vs_circle){ .center = c, .radius = r, .segments = n }, NULL, 0);
}

vs_status vs_p_make_circle(vs_args *f, vs_value *out) {
  if (REAL(1) == 0) return vs_bind_empty(f, "r is 0", out);
  return vs_bind_give_node(f, circle(f->store, POINT(0), REAL(1), segments(f)), out);
}

vs_status vs_p_make_arc(vs_args *f, vs_value *out) {
  struct vs_arc d = { .center = POINT(0), .radius = REAL(1), .segments = segments(f) };
  if (f->form == 1) d.start = REAL(2);
  d.end = f->form == 0 ? REAL(2) : REAL(3);
  if (d.radius == 0) return vs_bind_empty(f, "r is 0", out);
  if (d.start == d.end) return vs_bind_empty(f, "the arc has no length", out);
  if (fabs(d.end - d.start) >= TURN * (1 - 1e-15))
    return vs_bind_give_node(f, circle(f->store, d.center, d.radius, d.segments), out);
  return vs_bind_make(f, VS_ARC, &d, NULL, 0, out);
}

/* An ellipse is a circle that is scaled along one axis. */
vs_status vs_p_make_ellipse(vs_args *f, vs_value *out) {
  double rx = REAL(1), ry = REAL(2);
  if (rx == 0 || ry == 0) return vs_bind_empty(f, "rx or ry is 0", out);
  vs_node *c = circle(f->store, POINT(0), rx, segments(f));
  if (!vs_bind_keep(f, c)) return VS_ERROR;
  vs_ref ref = { c, vs_bind_origin(f->bind) };
  if (rx == ry) return vs_bind_give_node(f, vs_node_retain(c), out);
  return vs_bind_make(f, VS_TRANSFORM,
                      &(struct vs_transform){ .matrix = vs_affine_scaling(POINT(0), vs_v3(1, ry / rx, 1)) }, &ref, 1,
                      out);
}

/* ---- splines ---- */

/* reads the tangent at an end of a spline; #f means that none is given: the zero vector */
static vs_status tangent(vs_args *f, int i, const char *name, vs_vec3 *out) {
  vs_value v = f->arg[i].value;
  double angle, s, c;
  *out = vs_v3(0, 0, 0);
  if (v == VS_FALSE) return VS_OK;
  if (vs_is_flat(v, VS_FLAT_VECTOR)) {
    const double *d = vs_as_flat(v)->at;
    *out = vs_v3(d[0], d[1], d[2]);
    if (isfinite(d[0]) && isfinite(d[1]) && isfinite(d[2]) && !vs_v3_equal(*out, vs_v3(0, 0, 0))) return VS_OK;
  } else if (vs_bind_take_number(f->vm, v, &angle) && isfinite(angle)) {
    vs_sincos(angle, &s, &c);
    *out = vs_v3(c, s, 0);
    return VS_OK;
  }
  return vs_bind_refuse(f, name, "a gvector longer than 0, or an angle in the XY plane", v);
}

/* (%make-spline points start end segments): geometry.scm has converted the arguments of make-spline to these four. */
vs_status vs_p_make_spline(vs_args *f, vs_value *out) {
  vs_vec3 *at = f->arg[0].points.at;
  size_t n = f->arg[0].points.count;
  struct vs_spline d = { .segments = f->arg[3].integer ? (int32_t)f->arg[3].integer : vs_bind_segments(f->vm) };
  if (!tangent(f, 1, "start-tangent", &d.start_tangent) || !tangent(f, 2, "end-tangent", &d.end_tangent))
    return VS_ERROR;
  if (n < 2) return vs_bind_refuse(f, "points", "two points or more", f->arg[0].value);
  bool closed = tidy(at, &n);
  if (n < 2) return vs_bind_empty(f, "all points are the same", out);
  if (closed && n < 3) closed = false;
  if (closed) d.start_tangent = d.end_tangent = vs_v3(0, 0, 0); /* a closed spline is smooth at all points, so tangents
                                                                 * that are given have no effect */
  return vs_bind_give_node(f, points_node(f->store, VS_SPLINE, at, n, closed, &d), out);
}

/* ---- regions ---- */

vs_status vs_p_make_donut(vs_args *f, vs_value *out) {
  double outer = fmax(REAL(1), REAL(2)), inner = fmin(REAL(1), REAL(2));
  if (outer == 0 || outer == inner) return vs_bind_empty(f, "the ring has no width", out);
  const vs_origin *o = vs_bind_origin(f->bind);
  vs_ref c[2] = { { circle(f->store, POINT(0), outer, segments(f)), o } };
  if (!vs_bind_keep(f, c[0].node)) return VS_ERROR;
  if (inner > 0) {
    c[1] = (vs_ref){ circle(f->store, POINT(0), inner, segments(f)), o };
    if (!vs_bind_keep(f, c[1].node)) return VS_ERROR;
  }
  return vs_bind_make(f, VS_REGION, &(struct vs_region){ 0 }, c, inner > 0 ? 2 : 1, out);
}
