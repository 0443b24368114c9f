/* Implements the procedures that create scopes, and those that read the properties of scopes. */
#include "bind/rules/make_scopes.h"

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/rules/derivation.h"

#include <string.h>

#include "bind/call/context.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/planar_evaluation.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"

/* ---- creating scopes ---- */

/* Makes s a child of the scope to which the running rule is applied: its path continues that scope's path, and it has
 * that scope's flags. Random numbers then depend on the places of both scopes. */
static void stand_in(vs_scope *s, const vs_derivation *d, const char *op) {
  s->parent = vs_scope_retain(d->now), s->depth = d->now->depth + 1;
  s->rule = d->name, s->op = op;
  if ((s->flags = d->now->flags)) s->flags->refs++;
  s->hash = vs_scope_mix(d->now->hash, s->hash);
}

static vs_status made(vs_args *f, vs_scope *s, vs_vec3 at, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_derivation *d = vs_bind_growing(vm);
  if (s) vs_scope_plant(s, at);
  if (s && d && d->now) stand_in(s, d, vs_rules_operator(f));
  return vs_bind_give_scope(vm, s, out);
}

vs_status vs_p_make_box_scope(vs_args *f, vs_value *out) {
  vs_scope *s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_BOX);
  if (s) {
    s->as.box.frame = vs_affine_columns(vs_v3(1, 0, 0), vs_v3(0, 0, 1), vs_v3(0, -1, 0), vs_arg_point(f, 0));
    s->as.box.size = vs_v3(vs_arg_real(f, 1), vs_arg_real(f, 2), vs_arg_real(f, 3));
  }
  return made(f, s, vs_arg_point(f, 0), out);
}

vs_status vs_p_make_ffd_scope(vs_args *f, vs_value *out) {
  vs_scope *s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_FFD);
  for (int c = 0; s && c < 8; c++) s->as.corner[c] = vs_arg_point(f, c);
  return made(f, s, vs_arg_point(f, 0), out);
}

vs_status vs_p_make_turtle_scope(vs_args *f, vs_value *out) {
  vs_vec3 z = vs_v3_unit(vs_arg_point(f, 1)), y = vs_arg_point(f, 2);
  y = vs_v3_sub(y, vs_v3_scale(z, vs_v3_dot(y, z)));
  if (vs_v3_length(y) < 1e-9 * vs_v3_length(vs_arg_point(f, 2)))
    return vs_bind_refuse(f, "up", "a gvector that does not lie along heading", vs_arg_value(f, 2));
  y = vs_v3_unit(y);
  vs_scope *s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_TURTLE);
  if (s) {
    s->as.turtle.frame = vs_affine_columns(vs_v3_cross(y, z), y, z, vs_arg_point(f, 0));
    s->as.turtle.width = vs_arg_real(f, 3), s->as.turtle.height = vs_arg_real(f, 4);
  }
  return made(f, s, vs_arg_point(f, 0), out);
}

/* Sets the frame and size of the scope s to the bounding box of an object, with the axes of a scope outside of any
 * rule. */
static bool box_around(vs_args *f, vs_scope *s, vs_ref object) {
  vs_scheme *vm = vs_call_vm(f);
  vs_bounds b;
  vs_error e = { 0 };
  if (!vs_bind_bounds(vm, object, &b, &e)) return vs_bind_error(vm, &e);
  if (vs_bounds_is_empty(&b)) b = (vs_bounds){ { 0, 0, 0 }, { 0, 0, 0 } };
  s->as.box.frame =
      vs_affine_columns(vs_v3(1, 0, 0), vs_v3(0, 0, 1), vs_v3(0, -1, 0), vs_v3(b.min.x, b.max.y, b.min.z));
  s->as.box.size = vs_v3(b.max.x - b.min.x, b.max.z - b.min.z, b.max.y - b.min.y);
  return true;
}

static vs_status object_scope(vs_args *f, vs_scope_class c, vs_value *out) {
  vs_scope *s = vs_scope_fresh(vs_call_store(f), c);
  if (!s) return vs_fail_memory(vs_call_vm(f));
  s->object = vs_arg_ref(f, 0);
  vs_node_retain(s->object.node);
  if (!box_around(f, s, s->object)) return vs_scope_release(s), VS_ERROR;
  return made(f, s, vs_affine_column(&s->as.box.frame, 3), out);
}

