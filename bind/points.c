/* Owns points and gvectors as the language makes, takes apart and combines them (LANGUAGE: points and vectors). */
#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/records.h"

#define X(i) (f->arg[i].real)
#define P(i) (f->arg[i].point)

static vs_vec3 polar(double rho, double phi, double z) {
  double s, c;
  vs_sincos(phi, &s, &c);
  return vs_v3(rho * c, rho * s, z);
}
static vs_vec3 spherical(double rho, double phi, double psi) { /* psi from +Z */
  double s, c;
  vs_sincos(psi, &s, &c);
  return polar(rho * s, phi, rho * c);
}
/* what stands in f's arguments from number i on, by the four systems */
static vs_vec3 cartesian_at(const vs_args *f, int i) { return vs_v3(X(i), X(i + 1), X(i + 2)); }
static vs_vec3 polar_at(const vs_args *f, int i) { return polar(X(i), X(i + 1), 0); }
static vs_vec3 cylindrical_at(const vs_args *f, int i) { return polar(X(i), X(i + 1), X(i + 2)); }
static vs_vec3 spherical_at(const vs_args *f, int i) { return spherical(X(i), X(i + 1), X(i + 2)); }

/* ---- points ---- */
vs_status vs_p_xyz(vs_args *f, vs_value *out) { return vs_bind_point(f, cartesian_at(f, 0), out); }
vs_status vs_p_xy(vs_args *f, vs_value *out) { return vs_bind_point(f, vs_v3(X(0), X(1), 0), out); }
vs_status vs_p_xz(vs_args *f, vs_value *out) { return vs_bind_point(f, vs_v3(X(0), 0, X(1)), out); }
vs_status vs_p_yz(vs_args *f, vs_value *out) { return vs_bind_point(f, vs_v3(0, X(0), X(1)), out); }
vs_status vs_p_pol(vs_args *f, vs_value *out) { return vs_bind_point(f, polar_at(f, 0), out); }
vs_status vs_p_cyl(vs_args *f, vs_value *out) { return vs_bind_point(f, cylindrical_at(f, 0), out); }
vs_status vs_p_sph(vs_args *f, vs_value *out) { return vs_bind_point(f, spherical_at(f, 0), out); }

static vs_status moved(vs_args *f, vs_vec3 by, vs_value *out) { return vs_bind_point(f, vs_v3_add(P(0), by), out); }
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

/* ---- selectors ---- */
vs_status vs_p_cx(vs_args *f, vs_value *out) { return vs_bind_real(f, P(0).x, out); }
vs_status vs_p_cy(vs_args *f, vs_value *out) { return vs_bind_real(f, P(0).y, out); }
vs_status vs_p_cz(vs_args *f, vs_value *out) { return vs_bind_real(f, P(0).z, out); }
vs_status vs_p_pol_rho(vs_args *f, vs_value *out) { return vs_bind_real(f, hypot(P(0).x, P(0).y), out); }
vs_status vs_p_pol_phi(vs_args *f, vs_value *out) { return vs_bind_real(f, atan2(P(0).y, P(0).x), out); }
vs_status vs_p_sph_psi(vs_args *f, vs_value *out) {
  return vs_bind_real(f, atan2(hypot(P(0).x, P(0).y), P(0).z), out);
}
vs_status vs_p_length(vs_args *f, vs_value *out) {
  return vs_bind_real(f, vs_flat_length(P(0).x, P(0).y, P(0).z), out);
}

