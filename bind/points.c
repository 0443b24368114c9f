/* Implements points, gvectors, axes, planes and matrices, and sequences of numbers or of points on a line or an arc. */
#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/refuse.h"
#include "bind/records.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"

#define X(i) (f->arg[i].real)
#define P(i) (f->arg[i].point)

static vs_vec3 polar(double rho, double phi, double z) {
  double s, c;
  vs_sincos(phi, &s, &c);
  return vs_v3(rho * c, rho * s, z);
}
static vs_vec3 spherical(double rho, double phi, double psi) { /* Returns the point with these spherical coordinates;
                                                                * psi is the angle from +Z */
  double s, c;
  vs_sincos(psi, &s, &c);
  return polar(rho * s, phi, rho * c);
}
/* These functions return a point whose coordinates are the numbers in f's arguments i, i + 1 ..., in one of four
 * coordinate systems. */
static vs_vec3 cartesian_at(const vs_args *f, int i) { return vs_v3(X(i), X(i + 1), X(i + 2)); }
static vs_vec3 polar_at(const vs_args *f, int i) { return polar(X(i), X(i + 1), 0); }
static vs_vec3 cylindrical_at(const vs_args *f, int i) { return polar(X(i), X(i + 1), X(i + 2)); }
static vs_vec3 spherical_at(const vs_args *f, int i) { return spherical(X(i), X(i + 1), X(i + 2)); }

/* ---- creating points ---- */
vs_status vs_p_xyz(vs_args *f, vs_value *out) { return vs_bind_give_point(f, cartesian_at(f, 0), out); }
vs_status vs_p_xy(vs_args *f, vs_value *out) { return vs_bind_give_point(f, vs_v3(X(0), X(1), 0), out); }
vs_status vs_p_xz(vs_args *f, vs_value *out) { return vs_bind_give_point(f, vs_v3(X(0), 0, X(1)), out); }
vs_status vs_p_yz(vs_args *f, vs_value *out) { return vs_bind_give_point(f, vs_v3(0, X(0), X(1)), out); }
vs_status vs_p_pol(vs_args *f, vs_value *out) { return vs_bind_give_point(f, polar_at(f, 0), out); }
vs_status vs_p_cyl(vs_args *f, vs_value *out) { return vs_bind_give_point(f, cylindrical_at(f, 0), out); }
vs_status vs_p_sph(vs_args *f, vs_value *out) { return vs_bind_give_point(f, spherical_at(f, 0), out); }

static vs_status moved(vs_args *f, vs_vec3 by, vs_value *out) {
  return vs_bind_give_point(f, vs_v3_add(P(0), by), out);
}
vs_status vs_p_add_xyz(vs_args *f, vs_value *out) { return moved(f, cartesian_at(f, 1), out); }
vs_status vs_p_add_xy(vs_args *f, vs_value *out) { return moved(f, vs_v3(X(1), X(2), 0), out); }
vs_status vs_p_add_xz(vs_args *f, vs_value *out) { return moved(f, vs_v3(X(1), 0, X(2)), out); }
vs_status vs_p_add_yz(vs_args *f, vs_value *out) { return moved(f, vs_v3(0, X(1), X(2)), out); }
vs_status vs_p_add_x(vs_args *f, vs_value *out) { return moved(f, vs_v3(X(1), 0, 0), out); }
vs_status vs_p_add_y(vs_args *f, vs_value *out) { return moved(f, vs_v3(0, X(1), 0), out); }
vs_status vs_p_add_z(vs_args *f, vs_value *out) { return moved(f, vs_v3(0, 0, X(1)), out); }
vs_status vs_p_add_pol(vs_args *f, vs_value *out) { return moved(f, polar_at(f, 1), out); }
vs_status vs_p_add_cyl(vs_args *f, vs_value *out) { return moved(f, cylindrical_at(f, 1), out); }
vs_status vs_p_add_sph(vs_args *f, vs_value *out) { return moved(f, spherical_at(f, 1), out); }

