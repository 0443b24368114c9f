/* Implements operators that move, rotate or resize a scope. scope.h explains sizes, frames and paths. */
#include "bind/rules/move_scopes.h"

#include "bind/call/call.h"
#include "bind/call/refuse.h"
#include "bind/call/take.h"
#include "bind/rules/derivation.h"

#include <string.h>

/* Returns a copy of the scope in argument 0 with the same path: the operators of this file add no level to a path. If
 * it fails, sets the error and returns NULL. */
static vs_scope *changed(vs_args *f) {
  vs_scope *s = vs_scope_copy(f->arg[0].scope);
  if (!s) vs_fail_memory(f->vm);
  return s;
}

/* Applies the map m to the shape of the scope s, to which there is only one reference. Copies the loops of s first. */
static bool moved(vs_scope *s, const vs_affine *m) {
  if (s->class_ == VS_SCOPE_FFD) {
    for (int c = 0; c < 8; c++) s->as.corner[c] = vs_affine_point(m, s->as.corner[c]);
    return true;
  }
  if (s->class_ == VS_SCOPE_TURTLE) {
    s->as.turtle.frame = vs_affine_multiply(m, &s->as.turtle.frame);
    return true;
  }
  s->as.box.frame = vs_affine_multiply(m, &s->as.box.frame);
  if (s->object.node) {
    vs_node *n = vs_node_new(s->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = *m }, &s->object, 1);
    if (!n) return false;
    vs_node_release(s->object.node);
    s->object.node = n;
  }
  if (!s->loops) return true;
  const vs_scope_loops *old = s->loops;
  vs_scope_loops *l = vs_scope_loops_new(s->store, old->points->at, old->start, old->count);
  if (!l) return false;
  vs_vec3 *at = (vs_vec3 *)(uintptr_t)l->points->at; /* the copied loops belong only to s, and may be changed */
  for (uint32_t i = 0; i < l->points->count; i++) at[i] = vs_affine_point(m, at[i]);
  vs_scope_loops_release(s->store, s->loops);
  s->loops = l;
  return true;
}

/* If the columns of the frame are perpendicular, makes them unit vectors of a right-handed system, multiplies the size
 * by their lengths, and returns true. Otherwise returns false: the box has become a parallelepiped. */
static bool box_again(vs_affine *frame, vs_vec3 *size) {
  vs_vec3 c[3], at = vs_affine_column(frame, 3);
  double *extent[3] = { &size->x, &size->y, &size->z };
  for (int i = 0; i < 3; i++) {
    double k = vs_v3_length(c[i] = vs_affine_column(frame, i));
    *extent[i] *= k, c[i] = vs_v3_unit(c[i]);
  }
  for (int i = 0; i < 3; i++)
    if (fabs(vs_v3_dot(c[i], c[(i + 1) % 3])) > 1e-9) return false;
  if (vs_v3_dot(vs_v3_cross(c[0], c[1]), c[2]) < 0) /* if the map mirrors, the direction x is reversed and begins at the
                                                     * other end of the box */
    at = vs_v3_add(at, vs_v3_scale(c[0], size->x)), c[0] = vs_v3_scale(c[0], -1);
  *frame = vs_affine_columns(c[0], c[1], c[2], at);
  return true;
}

vs_scope *vs_scope_placed(const vs_scope *of, const vs_affine *m) {
  vs_scope *s = vs_scope_copy(of), *sheared;
  if (s && !moved(s, m)) vs_scope_release(s), s = NULL;
  if (!s || s->class_ == VS_SCOPE_FFD) return s;
  if (s->class_ == VS_SCOPE_TURTLE) {
    vs_vec3 size = { s->as.turtle.width, s->as.turtle.height, 0 };
    for (int c = 0; c < 4; c++) s->as.turtle.back[c] = vs_affine_point(m, of->as.turtle.back[c]);
    if (box_again(&s->as.turtle.frame, &size)) s->as.turtle.width = size.x, s->as.turtle.height = size.y;
    return s;
  }
  if (s->loops && s->class_ != VS_SCOPE_CURVE) {
    vs_scope_frame_loops(s);
    return s;
  }
  vs_affine frame = s->as.box.frame;
  vs_vec3 size = s->as.box.size;
  if (box_again(&frame, &size)) {
    s->as.box.frame = frame, s->as.box.size = size;
    return s;
  }
  if (s->class_ != VS_SCOPE_BOX || !(sheared = vs_scope_fresh(s->store, VS_SCOPE_FFD))) return s;
  /* The scope becomes one of class FFD, a hexahedron with the corners of the box. */
  vs_scope_corners(s, sheared->as.corner);
  vs_scope_take_path(sheared, s);
  vs_scope_release(s);
  return sheared;
}