/* ---- gvectors ---- */
vs_status vs_p_vxyz(vs_args *f, vs_value *out) { return vs_bind_vector(f, cartesian_at(f, 0), out); }
vs_status vs_p_vpol(vs_args *f, vs_value *out) { return vs_bind_vector(f, polar_at(f, 0), out); }
vs_status vs_p_vcyl(vs_args *f, vs_value *out) { return vs_bind_vector(f, cylindrical_at(f, 0), out); }
vs_status vs_p_vsph(vs_args *f, vs_value *out) { return vs_bind_vector(f, spherical_at(f, 0), out); }
vs_status vs_p_p_to_q(vs_args *f, vs_value *out) { return vs_bind_vector(f, vs_v3_sub(P(1), P(0)), out); }
vs_status vs_p_p_plus_v(vs_args *f, vs_value *out) { return vs_bind_point(f, vs_v3_add(P(0), P(1)), out); }
vs_status vs_p_p_minus_v(vs_args *f, vs_value *out) { return vs_bind_point(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_p_minus_p(vs_args *f, vs_value *out) { return vs_bind_vector(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_v_minus_v(vs_args *f, vs_value *out) { return vs_bind_vector(f, vs_v3_sub(P(0), P(1)), out); }
vs_status vs_p_v_times_r(vs_args *f, vs_value *out) { return vs_bind_vector(f, vs_v3_scale(P(0), X(1)), out); }
vs_status vs_p_dot(vs_args *f, vs_value *out) { return vs_bind_real(f, vs_v3_dot(P(0), P(1)), out); }
vs_status vs_p_cross(vs_args *f, vs_value *out) { return vs_bind_vector(f, vs_v3_cross(P(0), P(1)), out); }

vs_status vs_p_v_plus_v(vs_args *f, vs_value *out) {
  vs_vec3 sum = { 0, 0, 0 };
  for (size_t i = 0; i < f->arg[0].values.count; i++) {
    vs_value v = f->arg[0].values.at[i];
    if (!vs_is_flat(v, VS_FLAT_VECTOR)) return vs_bind_refuse(f, "v", "a gvector", v);
    const double *d = vs_as_flat(v)->at;
    sum = vs_v3_add(sum, vs_v3(d[0], d[1], d[2]));
  }
  return vs_bind_vector(f, sum, out);
}

vs_status vs_p_v_over_r(vs_args *f, vs_value *out) {
  if (X(1) == 0) return vs_bind_refuse(f, "r", "other than 0", f->arg[1].value);
  return vs_bind_vector(f, vs_v3(P(0).x / X(1), P(0).y / X(1), P(0).z / X(1)), out);
}

static vs_vec3 unit(vs_vec3 v) { /* scaled first: no overflow, no underflow */
  double most = fmax(fabs(v.x), fmax(fabs(v.y), fabs(v.z)));
  v = vs_v3(v.x / most, v.y / most, v.z / most);
  double l = vs_v3_length(v);
  return vs_v3(v.x / l, v.y / l, v.z / l);
}
vs_status vs_p_unitize(vs_args *f, vs_value *out) { return vs_bind_vector(f, unit(P(0)), out); }
vs_status vs_p_angle_between(vs_args *f, vs_value *out) {
  vs_vec3 a = unit(P(0)), b = unit(P(1));
  return vs_bind_real(f, atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)), out);
}
vs_status vs_p_v_project(vs_args *f, vs_value *out) {
  vs_vec3 b = unit(P(1));
  return vs_bind_vector(f, vs_v3_scale(b, vs_v3_dot(P(0), b)), out);
}
vs_status vs_p_distance(vs_args *f, vs_value *out) {
  vs_vec3 d = vs_v3_sub(P(1), P(0));
  return vs_bind_real(f, vs_flat_length(d.x, d.y, d.z), out);
}
static vs_vec3 between(vs_vec3 p, vs_vec3 q, double t) {
  return t == 1 ? q : vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), t));
}
vs_status vs_p_mid(vs_args *f, vs_value *out) { return vs_bind_point(f, between(P(0), P(1), .5), out); }
vs_status vs_p_intermediate_point(vs_args *f, vs_value *out) {
  return vs_bind_point(f, between(P(0), P(1), X(2)), out);
}

/* Two numbers, or two of a kind: numbers, axes, planes and matrices by their largest difference, points and gvectors by
 * how far they are apart */
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
  return vs_bind_real(f, X(0) / 180 * 3.14159265358979323846, out);
}
vs_status vs_p_radians_degrees(vs_args *f, vs_value *out) {
  return vs_bind_real(f, X(0) / 3.14159265358979323846 * 180, out);
}