/* ---- coordinates of points ---- */
vs_status vs_p_cx(vs_args *f, vs_value *out) { return vs_bind_give_real(f, P(0).x, out); }
vs_status vs_p_cy(vs_args *f, vs_value *out) { return vs_bind_give_real(f, P(0).y, out); }
vs_status vs_p_cz(vs_args *f, vs_value *out) { return vs_bind_give_real(f, P(0).z, out); }
vs_status vs_p_pol_rho(vs_args *f, vs_value *out) { return vs_bind_give_real(f, hypot(P(0).x, P(0).y), out); }
vs_status vs_p_pol_phi(vs_args *f, vs_value *out) { return vs_bind_give_real(f, atan2(P(0).y, P(0).x), out); }
vs_status vs_p_sph_psi(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, atan2(hypot(P(0).x, P(0).y), P(0).z), out);
}
vs_status vs_p_length(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_flat_length(P(0).x, P(0).y, P(0).z), out);
}

/* ---- gvectors ---- */
vs_status vs_p_vxyz(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, cartesian_at(f, 0), out); }
vs_status vs_p_vpol(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, polar_at(f, 0), out); }
vs_status vs_p_vcyl(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, cylindrical_at(f, 0), out); }
vs_status vs_p_vsph(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, spherical_at(f, 0), out); }
vs_status vs_p_p_to_q(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, vs_v3_sub(P(1), P(0)), out); }
vs_status vs_p_p_plus_v(vs_args *f, vs_value *out) { return vs_bind_give_point(f, vs_v3_add(P(0), P(1)), out); }
vs_status vs_p_p_minus_v(vs_args *f, vs_value *out) { return vs_bind_give_point(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_p_minus_p(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_v_minus_v(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_v_times_r(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, vs_v3_scale(P(0), X(1)), out); }
vs_status vs_p_dot(vs_args *f, vs_value *out) { return vs_bind_give_real(f, vs_v3_dot(P(0), P(1)), out); }
vs_status vs_p_cross(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, vs_v3_cross(P(0), P(1)), out); }

vs_status vs_p_v_plus_v(vs_args *f, vs_value *out) {
  vs_vec3 sum = { 0, 0, 0 };
  for (size_t i = 0; i < f->arg[0].values.count; i++) {
    vs_value v = f->arg[0].values.at[i];
    if (!vs_is_flat(v, VS_FLAT_VECTOR)) return vs_bind_refuse(f, "v", "a gvector", v);
    const double *d = vs_as_flat(v)->at;
    sum = vs_v3_add(sum, vs_v3(d[0], d[1], d[2]));
  }
  return vs_bind_give_vector(f, sum, out);
}

vs_status vs_p_v_over_r(vs_args *f, vs_value *out) {
  if (X(1) == 0) return vs_bind_refuse(f, "r", "other than 0", f->arg[1].value);
  return vs_bind_give_vector(f, vs_v3(P(0).x / X(1), P(0).y / X(1), P(0).z / X(1)), out);
}

static vs_vec3 unit(vs_vec3 v) { /* returns the unit vector along v; first scales v, so that its length neither
                                  * overflows nor underflows */
  double most = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
  v = vs_v3(v.x / most, v.y / most, v.z / most);
  double l = vs_v3_length(v);
  return vs_v3(v.x / l, v.y / l, v.z / l);
}
vs_status vs_p_unitize(vs_args *f, vs_value *out) { return vs_bind_give_vector(f, unit(P(0)), out); }
vs_status vs_p_angle_between(vs_args *f, vs_value *out) {
  vs_vec3 a = unit(P(0)), b = unit(P(1));
  return vs_bind_give_real(f, atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)), out);
}
vs_status vs_p_v_project(vs_args *f, vs_value *out) {
  vs_vec3 b = unit(P(1));
  return vs_bind_give_vector(f, vs_v3_scale(b, vs_v3_dot(P(0), b)), out);
}
vs_status vs_p_distance(vs_args *f, vs_value *out) {
  vs_vec3 d = vs_v3_sub(P(1), P(0));
  return vs_bind_give_real(f, vs_flat_length(d.x, d.y, d.z), out);
}
static vs_vec3 between(vs_vec3 p, vs_vec3 q, double t) {
  return t == 1 ? q : vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), t));
}
vs_status vs_p_mid(vs_args *f, vs_value *out) { return vs_bind_give_point(f, between(P(0), P(1), .5), out); }
vs_status vs_p_intermediate_point(vs_args *f, vs_value *out) {
  return vs_bind_give_point(f, between(P(0), P(1), X(2)), out);
}