static vs_status give_moved(vs_args *f, const vs_affine *m, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  if (!moved(s, m)) return vs_scope_release(s), vs_fail_memory(f->vm);
  return vs_bind_give_scope(f->vm, s, out);
}

vs_status vs_p_scope_move(vs_args *f, vs_value *out) {
  vs_affine frame = vs_scope_frame(f->arg[0].scope);
  vs_affine m = vs_affine_translation(vs_affine_vector(&frame, vs_v3(f->arg[1].real, f->arg[2].real, f->arg[3].real)));
  return give_moved(f, &m, out);
}

/* Renames the axes of a hexahedron by quarter turns about axis a; the hexahedron itself does not move. Let b and c be
 * the axes after a. For each quarter turn, the new b is the old c, and the new c is the reversed old b. */
static vs_status turn_hexahedron(vs_args *f, int a, int quarters, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  int b = (a + 1) % 3, c = (a + 2) % 3;
  for (; quarters > 0; quarters--) {
    vs_vec3 old[8];
    memcpy(old, s->as.corner, sizeof old);
    for (int i = 0; i < 8; i++) {
      int from[3] = { i & 1, i >> 1 & 1, i >> 2 }, to_b = from[b], to_c = from[c];
      from[b] = 1 - to_c, from[c] = to_b;
      s->as.corner[i] = old[from[0] + 2 * from[1] + 4 * from[2]];
    }
  }
  return vs_bind_give_scope(f->vm, s, out);
}

vs_status vs_p_scope_turn(vs_args *f, vs_value *out) {
  if (f->arg[0].scope->class_ == VS_SCOPE_FFD) {
    double quarters = f->arg[2].real / 1.5707963267948966, n = floor(quarters + .5);
    if (fabs(quarters - n) > 1e-9 || fabs(n) > 1000)
      return vs_bind_refuse(f, "angle", "a multiple of pi/2, for a hexahedron", f->arg[2].value);
    return turn_hexahedron(f, (int)f->arg[1].integer, (((int)n % 4) + 4) % 4, out);
  }
  vs_affine frame = vs_scope_frame(f->arg[0].scope);
  vs_affine m =
      vs_affine_rotation(vs_affine_column(&frame, 3), vs_affine_column(&frame, (int)f->arg[1].integer), f->arg[2].real);
  return give_moved(f, &m, out);
}

#define SIZED (VS_SCOPE_BIT(BOX) | VS_SCOPE_BIT(TURTLE))

/* Sets *out to a copy of the scope with these sizes along x, y and z; -1 keeps a size. The first corner of a box
 * remains fixed; the cross-section of a turtle grows from its middle. */
static vs_status give_sized(vs_args *f, vs_vec3 size, vs_value *out) {
  vs_scope *s = changed(f);
  if (!s) return VS_ERROR;
  bool turtle = s->class_ == VS_SCOPE_TURTLE;
  double *x = turtle ? &s->as.turtle.width : &s->as.box.size.x, *y = turtle ? &s->as.turtle.height : &s->as.box.size.y;
  if (size.x >= 0) *x = size.x;
  if (size.y >= 0) *y = size.y;
  if (size.z >= 0 && !turtle) s->as.box.size.z = size.z;
  return vs_bind_give_scope(f->vm, s, out);
}

vs_status vs_p_scope_size(vs_args *f, vs_value *out) {
  static const char *const names[] = { "dx", "dy", "dz" };
  double d[3];
  if (!vs_rules_class(f, 0, SIZED)) return VS_ERROR;
  for (int i = 0; i < 3; i++) {
    d[i] = -1;
    if (f->arg[1 + i].value == VS_FALSE) continue;
    if (!vs_bind_take_number(f->vm, f->arg[1 + i].value, &d[i]) || !isfinite(d[i]))
      return vs_bind_refuse(f, names[i], "a number, or #f for the size it has", f->arg[1 + i].value);
    if (d[i] < 0) return vs_bind_refuse(f, names[i], "0 or more", f->arg[1 + i].value);
  }
  return give_sized(f, vs_v3(d[0], d[1], d[2]), out);
}

vs_status vs_p_scope_height(vs_args *f, vs_value *out) {
  if (!vs_rules_class(f, 0, SIZED)) return VS_ERROR;
  return give_sized(f, vs_v3(-1, f->arg[1].real, -1), out);
}

vs_status vs_p_scope_scale(vs_args *f, vs_value *out) {
  if (!vs_rules_class(f, 0, SIZED)) return VS_ERROR;
  vs_vec3 size = vs_scope_size(f->arg[0].scope), k = vs_v3(f->arg[1].real, f->arg[1].real, f->arg[1].real);
  if (f->count > 2 && f->arg[2].given) k = vs_v3(f->arg[1].real, f->arg[2].real, f->arg[3].real);
  return give_sized(f, vs_v3(size.x * k.x, size.y * k.y, size.z * k.z), out);
}
