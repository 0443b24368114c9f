/* Implements the natives of the Bezier and NURBS procedures: rational B-splines as Scheme values, points on them, and
 * curves and surfaces made from them. shapes.scm checks counts and reports faults. */

#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/take.h"
#include "geometry/profiles/nurbs.h"
#include "geometry/profiles/surface.h"
#include "geometry/tolerance.h"
#include "model/store/array.h"

typedef struct {
  vs_nurbs n;
  vs_vec3 *points;
  double *weights, *knots_u, *knots_v;
} spline;

static void spline_free(void *p) {
  spline *s = p;
  free(s->points), free(s->weights), free(s->knots_u), free(s->knots_v);
  free(s);
}
static const vs_foreign_type spline_type = { .name = "a spline", .release = spline_free };

/* Copies the numbers of a list to *out, which the caller frees. For #f, sets *out to NULL. If it fails, sets the error
 * and returns false. */
static bool numbers(vs_args *f, vs_value l, double **out, size_t *count) {
  vs_scheme *vm = vs_call_vm(f);
  size_t room = 0;
  *out = NULL, *count = 0;
  for (; vs_is_pair(l); l = vs_cdr(l)) {
    if (!VS_GROW(*out, room, *count + 1)) return vs_fail_memory(vm);
    if (!vs_bind_take_number(vm, vs_car(l), &(*out)[*count]))
      return vs_fail(vm, vm->sym.type, "a number is missing");
    (*count)++;
  }
  return true;
}

/* (%nurbs points degree-u degree-v weights knots-u knots-v): returns the spline. If an argument is wrong, returns a
 * list (fault direction number): a vs_nurbs_fault, 0 for u or 1 for v, and the position of the fault. */
vs_status vs_p_nurbs(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  spline *s = NULL;
  size_t room = 0, points_room = 0, n = vs_arg_points(f, 0).count, weights, ku, kv;
  if (!VS_GROW(s, room, 1)) return vs_fail_memory(vm);
  *s = (spline){ 0 };
  bool ok = VS_GROW(s->points, points_room, n + 1) || vs_fail_memory(vm);
  ok = ok && numbers(f, vs_arg_value(f, 3), &s->weights, &weights) &&
       numbers(f, vs_arg_value(f, 4), &s->knots_u, &ku) && numbers(f, vs_arg_value(f, 5), &s->knots_v, &kv);
  if (!ok) return spline_free(s), VS_ERROR;
  memcpy(s->points, vs_arg_points(f, 0).at, n * sizeof *s->points);
  s->n.points = s->points, s->n.weights = s->weights;
  s->n.u = (vs_nurbs_knots){ (int)vs_arg_integer(f, 1), ku - (size_t)vs_arg_integer(f, 1) - 1, s->knots_u };
  if (kv) s->n.v = (vs_nurbs_knots){ (int)vs_arg_integer(f, 2), kv - (size_t)vs_arg_integer(f, 2) - 1, s->knots_v };
  size_t at = 0;
  vs_nurbs_fault fault = vs_nurbs_check(&s->n.u, &at);
  bool in_v = false;
  if (fault == VS_NURBS_GOOD && kv) fault = vs_nurbs_check(&s->n.v, &at), in_v = true;
  if (fault == VS_NURBS_GOOD) return vs_make_foreign(vm, &spline_type, s, 0, out);
  spline_free(s);
  VS_ROOTS(vm, r, 1);
  return vs_cons(vm, vs_fix((int64_t)at), VS_NIL, &r[0]) && vs_cons(vm, vs_fix(in_v), r[0], &r[0]) &&
         vs_cons(vm, vs_fix((int64_t)fault), r[0], out);
}

static const vs_nurbs *given(vs_args *f) { return &((spline *)vs_foreign_get(vs_arg_value(f, 0), &spline_type))->n; }
static double within(const vs_nurbs_knots *k, double t) { return fmin(fmax(t, vs_nurbs_low(k)), vs_nurbs_high(k)); }