/* Sets *out to whether two values of one kind are equal within a tolerance. Numbers, axes, planes and matrices are
 * compared by the largest difference of their numbers, points and gvectors by their distance. */
vs_status vs_p_near(vs_args *f, vs_value *out) {
  double tolerance = f->arg[2].given ? X(2) : 1e-9, apart = 0;
  vs_value a = f->arg[0].value, b = f->arg[1].value;
  bool flat = vs_is(a, VS_T_FLAT);
  if (flat != vs_is(b, VS_T_FLAT) || (flat && vs_as_flat(a)->h.flags != vs_as_flat(b)->h.flags))
    return *out = VS_FALSE, VS_OK;
  if (!flat) return *out = vs_bool(X(0) == X(1) || fabs(X(0) - X(1)) <= tolerance), VS_OK;
  const double *p = vs_as_flat(a)->at, *q = vs_as_flat(b)->at;
  if (vs_is_flat(a, VS_FLAT_POINT) || vs_is_flat(a, VS_FLAT_VECTOR))
    apart = hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
  else for (size_t i = 0; i < (vs_is_flat(a, VS_FLAT_MATRIX) ? 16 : 6); i++) apart = fmax(apart, fabs(p[i] - q[i]));
  return *out = vs_bool(apart <= tolerance), VS_OK;
}

static vs_status is_tag(vs_args *f, uint32_t tag, vs_value *out) {
  *out = vs_bool(vs_is_flat(f->arg[0].value, tag));
  return VS_OK;
}
vs_status vs_p_is_point(vs_args *f, vs_value *out) { return is_tag(f, VS_FLAT_POINT, out); }
vs_status vs_p_is_vector(vs_args *f, vs_value *out) { return is_tag(f, VS_FLAT_VECTOR, out); }
vs_status vs_p_is_axis(vs_args *f, vs_value *out) { return is_tag(f, VS_FLAT_AXIS, out); }
vs_status vs_p_is_plane(vs_args *f, vs_value *out) { return is_tag(f, VS_FLAT_PLANE, out); }
vs_status vs_p_is_matrix(vs_args *f, vs_value *out) { return is_tag(f, VS_FLAT_MATRIX, out); }

vs_status vs_p_degrees_radians(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, X(0) / 180 * 3.14159265358979323846, out);
}
vs_status vs_p_radians_degrees(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, X(0) / 3.14159265358979323846 * 180, out);
}

/* ---- axes, planes and matrices ---- */

static vs_status line_value(vs_args *f, uint32_t tag, vs_vec3 at, vs_vec3 d, vs_value *out) {
  return vs_make_flat(f->vm, tag, (const double[]){ at.x, at.y, at.z, d.x, d.y, d.z }, 6, out);
}

vs_status vs_p_make_axis(vs_args *f, vs_value *out) {
  return line_value(f, VS_FLAT_AXIS, f->arg[0].point, f->arg[1].point, out);
}

vs_status vs_p_make_plane(vs_args *f, vs_value *out) {
  if (f->form == 0) return line_value(f, VS_FLAT_PLANE, f->arg[0].point, f->arg[1].point, out);
  vs_vec3 p = f->arg[0].point, a = vs_v3_sub(f->arg[1].point, p), b = vs_v3_sub(f->arg[2].point, p),
          n = vs_v3_cross(a, b);
  double l = vs_v3_length(n);
  if (!(l > 1e-14 * vs_v3_length(a) * vs_v3_length(b)))
    return vs_fail(f->vm, f->vm->sym.range, "the three points are on one line: they give no plane");
  return line_value(f, VS_FLAT_PLANE, p, vs_v3(n.x / l, n.y / l, n.z / l), out);
}

