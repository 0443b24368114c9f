/* Owns the operators of corners and of triangles: prism and round corner, triangulate, subdivide. */
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/rules/derivation.h"

#include "bind/state.h"
#include "geometry/plane/ear_clipping.h"

static vs_vec3 at_angle(const vs_scope *s, double x, double angle, int j) {
  double sine, cosine;
  vs_sincos(angle, &sine, &cosine);
  return vs_affine_point(&s->as.box.frame, vs_v3(x * cosine, j * s->as.box.size.y, x * sine));
}

/* The front rectangle of a box with its edge at x-max moved out along z: half of a corner of that angle. A corner that
 * turns inwards, or not at all, has nothing to fill. */
vs_status vs_p_scope_prism(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(BOX))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  double angle = f->arg[1].real, half, cosine;
  r[0] = f->arg[2].value;
  if (!(angle < 3.14159)) return vs_bind_refuse(f, "angle", "under pi", f->arg[1].value);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  *out = r[1];
  t->rules[0] = r[0];
  if (angle <= 0 || s->as.box.size.x <= 0) return vs_task_push(d, t) ? VS_OK : VS_ERROR;
  vs_sincos(angle / 2, &half, &cosine);
  vs_scope *c = t->child[0] = vs_rules_child(d, s, VS_SCOPE_FFD, "prism", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_vec3 size = s->as.box.size;
  for (int i = 0; i < 8; i++) {
    int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    vs_vec3 p = vs_v3(x * size.x, y * size.y, x && z ? size.x * half / cosine : 0);
    c->as.corner[i] = vs_affine_point(&s->as.box.frame, p);
  }
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* The front rectangle turned about its y edge at x = 0, from x towards z: wedges of about approx each. */
vs_status vs_p_scope_round_corner(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(BOX))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  double angle = f->arg[1].real, approx = f->arg[2].real, x = s->as.box.size.x;
  r[0] = f->arg[3].value;
  if (!(approx > 0)) return vs_bind_refuse(f, "approx", "positive", f->arg[2].value);
  if (!(angle <= 6.2831853072)) return vs_bind_refuse(f, "angle", "at most a turn", f->arg[1].value);
  double parts = fmax(1, floor(angle / approx + .5));
  if (parts > 10000)
    return vs_bind_refuse(f, "approx", "larger: there would be more than 10000 wedges", f->arg[2].value);
  uint32_t n = angle > 0 && x > 0 ? (uint32_t)parts : 0;
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, n, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  for (uint32_t i = 0; i < n; i++) {
    vs_scope *c = t->child[i] = vs_rules_child(d, s, VS_SCOPE_FFD, "round-corner", i, n);
    if (!c) return vs_task_drop(d, t), VS_ERROR;
    for (int k = 0; k < 8; k++)
      c->as.corner[k] = at_angle(s, k & 1 ? x : 0, angle * (i + (uint32_t)(k >> 2)) / n, k >> 1 & 1);
  }
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* A triangle scope of three points as child i of n. False: the error is set. */
static bool add_triangle(vs_derivation *d, vs_rule_task *t, vs_scope *parent, const char *op, uint32_t i,
                         const vs_vec3 p[3]) {
  vs_scope *c = t->child[i] = vs_rules_child(d, parent, VS_SCOPE_TRIANGLE, op, i, t->count);
  if (!c) return false;
  c->loops = vs_scope_loops_new(c->store, p, (const uint32_t[]){ 0, 3 }, 1);
  if (!c->loops) return vs_fail_memory(d->bind->vm);
  if (!vs_scope_frame_loops(c)) vs_scope_release(c), t->child[i] = NULL;
  return true;
}

vs_status vs_p_scope_triangulate(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  const vs_scope_loops *l = s->loops;
  vs_affine back;
  vs_mesh m = { 0 };
  r[0] = f->arg[1].value;
  vs_vec2 *flat = vs_bind_scratch(f, l->points->count * sizeof *flat);
  size_t *sizes = flat ? vs_bind_scratch(f, l->count * sizeof *sizes) : NULL;
  uint32_t *index = sizes ? vs_bind_scratch(f, l->points->count * sizeof *index) : NULL;
  if (!index) return VS_ERROR;
  vs_affine_invert(&s->as.box.frame, &back);
  for (uint32_t i = 0; i < l->points->count; i++) {
    vs_vec3 p = vs_affine_point(&back, l->points->at[i]);
    flat[i] = (vs_vec2){ p.x, p.y }, index[i] = i;
  }
  for (uint32_t i = 0; i < l->count; i++) sizes[i] = l->start[i + 1] - l->start[i];
  if (!vs_triangulate(flat, sizes, l->count, &m, index, false)) return vs_mesh_free(&m), vs_fail_memory(f->vm);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, (uint32_t)m.triangle_count, false) : NULL;
  if (t) t->rules[0] = r[0];
  for (uint32_t i = 0; t && i < m.triangle_count; i++) {
    vs_vec3 p[3];
    for (int k = 0; k < 3; k++) p[k] = l->points->at[m.triangles[i][k]];
    if (!add_triangle(d, t, s, "triangulate", i, p)) vs_task_drop(d, t), t = NULL;
  }
  vs_mesh_free(&m);
  *out = r[1];
  return t && vs_task_push(d, t) ? VS_OK : VS_ERROR;
}

/* A triangle becomes four by the middles of its edges: the corners' first, the middle one last. */
vs_status vs_p_scope_subdivide(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  vs_scope *s = f->arg[0].scope;
  const vs_vec3 *p = s->loops->points->at;
  r[0] = f->arg[1].value;
  vs_vec3 m[3];
  for (int i = 0; i < 3; i++) m[i] = vs_v3_scale(vs_v3_add(p[i], p[(i + 1) % 3]), .5);
  const vs_vec3 all[4][3] = { { p[0], m[0], m[2] }, { m[0], p[1], m[1] }, { m[2], m[1], p[2] }, { m[0], m[1], m[2] } };
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 4, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  for (uint32_t i = 0; i < 4; i++)
    if (!add_triangle(d, t, s, "subdivide", i, all[i])) return vs_task_drop(d, t), VS_ERROR;
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