vs_status vs_p_make_mesh_scope(vs_args *f, vs_value *out) { return object_scope(f, VS_SCOPE_MESH, out); }

vs_status vs_p_make_surface_scope(vs_args *f, vs_value *out) {
  if (vs_arg_ref(f, 0).node->class_ != VS_SURFACE) return vs_bind_refuse(f, "surface", "a surface", vs_arg_value(f, 0));
  return object_scope(f, VS_SCOPE_SURFACE, out);
}

/* Returns the loops of one area of the region o: the area's outer loop and its holes. *next is the index of the outer
 * loop, and becomes that of the next area. If it fails, sets the error and returns NULL. */
vs_scope_loops *vs_rules_outline_loops(vs_args *f, const vs_outline *o, size_t *next) {
  size_t first = *next, end = first + 1, points = 0;
  while (end < o->count && o->hole[end]) end++;
  for (size_t l = first; l < end; l++) points += o->loops[l].count;
  vs_vec3 *at = vs_bind_scratch(f, (points + 1) * sizeof *at);
  uint32_t *start = at ? vs_bind_scratch(f, (end - first + 1) * sizeof *start) : NULL;
  if (!start) return NULL;
  start[0] = 0;
  for (size_t l = first; l < end; l++) {
    memcpy(at + start[l - first], o->loops[l].at, o->loops[l].count * sizeof *at);
    start[l - first + 1] = start[l - first] + (uint32_t)o->loops[l].count;
  }
  vs_scope_loops *loops = vs_scope_loops_new(vs_call_store(f), at, start, (uint32_t)(end - first));
  if (!loops) vs_fail_memory(vs_call_vm(f));
  *next = end;
  return loops;
}

vs_status vs_p_make_polygon_scope(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_outline o = { 0 };
  vs_error e = { 0 };
  const vs_node *n = vs_arg_ref(f, 0).node;
  vs_fineness facets = vs_bend_facets(vm, n);
  if (n->class_ == VS_CURVE && !(n->flags & VS_NODE_CLOSED))
    return vs_bind_refuse(f, "region", "a region or a closed curve", vs_arg_value(f, 0));
  if (!vs_region_outline(n, &facets, &o, &e)) return vs_bind_error(vm, &e);
  size_t next = 0;
  vs_scope *s = NULL;
  vs_status status = VS_ERROR;
  if (!o.count)
    vs_bind_refuse(f, "region", "a region that has an area", vs_arg_value(f, 0));
  else if (!(s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_POLYGON)))
    vs_fail_memory(vm);
  else if ((s->loops = vs_rules_outline_loops(f, &o, &next))) {
    if (next < o.count)
      vs_bind_refuse(f, "region", "one piece; make a scope of each piece, or a mesh scope of all",
                     vs_arg_value(f, 0));
    else if (!vs_scope_frame_loops(s))
      vs_bind_refuse(f, "region", "a region that has an area", vs_arg_value(f, 0));
    else
      status = VS_OK;
  }
  vs_outline_free(&o);
  if (status != VS_OK) return vs_scope_release(s), VS_ERROR;
  return made(f, s, s->loops->points->at[0], out);
}

vs_status vs_p_make_triangle_scope(vs_args *f, vs_value *out) {
  const vs_vec3 at[3] = { vs_arg_point(f, 0), vs_arg_point(f, 1), vs_arg_point(f, 2) };
  vs_scope *s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_TRIANGLE);
  if (!s || !(s->loops = vs_scope_loops_new(s->store, at, (const uint32_t[]){ 0, 3 }, 1)))
    return vs_scope_release(s), vs_fail_memory(vs_call_vm(f));
  if (!vs_scope_frame_loops(s))
    return vs_scope_release(s), vs_bind_refuse(f, "r", "a point off the line through p and q", vs_arg_value(f, 2));
  return made(f, s, at[0], out);
}