vs_status vs_p_make_matrix(vs_args *f, vs_value *out) {
  double d[16];
  for (int i = 0; i < 16; i++) d[i] = f->arg[i].real;
  if (d[12] != 0 || d[13] != 0 || d[14] != 0 || d[15] != 1)
    return vs_fail(f->vm, f->vm->sym.range,
                   "the last row must be 0 0 0 1: the matrix moves, turns, scales or shears, and nothing else");
  return vs_make_flat(f->vm, VS_FLAT_MATRIX, d, 16, out);
}

vs_status vs_p_translation_matrix(vs_args *f, vs_value *out) {
  vs_affine m = vs_affine_translation(f->arg[0].point);
  return vs_bind_give_matrix(f, &m, out);
}
vs_status vs_p_rotation_matrix(vs_args *f, vs_value *out) {
  vs_affine m = vs_affine_rotation(f->arg[0].line.at, f->arg[0].line.direction, f->arg[1].real);
  return vs_bind_give_matrix(f, &m, out);
}
vs_status vs_p_scaling_matrix(vs_args *f, vs_value *out) {
  double k = f->arg[0].real;
  vs_affine m =
      vs_affine_scaling(vs_v3(0, 0, 0), f->form == 0 ? vs_v3(k, k, k) : vs_v3(k, f->arg[1].real, f->arg[2].real));
  return vs_bind_give_matrix(f, &m, out);
}

vs_status vs_p_matrix_times(vs_args *f, vs_value *out) {
  vs_affine m = f->arg[0].matrix;
  for (size_t i = 0; i < f->arg[1].values.count; i++) {
    vs_value v = f->arg[1].values.at[i];
    if (!vs_is_flat(v, VS_FLAT_MATRIX)) return vs_bind_refuse(f, "b", "a matrix", v);
    vs_affine b = vs_bind_take_matrix(vs_as_flat(v)->at);
    m = vs_affine_multiply(&m, &b);
  }
  return vs_bind_give_matrix(f, &m, out);
}

vs_status vs_p_matrix_inverse(vs_args *f, vs_value *out) {
  vs_affine m = f->arg[0].matrix, inverse;
  if (!vs_affine_invert(&m, &inverse))
    return vs_bind_refuse(f, "m", "a matrix that does not flatten space", f->arg[0].value);
  return vs_bind_give_matrix(f, &inverse, out);
}

/* ---- sequences; those with a procedure as argument are in geometry.scm ---- */

/* Sets *out to a list of n values, which make(f, i) creates for i from n - 1 down to 0. */
static vs_status listed(vs_args *f, int64_t n, vs_status (*make)(vs_args *, int64_t i, vs_value *out),
                        vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (int64_t i = n; i-- > 0;) {
    vs_status s = vs_poll(f->vm, 1) && make(f, i, &r[1]) && vs_cons(f->vm, r[1], r[0], &r[0]);
    if (!s) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

/* Sets *out to a + (b - a) i / n, where a and b are the first two arguments. The result is exact if a and b are exact,
 * so that (enumerate 0 4 4) is (0 1 2 3). */
static vs_status part(vs_args *f, int64_t i, int64_t n, vs_value *out) {
  vs_value a = f->arg[0].value, b = f->arg[1].value;
  if (vs_is_fixnum(a) && vs_is_fixnum(b)) {
    VS_ROOTS(f->vm, r, 1);
    return vs_number_sub(f->vm, b, a, &r[0]) && vs_number_mul(f->vm, r[0], vs_fix(i), &r[0]) &&
           vs_number_div(f->vm, r[0], vs_fix(n), &r[0]) && vs_number_add(f->vm, a, r[0], out);
  }
  *out = vs_flonum(i == n ? X(1) : X(0) + (X(1) - X(0)) * ((double)i / (double)n));
  return VS_OK;
}
static vs_status by_count(vs_args *f, int64_t i, vs_value *out) { return part(f, i, f->arg[2].integer, out); }

vs_status vs_p_enumerate(vs_args *f, vs_value *out) { return listed(f, f->arg[2].integer, by_count, out); }
vs_status vs_p_division(vs_args *f, vs_value *out) {
  bool last = !f->arg[3].given || f->arg[3].boolean;
  return listed(f, f->arg[2].integer + last, by_count, out);
}

static vs_status on_line(vs_args *f, int64_t i, vs_value *out) {
  int64_t n = f->arg[2].integer;
  vs_vec3 p = f->arg[0].point, q = f->arg[1].point;
  if (i == n - 1 && n > 1) return vs_bind_give_point(f, q, out);
  double t = n > 1 ? (double)i / (double)(n - 1) : 0;
  return vs_bind_give_point(f, vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), t)), out);
}
vs_status vs_p_line_sequence(vs_args *f, vs_value *out) { return listed(f, f->arg[2].integer, on_line, out); }

