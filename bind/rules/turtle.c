/* Implements the turtle: a moving frame with a cross-section, which creates the hexahedra between two cross-sections.
 *
 * The columns of the turtle's frame are left (x), up (y) and ahead (z). A yaw rotates to the left, a pitch upwards, and
 * a roll to the right about the direction ahead, as an aircraft banks. */
#include "bind/call/positional.h"
#include "bind/rules/derivation.h"

#define TURTLE VS_SCOPE_BIT(TURTLE)

static vs_scope *changed(vs_args *f) {
  if (!vs_rules_class(f, 0, TURTLE)) return NULL;
  vs_scope *s = vs_scope_copy(vs_arg_scope(f, 0));
  if (!s) vs_fail_memory(vs_call_vm(f));
  return s;
}

static vs_affine *frame_of(vs_scope *s) { return &s->as.turtle.frame; }

vs_status vs_p_turtle_forward(vs_args *f, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  vs_affine *m = frame_of(s);
  for (int r = 0; r < 3; r++) m->m[r][3] += m->m[r][2] * vs_arg_real(f, 1);
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}

/* Rotates the turtle about an axis of its frame, through its position. */
static vs_status turned(vs_args *f, int axis, double angle, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  vs_affine *m = frame_of(s);
  vs_affine turn = vs_affine_rotation(vs_affine_column(m, 3), vs_affine_column(m, axis), angle);
  *m = vs_affine_multiply(&turn, m);
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}
vs_status vs_p_turtle_yaw(vs_args *f, vs_value *out) { return turned(f, 1, vs_arg_real(f, 1), out); }
vs_status vs_p_turtle_pitch(vs_args *f, vs_value *out) { return turned(f, 0, -vs_arg_real(f, 1), out); }
vs_status vs_p_turtle_roll(vs_args *f, vs_value *out) { return turned(f, 2, vs_arg_real(f, 1), out); }

vs_status vs_p_turtle_width(vs_args *f, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  s->as.turtle.width = vs_arg_real(f, 1);
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}
vs_status vs_p_turtle_height(vs_args *f, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  s->as.turtle.height = vs_arg_real(f, 1);
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}

/* Rotates the direction ahead towards the vector in the argument (tropism). The angle is the strength times the angle
 * between the two directions. */
vs_status vs_p_turtle_toward(vs_args *f, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  vs_affine *m = frame_of(s);
  vs_vec3 heading = vs_affine_column(m, 2), to = vs_v3_unit(vs_arg_point(f, 1)), axis = vs_v3_cross(heading, to);
  double angle = atan2(vs_v3_length(axis), vs_v3_dot(heading, to));
  if (vs_v3_length(axis) > 1e-12) {
    vs_affine turn = vs_affine_rotation(vs_affine_column(m, 3), axis, angle * vs_arg_real(f, 2));
    *m = vs_affine_multiply(&turn, m);
  }
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}

/* Makes the current cross-section the back face of the next hexahedron. */
vs_status vs_p_turtle_back(vs_args *f, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  for (int c = 0; c < 4; c++) s->as.turtle.back[c] = vs_scope_corner(s, c & 1, c >> 1, 1);
  s->backed = true;
  return vs_bind_give_scope(vs_call_vm(f), s, out);
}

/* Makes the current cross-section the front face of a hexahedron, and applies the rule to this hexahedron. */
vs_status vs_p_turtle_front(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2);
  if (!vs_rules_class(f, 0, TURTLE)) return VS_ERROR;
  vs_scope *s = vs_arg_scope(f, 0);
  r[0] = vs_arg_value(f, 1);
  if (!s->backed)
    return vs_fail(vm, vm->sym.error, "the turtle has no back yet: (turtle-back) sets it before it goes forward");
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  vs_scope *c = t->child[0] = vs_rules_child(d, s, VS_SCOPE_FFD, "front", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_scope_corners(s, c->as.corner);
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