vs_status vs_p_make_curve_scope(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_polyline p = { 0 };
  vs_error e = { 0 };
  vs_fineness facets = vs_bend_facets(vm, vs_arg_ref(f, 0).node);
  if (!vs_curve_sample(vs_arg_ref(f, 0).node, &facets, &p, &e)) return vs_bind_error(vm, &e);
  if (p.count < 2)
    return vs_polyline_free(&p), vs_bind_refuse(f, "curve", "a curve that has a length", vs_arg_value(f, 0));
  vs_scope *s = vs_scope_fresh(vs_call_store(f), VS_SCOPE_CURVE);
  const uint32_t start[2] = { 0, (uint32_t)p.count };
  if (s) s->loops = vs_scope_loops_new(s->store, p.at, start, 1), s->closed = p.closed;
  vs_polyline_free(&p);
  if (!s || !s->loops) return vs_scope_release(s), vs_fail_memory(vm);
  s->object = vs_arg_ref(f, 0);
  vs_node_retain(s->object.node);
  if (!box_around(f, s, s->object)) return vs_scope_release(s), VS_ERROR;
  return made(f, s, s->loops->points->at[0], out);
}

/* ---- properties of a scope ---- */

static vs_status is_class(vs_args *f, vs_scope_class c, vs_value *out) {
  const vs_scope *s = vs_bind_take_scope(vs_arg_value(f, 0));
  *out = vs_bool(s && s->class_ == c);
  return VS_OK;
}
vs_status vs_p_is_scope(vs_args *f, vs_value *out) {
  return *out = vs_bool(vs_bind_take_scope(vs_arg_value(f, 0)) != NULL), VS_OK;
}
vs_status vs_p_is_box_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_BOX, out); }
vs_status vs_p_is_ffd_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_FFD, out); }
vs_status vs_p_is_turtle_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_TURTLE, out); }
vs_status vs_p_is_mesh_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_MESH, out); }
vs_status vs_p_is_polygon_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_POLYGON, out); }
vs_status vs_p_is_triangle_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_TRIANGLE, out); }
vs_status vs_p_is_curve_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_CURVE, out); }
vs_status vs_p_is_surface_scope(vs_args *f, vs_value *out) { return is_class(f, VS_SCOPE_SURFACE, out); }

vs_status vs_p_scope_size_x(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_scope_size(vs_arg_scope(f, 0)).x, out);
}
vs_status vs_p_scope_size_y(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_scope_size(vs_arg_scope(f, 0)).y, out);
}
vs_status vs_p_scope_size_z(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_scope_size(vs_arg_scope(f, 0)).z, out);
}

vs_status vs_p_scope_corner(vs_args *f, vs_value *out) {
  static const char *const names[] = { "i", "j", "k" };
  for (int i = 1; i < 4; i++)
    if (vs_arg_integer(f, i) > 1) return vs_bind_refuse(f, names[i - 1], "0 or 1", vs_arg_value(f, i));
  return vs_bind_give_point(
      f,
      vs_scope_corner(vs_arg_scope(f, 0), (int)vs_arg_integer(f, 1), (int)vs_arg_integer(f, 2),
                      (int)vs_arg_integer(f, 3)),
      out);
}

vs_status vs_p_scope_frame(vs_args *f, vs_value *out) {
  vs_affine m = vs_scope_frame(vs_arg_scope(f, 0));
  return vs_bind_give_matrix(f, &m, out);
}

vs_status vs_p_scope_index(vs_args *f, vs_value *out) { return *out = vs_fix(vs_arg_scope(f, 0)->index), VS_OK; }
vs_status vs_p_scope_count(vs_args *f, vs_value *out) { return *out = vs_fix(vs_arg_scope(f, 0)->count), VS_OK; }
vs_status vs_p_scope_first(vs_args *f, vs_value *out) { return *out = vs_bool(vs_arg_scope(f, 0)->index == 0), VS_OK; }
vs_status vs_p_scope_last(vs_args *f, vs_value *out) {
  return *out = vs_bool(vs_arg_scope(f, 0)->index + 1 == vs_arg_scope(f, 0)->count), VS_OK;
}
vs_status vs_p_scope_left_angle(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_arg_scope(f, 0)->left, out);
}
vs_status vs_p_scope_right_angle(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_arg_scope(f, 0)->right, out);
}
vs_status vs_p_scope_depth(vs_args *f, vs_value *out) { return *out = vs_fix(vs_arg_scope(f, 0)->depth), VS_OK; }

vs_status vs_p_scope_parent(vs_args *f, vs_value *out) {
  vs_scope *parent = vs_arg_scope(f, 0)->parent;
  if (!parent) return *out = VS_FALSE, VS_OK;
  return vs_bind_give_scope(vs_call_vm(f), vs_scope_retain(parent), out);
}

