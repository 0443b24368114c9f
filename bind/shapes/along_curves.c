/* Implements procedures that return points along a curve, and pipes along curves. */
#include "bind/shapes/along_curves.h"

#include <stdio.h>
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "geometry/measure/bounds.h"
#include "geometry/profiles/pipe.h"
#include "geometry/profiles/surface.h"
#include "model/store/array.h"

vs_status vs_bind_stations(vs_args *f, int i, vs_stations *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_bounds b;
  if (!vs_bind_finite(f, i) || !vs_bind_resolve(f, i)) return VS_ERROR;
  vs_node *curve = vs_arg_ref(f, i).node;
  if (curve->class_ != VS_CURVE || vs_node_is_empty(curve))
    return vs_bind_refuse(f, "c", "a curve", vs_arg_value(f, i));
  if (!vs_node_bounds(curve, &b, &e)) return vs_bind_error(vm, &e);
  const vs_fineness facets = { .tolerance = fmax(vs_bounds_diagonal(&b) * 1e-6, 1e-300) };
  return vs_stations_open(curve, &facets, out, &e) ? VS_OK : vs_bind_error(vm, &e);
}

/* Sets *out to the station (point and frame) of the curve in argument 0 at the distance in argument 1. On a closed
 * curve, the distance may exceed the curve's length. */
static vs_status station(vs_args *f, vs_station *out) {
  vs_stations s;
  double at = vs_arg_real(f, 1);
  if (!vs_bind_stations(f, 0, &s)) return VS_ERROR;
  double slack = 1e-9 * s.length;
  bool closed = s.path.closed, outside = !closed && (at < -slack || at > s.length + slack);
  char expected[64], length[32];
  if (outside) {
    vs_bind_number_text(length, s.length);
    snprintf(expected, sizeof expected, "from 0 to %s, the curve's length", length);
  } else {
    *out = vs_station_at(&s, closed ? at - s.length * floor(at / s.length) : at);
  }
  vs_stations_close(&s);
  return outside ? vs_bind_refuse(f, "s", expected, vs_arg_value(f, 1)) : VS_OK;
}

vs_status vs_p_curve_point(vs_args *f, vs_value *out) {
  vs_station s;
  return station(f, &s) && vs_bind_give_point(f, s.at, out);
}

vs_status vs_p_curve_tangent(vs_args *f, vs_value *out) {
  vs_station s;
  return station(f, &s) && vs_bind_give_vector(f, s.tangent, out);
}

vs_status vs_p_curve_curvature(vs_args *f, vs_value *out) {
  vs_station s;
  return station(f, &s) && vs_bind_give_real(f, s.curvature, out);
}

vs_status vs_p_curve_frame(vs_args *f, vs_value *out) {
  vs_station s;
  if (!station(f, &s)) return VS_ERROR;
  vs_vec3 x = s.across, z = s.tangent, y = vs_v3_cross(z, x);
  const vs_affine m = { { { x.x, y.x, z.x, s.at.x }, { x.y, y.y, z.y, s.at.y }, { x.z, y.z, z.z, s.at.z } } };
  return vs_bind_give_matrix(f, &m, out);
}