/* Sets *out to the point at horizontal distance h and height v from the first argument, in the vertical plane at the
 * azimuth phi. */
static vs_status raised(vs_args *f, double h, double v, vs_value *out) {
  double s, c;
  vs_vec3 p = f->arg[0].point;
  vs_sincos(X(2), &s, &c);
  return vs_bind_give_point(f, vs_v3(p.x + h * c, p.y + h * s, p.z + v), out);
}
static double fraction(int64_t i, int64_t n) { return n > 1 ? (double)i / (double)(n - 1) : 0; }

/* Sets *out to point i of an arc. psi is the zenith angle, as in sph: at psi = 0 the point is above the centre, at pi/2
 * at the height of the centre. */
static vs_status on_arc(vs_args *f, int64_t i, vs_value *out) {
  double s, c, t = fraction(i, f->arg[5].integer), psi = t == 1 ? X(4) : X(3) + (X(4) - X(3)) * t;
  vs_sincos(psi, &s, &c);
  return raised(f, X(1) * s, X(1) * c, out);
}
vs_status vs_p_arc_sequence(vs_args *f, vs_value *out) { return listed(f, f->arg[5].integer, on_arc, out); }

/* Sets *out to point i of an arc that is divided into equal horizontal steps, that is, equal steps of the zenith
 * angle's sine. The zenith angle is the inverse sine in the half turn [(k - 1/2) pi, (k + 1/2) pi] that contains both
 * ends of the arc. If no half turn contains both ends, the arc has points above each other. The sign of the cosine is
 * then that at the middle of the arc. */
static vs_status on_arc_horizontally(vs_args *f, int64_t i, vs_value *out) {
  double s0, c0, s1, c1, sm, cm, t = fraction(i, f->arg[5].integer);
  vs_sincos(X(3), &s0, &c0), vs_sincos(X(4), &s1, &c1), vs_sincos((X(3) + X(4)) / 2, &sm, &cm);
  if (t == 0) return raised(f, X(1) * s0, X(1) * c0, out);
  if (t == 1) return raised(f, X(1) * s1, X(1) * c1, out);
  double s = s0 + (s1 - s0) * t, c = sqrt(fmax(0, (1 - s) * (1 + s)));
  return raised(f, X(1) * s, X(1) * (cm < 0 ? -c : c), out);
}
vs_status vs_p_linear_h_arc_sequence(vs_args *f, vs_value *out) {
  return listed(f, f->arg[5].integer, on_arc_horizontally, out);
}

vs_status vs_p_arc_height(vs_args *f, vs_value *out) {
  double sa, ca, sb, cb;
  vs_sincos(X(1), &sa, &ca), vs_sincos(X(2), &sb, &cb);
  return vs_bind_give_real(f, X(0) * fabs(cb - ca), out);
}
vs_status vs_p_arc_width(vs_args *f, vs_value *out) {
  double sa, ca, sb, cb;
  vs_sincos(X(1), &sa, &ca), vs_sincos(X(2), &sb, &cb);
  return vs_bind_give_real(f, X(0) * fabs(sb - sa), out);
}
