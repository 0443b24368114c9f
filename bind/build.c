/* Owns the small steps that every procedure of the geometry ends with: make a value, make a node, give the empty object. */
#include "bind/bind.h"

vs_status vs_bind_point(vs_frame *f, vs_vec3 p, vs_value *out) { return vs_make_flat(f->vm, VS_FLAT_POINT, (const double[]){ p.x, p.y, p.z }, 3, out); }
vs_status vs_bind_vector(vs_frame *f, vs_vec3 p, vs_value *out) { return vs_make_flat(f->vm, VS_FLAT_VECTOR, (const double[]){ p.x, p.y, p.z }, 3, out); }
vs_status vs_bind_real(vs_frame *f, double d, vs_value *out) {
  (void)f;
  *out = vs_flonum(d);
  return VS_OK;
}

vs_status vs_bind_matrix(vs_frame *f, const vs_affine *m, vs_value *out) {
  double d[16] = { 0 };
  memcpy(d, m->m, 12 * sizeof *d);
  d[15] = 1;
  return vs_make_flat(f->vm, VS_FLAT_MATRIX, d, 16, out);
}
vs_affine vs_bind_affine(const double *sixteen) {
  vs_affine m;
  memcpy(m.m, sixteen, 12 * sizeof *sixteen);
  return m;
}

vs_status vs_bind_node(vs_frame *f, vs_node *node, vs_value *out) { return vs_bind_wrap(f->bind, node, out); }

vs_status vs_bind_make(vs_frame *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out) {
  return vs_bind_wrap(f->bind, vs_node_new(f->bind->store, kind, data, children, n), out);
}

vs_status vs_bind_empty(vs_frame *f, const char *why, vs_value *out) {
  if (why) {
    const char *name = vs_bind_defs[f->procedure - vs_bind_procedures].name;
    if (*name == '%') name++;
    vs_bind_warn(f->bind, why, "%.*s: %s: nothing is made (the empty object)", (int)strcspn(name, " "), name, why);
  }
  return vs_bind_make(f, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0, out);
}
