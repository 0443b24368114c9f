/* Owns axes, planes and matrices as values of the language. */
#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/records.h"
#include "vm/values/heap.h"

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
  return vs_bind_matrix(f, &m, out);
}
vs_status vs_p_rotation_matrix(vs_args *f, vs_value *out) {
  vs_affine m = vs_affine_rotation(f->arg[0].line.at, f->arg[0].line.direction, f->arg[1].real);
  return vs_bind_matrix(f, &m, out);
}
vs_status vs_p_scaling_matrix(vs_args *f, vs_value *out) {
  double k = f->arg[0].real;
  vs_affine m =
      vs_affine_scaling(vs_v3(0, 0, 0), f->form == 0 ? vs_v3(k, k, k) : vs_v3(k, f->arg[1].real, f->arg[2].real));
  return vs_bind_matrix(f, &m, out);
}

vs_status vs_p_matrix_times(vs_args *f, vs_value *out) {
  vs_affine m = f->arg[0].matrix;
  for (size_t i = 0; i < f->arg[1].values.count; i++) {
    vs_value v = f->arg[1].values.at[i];
    if (!vs_is_flat(v, VS_FLAT_MATRIX)) return vs_bind_refuse(f, "b", "a matrix", v);
    vs_affine b = vs_bind_affine(vs_as_flat(v)->at);
    m = vs_affine_multiply(&m, &b);
  }
  return vs_bind_matrix(f, &m, out);
}

vs_status vs_p_matrix_inverse(vs_args *f, vs_value *out) {
  vs_affine m = f->arg[0].matrix, inverse;
  if (!vs_affine_invert(&m, &inverse))
    return vs_bind_refuse(f, "m", "a matrix that does not flatten space", f->arg[0].value);
  return vs_bind_matrix(f, &inverse, out);
}
