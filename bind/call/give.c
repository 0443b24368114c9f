/* Creates the values of points, gvectors, numbers and matrices (give.h). */
#include "bind/call/give.h"

#include <string.h>

#include "bind/call/positional.h"
#include "bind/records.h"
#include "vm/values/heap.h"

vs_status vs_bind_give_point(vs_args *f, vs_vec3 p, vs_value *out) {
  return vs_make_flat(vs_call_vm(f), VS_FLAT_POINT, (const double[]){ p.x, p.y, p.z }, 3, out);
}
vs_status vs_bind_give_vector(vs_args *f, vs_vec3 p, vs_value *out) {
  return vs_make_flat(vs_call_vm(f), VS_FLAT_VECTOR, (const double[]){ p.x, p.y, p.z }, 3, out);
}
vs_status vs_bind_give_real(vs_args *f, double d, vs_value *out) {
  (void)f;
  *out = vs_flonum(d);
  return VS_OK;
}

vs_status vs_bind_give_matrix(vs_args *f, const vs_affine *m, vs_value *out) {
  double d[16] = { 0 };
  memcpy(d, m->m, 12 * sizeof *d);
  d[15] = 1;
  return vs_make_flat(vs_call_vm(f), VS_FLAT_MATRIX, d, 16, out);
}
vs_affine vs_bind_take_matrix(const double *sixteen) {
  vs_affine m;
  memcpy(m.m, sixteen, 12 * sizeof *sixteen);
  return m;
}
