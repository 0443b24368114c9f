/* Implements frames: placement on an axis, the smallest rotation between two directions, and rotation-minimizing frames
 * along a path. */
#include "geometry/frame.h"

vs_affine vs_frame_on_axis(vs_vec3 at, vs_vec3 direction) {
  vs_vec3 d = vs_v3_unit(direction);
  double across = d.x * d.x + d.y * d.y, k; /* k: 1 / (1 + d.z); near d = -Z, a form without cancellation is used */
  vs_vec3 x, y;
  VS_ASSERT(direction.x != 0 || direction.y != 0 || direction.z != 0);
  if (d.z < 0 && across < 1e-24) { /* if d is -Z within rounding errors, the rotation is half a turn about X */
    x = vs_v3(1, 0, 0);
    y = vs_v3(0, -1, 0);
  } else {
    k = d.z < 0 ? (1 - d.z) / across : 1 / (1 + d.z);
    x = vs_v3(1 - d.x * d.x * k, -d.x * d.y * k, -d.x);
    y = vs_v3(-d.x * d.y * k, 1 - d.y * d.y * k, -d.y);
  }
  return (vs_affine){ { { x.x + 0.0, y.x + 0.0, d.x + 0.0, at.x },
                        { x.y + 0.0, y.y + 0.0, d.y + 0.0, at.y },
                        { x.z + 0.0, y.z + 0.0, d.z + 0.0, at.z } } };
}

/* Returns a unit vector perpendicular to the unit vector a. */
static vs_vec3 frame_across(vs_vec3 a) {
  vs_vec3 least = fabs(a.x) <= fabs(a.y) && fabs(a.x) <= fabs(a.z) ? vs_v3(1, 0, 0)
                  : fabs(a.y) <= fabs(a.z)                         ? vs_v3(0, 1, 0)
                                                                   : vs_v3(0, 0, 1);
  return vs_v3_unit(vs_v3_cross(a, least));
}

vs_affine vs_frame_turn(vs_vec3 a, vs_vec3 b) {
  vs_vec3 v = vs_v3_cross(a, b);
  double c = vs_v3_dot(a, b), s2 = vs_v3_dot(v, v), k;
  VS_ASSERT(fabs(vs_v3_dot(a, a) - 1) < 1e-6 && fabs(vs_v3_dot(b, b) - 1) < 1e-6);
  if (c < 0 && s2 < 1e-24) return vs_affine_rotation(vs_v3(0, 0, 0), frame_across(a), 3.14159265358979323846);
  k = c < 0 ? (1 - c) / s2 : 1 / (1 + c);
  return (vs_affine){ { { c + v.x * v.x * k, v.x * v.y * k - v.z, v.x * v.z * k + v.y, 0 },
                        { v.x * v.y * k + v.z, c + v.y * v.y * k, v.y * v.z * k - v.x, 0 },
                        { v.x * v.z * k - v.y, v.y * v.z * k + v.x, c + v.z * v.z * k, 0 } } };
}

/* Moves the vector x from point p with tangent t to point q with tangent u, and returns it. First reflects x in the
 * bisecting plane of p and q, then in the plane that maps the reflected t to u. */
static vs_vec3 frame_reflect_twice(vs_vec3 p, vs_vec3 t, vs_vec3 q, vs_vec3 u, vs_vec3 x) {
  vs_vec3 v = vs_v3_sub(q, p);
  double c = vs_v3_dot(v, v), large = fmax(vs_v3_dot(p, p), vs_v3_dot(q, q));
  if (!(c > 1e-24 * large)) {
    vs_affine turn = vs_frame_turn(t, u);
    return vs_affine_vector(&turn, x);
  }
  vs_vec3 xl = vs_v3_sub(x, vs_v3_scale(v, 2 / c * vs_v3_dot(v, x))),
          tl = vs_v3_sub(t, vs_v3_scale(v, 2 / c * vs_v3_dot(v, t)));
  vs_vec3 w = vs_v3_sub(u, tl);
  c = vs_v3_dot(w, w);
  return c > 0 ? vs_v3_sub(xl, vs_v3_scale(w, 2 / c * vs_v3_dot(w, xl))) : xl;
}

/* Returns the direction x, made perpendicular to the tangent t and of length 1 again, so that errors do not accumulate
 * along a path. */
static vs_vec3 frame_square(vs_vec3 x, vs_vec3 t) {
  vs_vec3 r = vs_v3_sub(x, vs_v3_scale(t, vs_v3_dot(x, t)));
  return vs_v3_length(r) > 1e-9 ? vs_v3_unit(r) : frame_across(t);
}

static vs_vec3 frame_carry(const vs_path_point *from, const vs_path_point *to, vs_vec3 x) {
  x = frame_reflect_twice(from->at, from->leaving, to->at, to->arriving, x);
  vs_affine corner = vs_frame_turn(to->arriving, to->leaving);
  return frame_square(vs_affine_vector(&corner, x), to->leaving);
}

double vs_frame_transport(const vs_path_point *path, size_t n, bool closed, double length, vs_vec3 x, vs_vec3 *x_out) {
  VS_ASSERT(n > 0);
  x_out[0] = frame_square(x, path[0].leaving);
  for (size_t i = 1; i < n; i++) x_out[i] = frame_carry(&path[i - 1], &path[i], x_out[i - 1]);
  if (!closed || !(length > 0)) return 0;
  vs_vec3 back = frame_carry(&path[n - 1], &path[0], x_out[n - 1]), y = vs_v3_cross(path[0].leaving, x_out[0]);
  double spin = atan2(vs_v3_dot(back, y), vs_v3_dot(back, x_out[0]));
  for (size_t i = 1; i < n; i++) {
    double s, c;
    vs_sincos(-spin * path[i].along / length, &s, &c);
    x_out[i] = vs_v3_add(vs_v3_scale(x_out[i], c), vs_v3_scale(vs_v3_cross(path[i].leaving, x_out[i]), s));
  }
  return spin;
}

vs_vec3 vs_plane_up(vs_vec3 normal) {
  vs_vec3 n = vs_v3_unit(normal);
  if (n.z < -1e-9 || (fabs(n.z) <= 1e-9 && (n.y < -1e-9 || (fabs(n.y) <= 1e-9 && n.x < 0)))) n = vs_v3_scale(n, -1);
  return vs_v3(n.x + 0.0, n.y + 0.0, n.z + 0.0);
}