/* (%nurbs-point n u v): returns the point of the spline at the parameters u and v; v is ignored for a curve. */
vs_status vs_p_nurbs_point(vs_args *f, vs_value *out) {
  const vs_nurbs *n = given(f);
  double v = n->v.count ? within(&n->v, vs_arg_real(f, 2)) : 0;
  return vs_bind_give_point(f, vs_nurbs_point(n, within(&n->u, vs_arg_real(f, 1)), v, NULL, NULL), out);
}

/* (%nurbs-range n): returns the range of the parameters: (u0 u1) for a curve, (u0 u1 v0 v1) for a surface. */
vs_status vs_p_nurbs_range(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_nurbs *n = given(f);
  double ends[4] = { vs_nurbs_low(&n->u), vs_nurbs_high(&n->u) };
  if (n->v.count) ends[2] = vs_nurbs_low(&n->v), ends[3] = vs_nurbs_high(&n->v);
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  for (int i = n->v.count ? 3 : 1; i >= 0; i--)
    if (!vs_cons(vm, vs_flonum(ends[i]), r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

vs_status vs_p_make_nurbs_curve(vs_args *f, vs_value *out) {
  vs_node *node = vs_nurbs_curve_node(vs_call_store(f), given(f));
  if (!node) return vs_fail_memory(vs_call_vm(f));
  if (!vs_node_is_empty(node)) return vs_bind_give_node(f, node, out);
  vs_node_release(node);
  return vs_bind_empty(f, "all points are the same", out);
}

/* Sets *out to values of the parameter u or v (along_v) at `steps` equal steps. If steps is 0, their number is chosen
 * so that no chord is farther than `chord` from the spline. Returns their number, or 0 when memory is out. */
static size_t parameters(const vs_nurbs *n, bool along_v, int64_t steps, double chord, double **out) {
  const vs_nurbs_knots *k = along_v ? &n->v : &n->u;
  size_t room = 0;
  *out = NULL;
  if (!steps) return vs_nurbs_parameters(n, along_v, chord, out);
  if (!VS_GROW(*out, room, (size_t)steps + 1)) return 0;
  double low = vs_nurbs_low(k), high = vs_nurbs_high(k);
  for (int64_t i = 0; i <= steps; i++) (*out)[i] = i == steps ? high : low + (high - low) * (double)i / (double)steps;
  return (size_t)steps + 1;
}

/* (%make-nurbs-surface n nu nv): creates the surface from nu times nv samples. If nu or nv is 0, it is computed from
 * the tolerance. */
vs_status vs_p_make_nurbs_surface(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_nurbs *n = given(f);
  vs_bounds b = vs_bounds_empty();
  vs_error e = { 0 };
  for (size_t i = 0; i < n->u.count * n->v.count; i++) vs_bounds_add(&b, n->points[i]);
  double chord = vs_bind_tolerance(vm), *u, *v;
  if (!(chord > 0)) chord = fmax(vs_fineness_tolerance(&b), 1e-300);
  size_t rows = parameters(n, false, vs_arg_integer(f, 1), chord, &u);
  size_t columns = parameters(n, true, vs_arg_integer(f, 2), chord, &v);
  vs_node *node = NULL;
  vs_vec3 *grid = NULL;
  size_t room = 0;
  vs_status status = rows && columns && VS_GROW(grid, room, rows * columns) ? VS_OK : vs_fail_memory(vm);
  for (size_t i = 0; status && i < rows; i++) {
    for (size_t j = 0; j < columns; j++) grid[i * columns + j] = vs_nurbs_point(n, u[i], v[j], NULL, NULL);
    if (!vs_poll(vm, columns * 32)) status = VS_ERROR;
  }
  if (status) {
    node = vs_surface_make(vs_call_store(f), VS_GRID_SURFACE, &(vs_point_grid){ grid, rows, columns, false, false },
                           &e);
    if (!node) status = vs_bind_error(vm, &e);
  }
  free(u), free(v), free(grid);
  if (!status) return VS_ERROR;
  if (!vs_node_is_empty(node)) return vs_bind_give_node(f, node, out);
  vs_node_release(node);
  return vs_bind_empty(f, "all points lie on one line", out);
}