/* (curve-division c n): returns n + 1 points at equal distances along the curve, both ends included. */
vs_status vs_p_curve_division(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  enum { MOST = 1000000 };
  int64_t n = vs_arg_integer(f, 1);
  vs_stations s;
  VS_ROOTS(vm, r, 2);
  if (n > MOST) return vs_bind_refuse(f, "n", "at most a million", vs_arg_value(f, 1));
  if (!vs_bind_stations(f, 0, &s)) return VS_ERROR;
  bool ok = true;
  r[1] = VS_NIL;
  for (int64_t i = n; ok && i >= 0; i--) { /* the last point of a closed curve is exactly its start */
    vs_station at = vs_station_at(&s, s.path.closed && i == n ? 0 : s.length * (double)i / (double)n);
    ok = vs_bind_give_point(f, at.at, &r[0]) && vs_cons(vm, r[0], r[1], &r[1]) && vs_poll(vm, 64);
  }
  vs_stations_close(&s);
  *out = r[1];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- curve walks: curves that are sampled once and evaluated many times ---- */

static void walk_free(void *p) {
  vs_stations_close(p);
  free(p);
}
static const vs_foreign_type walk_type = { .name = "a curve's places", .release = walk_free };

/* (%curve-walk c): returns a curve walk, the sampled curve. */
vs_status vs_p_curve_walk(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_stations *s = NULL;
  size_t room = 0;
  if (!VS_GROW(s, room, 1)) return vs_fail_memory(vm);
  if (!vs_bind_stations(f, 0, s)) return free(s), VS_ERROR;
  return vs_make_foreign(vm, &walk_type, s, 0, out);
}

/* Returns the station (point and frame) of curve walk arg[0] at the fraction arg[1] of its length. *along becomes the
 * distance by which the point is beyond an end of an open curve: negative before the start, 0 on the curve. On a closed
 * curve, fractions beyond 1 continue at the start. */
static vs_station walk_station(const vs_args *f, double *along) {
  const vs_stations *w = vs_foreign_get(vs_arg_value(f, 0), &walk_type);
  double share = vs_arg_real(f, 1);
  if (w->path.closed) share -= floor(share);
  double within = share < 0 ? 0 : share > 1 ? 1 : share;
  *along = (share - within) * w->length;
  return vs_station_at(w, within * w->length);
}

/* Sets *out to a point near the station s: at distance arg[2] along x, arg[3] along y and `along` along the tangent. */
static vs_status walk_point(vs_args *f, const vs_station *s, vs_vec3 x, vs_vec3 y, double along, vs_value *out) {
  vs_vec3 across = vs_v3_add(vs_v3_scale(x, vs_arg_real(f, 2)), vs_v3_scale(y, vs_arg_real(f, 3)));
  return vs_bind_give_point(f, vs_v3_add(vs_v3_add(s->at, vs_v3_scale(s->tangent, along)), across), out);
}

/* (%walk-place walk s x y): returns the point at the fraction s of the curve's length, moved by x and y across the
 * curve. Beyond the ends of an open curve, follows the tangents. */
vs_status vs_p_walk_place(vs_args *f, vs_value *out) {
  double along;
  vs_station s = walk_station(f, &along);
  return walk_point(f, &s, s.across, vs_v3_cross(s.tangent, s.across), along, out);
}

/* (%walk-upright walk s x y up): like %walk-place, but the direction y is perpendicular to the curve and as close as
 * possible to `up`, and x points to the left of the direction of travel. Returns #f if the curve is parallel to
 * `up`. */
vs_status vs_p_walk_upright(vs_args *f, vs_value *out) {
  double along;
  vs_station s = walk_station(f, &along);
  vs_vec3 up = vs_v3_unit(vs_arg_point(f, 4)), y = vs_v3_sub(up, vs_v3_scale(s.tangent, vs_v3_dot(up, s.tangent)));
  if (vs_v3_length(y) < 1e-6) return *out = VS_FALSE, VS_OK;
  y = vs_v3_unit(y);
  return walk_point(f, &s, vs_v3_cross(y, s.tangent), y, along, out);
}

/* ---- pipes along a curve ---- */

enum { AROUND = 128, RINGS = 192 };

static bool pipe_open(vs_args *f, vs_pipe *p, vs_error *e) {
  vs_scheme *vm = vs_call_vm(f);
  vs_bounds b;
  int segments = vs_arg_given(f, 1) && vs_arg_integer(f, 1) ? (int)vs_arg_integer(f, 1) : vs_bind_segments(vm);
  vs_node *curve = vs_arg_ref(f, 0).node;
  if (!vs_node_bounds(curve, &b, e)) return false;
  double tolerance = vs_bind_tolerance(vm);
  if (!(tolerance > 0)) tolerance = fmax(vs_fineness_tolerance(&b), 1e-300);
  return vs_pipe_open(curve, segments ? segments : RINGS, tolerance, p, e);
}

/* (%pipe-places c segments): returns the places of a pipe's rings along the curve, as fractions of its length from 0 to
 * 1. */
vs_status vs_p_pipe_places(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_pipe p;
  VS_ROOTS(vm, r, 1);
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  if (!pipe_open(f, &p, &e)) return vs_bind_error(vm, &e);
  bool ok = true;
  r[0] = VS_NIL;
  for (size_t i = p.count; ok && i-- > 0;) ok = vs_cons(vm, vs_flonum(p.at[i] / p.stations.length), r[0], &r[0]);
  vs_pipe_close(&p);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* (%make-pipe c segments radii): creates a pipe along the curve. `radii` has the radius of each ring, at the places
 * that %pipe-places returns. */
vs_status vs_p_make_pipe(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_pipe p;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  if (!pipe_open(f, &p, &e)) return vs_bind_error(vm, &e);
  int segments = vs_arg_integer(f, 1) ? (int)vs_arg_integer(f, 1) : vs_bind_segments(vm);
  size_t around = segments ? (size_t)segments : AROUND, caps = p.stations.path.closed ? 0 : 1, n = p.count;
  double *radius = vs_bind_scratch(f, (n + 1) * sizeof *radius);
  vs_vec3 *grid = vs_bind_scratch(f, (n + 2) * around * sizeof *grid), at;
  bool ok = radius && grid;
  vs_value l = vs_arg_value(f, 2);
  for (size_t i = 0; ok && i < n; i++, l = vs_cdr(l))
    ok = vs_is_pair(l) && vs_bind_take_number(vm, vs_car(l), &radius[i]);
  bool turns = ok && !vs_pipe_rings(&p, radius, around, grid + caps * around, &at);
  for (size_t k = 0; ok && caps && k < around; k++) { /* closes each end of the pipe by a flat disc: a further row of
                                                       * points, all equal to the centre */
    grid[k] = vs_station_at(&p.stations, 0).at;
    grid[(n + 1) * around + k] = vs_station_at(&p.stations, p.stations.length).at;
  }
  vs_pipe_close(&p);
  if (!ok) return VS_ERROR;
  if (turns) {
    char x[32], y[32], z[32];
    vs_bind_number_text(x, at.x), vs_bind_number_text(y, at.y), vs_bind_number_text(z, at.z);
    return vs_fail(vm, vm->sym.range, "the curve turns back on itself at (xyz %s %s %s)", x, y, z);
  }
  vs_point_grid pipe = { grid, n + 2 * caps, around, caps == 0, true };
  vs_node *node = vs_surface_make(vs_call_store(f), VS_GRID_SURFACE, &pipe, &e);
  return node ? vs_bind_give_node(f, node, out) : vs_bind_error(vm, &e);
}
