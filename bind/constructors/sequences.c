/* Owns the sequences of numbers and points: what fills a range, a line, an arc. (Those that take procedures are in
 * geometry.scm.) */

#include "bind/build.h"
#include "vm/numbers/number.h"

#define X(i) (f->arg[i].real)

/* A list of n values by make(f, i), built from the end so that it is in order. */
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

/* a + (b - a) i / n; exact where a and b are, so that (enumerate 0 4 4) is (0 1 2 3) */
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
  if (i == n - 1 && n > 1) return vs_bind_point(f, q, out);
  double t = n > 1 ? (double)i / (double)(n - 1) : 0;
  return vs_bind_point(f, vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), t)), out);
}
vs_status vs_p_line_sequence(vs_args *f, vs_value *out) { return listed(f, f->arg[2].integer, on_line, out); }

/* the point at horizontal distance h and height v from p, in the vertical plane at azimuth phi */
static vs_status raised(vs_args *f, double h, double v, vs_value *out) {
  double s, c;
  vs_vec3 p = f->arg[0].point;
  vs_sincos(X(2), &s, &c);
  return vs_bind_point(f, vs_v3(p.x + h * c, p.y + h * s, p.z + v), out);
}
static double fraction(int64_t i, int64_t n) { return n > 1 ? (double)i / (double)(n - 1) : 0; }

/* In all of these psi is the zenith angle, as in sph: 0 is above the centre, pi/2 level with it. */
static vs_status on_arc(vs_args *f, int64_t i, vs_value *out) {
  double s, c, t = fraction(i, f->arg[5].integer), psi = t == 1 ? X(4) : X(3) + (X(4) - X(3)) * t;
  vs_sincos(psi, &s, &c);
  return raised(f, X(1) * s, X(1) * c, out);
}
vs_status vs_p_arc_sequence(vs_args *f, vs_value *out) { return listed(f, f->arg[5].integer, on_arc, out); }

/* Equal steps of the sine. Its inverse is the zenith angle in the half turn [(k - 1/2) pi, (k + 1/2) pi] that both ends
 * lie in; elsewhere two points of the arc are above each other and the height would be ambiguous: there the cosine
 * takes the sign of the middle of the arc. */
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
  return vs_bind_real(f, X(0) * fabs(cb - ca), out);
}
vs_status vs_p_arc_width(vs_args *f, vs_value *out) {
  double sa, ca, sb, cb;
  vs_sincos(X(1), &sa, &ca), vs_sincos(X(2), &sb, &cb);
  return vs_bind_real(f, X(0) * fabs(sb - sa), out);
}