/* Returns the path of a scope, from the root, as a list of (rule operator index). The rule is #f if the operator was
 * called outside of any rule. */
vs_status vs_p_scope_path(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 3);
  r[0] = VS_NIL;
  for (const vs_scope *s = vs_arg_scope(f, 0); s; s = s->parent) {
    if (!s->op) continue;
    if (!vs_cons(vm, vs_fix(s->index), VS_NIL, &r[1]) || !vs_intern_c(vm, s->op, &r[2]) ||
        !vs_cons(vm, r[2], r[1], &r[1]))
      return VS_ERROR;
    r[2] = VS_FALSE;
    if (s->rule && !vs_intern_c(vm, s->rule, &r[2])) return VS_ERROR;
    if (!vs_cons(vm, r[2], r[1], &r[1]) || !vs_cons(vm, r[1], r[0], &r[0]) || !vs_poll(vm, 8)) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

/* (scope-region s): returns the region that the loops of the scope s enclose; s is a polygon or triangle. */
vs_status vs_p_scope_region(vs_args *f, vs_value *out) {
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  const vs_scope_loops *l = vs_arg_scope(f, 0)->loops;
  vs_store *s = vs_call_store(f);
  vs_ref *lines = vs_bind_scratch(f, l->count * sizeof *lines);
  if (!lines) return VS_ERROR;
  for (uint32_t i = 0; i < l->count; i++) {
    vs_points *p = vs_points_new(s, l->points->at + l->start[i], l->start[i + 1] - l->start[i]);
    vs_node *n = p ? vs_node_new(s, VS_LINE, &(struct vs_line){ .points = p, .closed = true }, NULL, 0) : NULL;
    vs_points_release(s, p);
    if (!vs_bind_keep(f, n)) return VS_ERROR;
    lines[i] = (vs_ref){ n, NULL };
  }
  return vs_bind_make(f, VS_REGION, &(struct vs_region){ 0 }, lines, l->count, out);
}

/* ---- flags of scopes ---- */

vs_status vs_p_flag(vs_args *f, vs_value *out) {
  const char *name = vs_store_text(vs_call_store(f), vs_arg_text(f, 1), vs_arg_text_length(f, 1));
  if (!name) return vs_fail_memory(vs_call_vm(f));
  *out = vs_bool(vs_scope_has_flag(vs_arg_scope(f, 0), name));
  return VS_OK;
}

vs_status vs_p_scope_flags(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_scope_flags *flags = vs_arg_scope(f, 0)->flags;
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (uint32_t i = flags ? flags->count : 0; i-- > 0;)
    if (!vs_intern_c(vm, flags->name[i], &r[1]) || !vs_cons(vm, r[1], r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (%with-flags s flags rule): applies the rule to s with these flags. `flags` is a list of symbols, and of pairs of a
 * symbol and a boolean. */
vs_status vs_p_with_flags(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2);
  vs_scope *s = vs_arg_scope(f, 0);
  r[0] = vs_arg_value(f, 2);
  int64_t n = vs_list_length(vs_arg_value(f, 1));
  const char **names = n >= 0 ? vs_bind_scratch(f, ((size_t)n + 1) * sizeof *names) : NULL;
  size_t count = 0;
  if (n < 0) return vs_bind_refuse(f, "flags", "a list of names and of (name test)", vs_arg_value(f, 1));
  if (!names) return VS_ERROR;
  for (vs_value l = vs_arg_value(f, 1); l != VS_NIL; l = vs_cdr(l)) {
    vs_value flag = vs_car(l);
    bool holds = true;
    if (vs_is_pair(flag)) holds = vs_cdr(flag) != VS_FALSE, flag = vs_car(flag);
    if (!vs_is_symbol(flag)) return vs_bind_refuse(f, "flags", "a list of names and of (name test)", vs_car(l));
    if (holds &&
        !(names[count++] = vs_store_text(vs_call_store(f), vs_as_symbol(flag)->name, vs_as_symbol(flag)->length)))
      return vs_fail_memory(vm);
  }
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  vs_scope *c = t->child[0] = vs_rules_child(d, s, (vs_scope_class)s->class_, "flags", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_scope_become(c, s);
  c->index = s->index, c->count = s->count, c->left = s->left, c->right = s->right;
  if (count && !vs_scope_add_flags(c, names, count)) return vs_task_drop(d, t), vs_fail_memory(vm);
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
