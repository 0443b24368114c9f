/* Implements the procedures that create scopes, and those that read the properties of scopes. */
#include "bind/rules/make_scopes.h"

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/rules/derivation.h"

#include <string.h>

#include "bind/state.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/planar_evaluation.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"

/* ---- creating scopes ---- */

/* Makes s a child of the scope to which the running rule is applied. The path of s then continues that scope's path,
 * and s has that scope's flags; random numbers depend on the places of both scopes. */
static void stand_in(vs_scope *s, const vs_derivation *d, const char *op) {
  s->parent = vs_scope_retain(d->now), s->depth = d->now->depth + 1;
  s->rule = d->name, s->op = op;
  if ((s->flags = d->now->flags)) s->flags->refs++;
  s->hash = vs_scope_mix(d->now->hash, s->hash);
}

static vs_status made(vs_args *f, vs_scope *s, vs_vec3 at, vs_value *out) {
  const vs_derivation *d = f->bind->growing;
  if (s) vs_scope_plant(s, at);
  if (s && d && d->now) stand_in(s, d, vs_rules_operator(f));
  return vs_bind_give_scope(f->vm, s, out);
}

vs_status vs_p_make_box_scope(vs_args *f, vs_value *out) {
  vs_scope *s = vs_scope_fresh(f->store, VS_SCOPE_BOX);
  if (s) {
    s->as.box.frame = vs_affine_columns(vs_v3(1, 0, 0), vs_v3(0, 0, 1), vs_v3(0, -1, 0), f->arg[0].point);
    s->as.box.size = vs_v3(f->arg[1].real, f->arg[2].real, f->arg[3].real);
  }
  return made(f, s, f->arg[0].point, out);
}

vs_status vs_p_make_ffd_scope(vs_args *f, vs_value *out) {
  vs_scope *s = vs_scope_fresh(f->store, VS_SCOPE_FFD);
  for (int c = 0; s && c < 8; c++) s->as.corner[c] = f->arg[c].point;
  return made(f, s, f->arg[0].point, out);
}

vs_status vs_p_make_turtle_scope(vs_args *f, vs_value *out) {
  vs_vec3 z = vs_v3_unit(f->arg[1].point), y = f->arg[2].point;
  y = vs_v3_sub(y, vs_v3_scale(z, vs_v3_dot(y, z)));
  if (vs_v3_length(y) < 1e-9 * vs_v3_length(f->arg[2].point))
    return vs_bind_refuse(f, "up", "a gvector that does not lie along heading", f->arg[2].value);
  y = vs_v3_unit(y);
  vs_scope *s = vs_scope_fresh(f->store, VS_SCOPE_TURTLE);
  if (s) {
    s->as.turtle.frame = vs_affine_columns(vs_v3_cross(y, z), y, z, f->arg[0].point);
    s->as.turtle.width = f->arg[3].real, s->as.turtle.height = f->arg[4].real;
  }
  return made(f, s, f->arg[0].point, out);
}

/* Sets the frame and size of the scope s to the bounding box of an object, with the axes of a root box. */
static bool box_around(vs_args *f, vs_scope *s, vs_ref object) {
  vs_bounds b;
  vs_error e = { 0 };
  if (!vs_bind_bounds(f->vm, object, &b, &e)) return vs_bind_error(f->vm, &e);
  if (vs_bounds_is_empty(&b)) b = (vs_bounds){ { 0, 0, 0 }, { 0, 0, 0 } };
  s->as.box.frame =
      vs_affine_columns(vs_v3(1, 0, 0), vs_v3(0, 0, 1), vs_v3(0, -1, 0), vs_v3(b.min.x, b.max.y, b.min.z));
  s->as.box.size = vs_v3(b.max.x - b.min.x, b.max.z - b.min.z, b.max.y - b.min.y);
  return true;
}

static vs_status object_scope(vs_args *f, vs_scope_class c, vs_value *out) {
  vs_scope *s = vs_scope_fresh(f->store, c);
  if (!s) return vs_fail_memory(f->vm);
  s->object = f->arg[0].ref;
  vs_node_retain(s->object.node);
  if (!box_around(f, s, s->object)) return vs_scope_release(s), VS_ERROR;
  return made(f, s, vs_affine_column(&s->as.box.frame, 3), out);
}

vs_status vs_p_make_mesh_scope(vs_args *f, vs_value *out) { return object_scope(f, VS_SCOPE_MESH, out); }

vs_status vs_p_make_surface_scope(vs_args *f, vs_value *out) {
  if (f->arg[0].ref.node->class_ != VS_SURFACE) return vs_bind_refuse(f, "surface", "a surface", f->arg[0].value);
  return object_scope(f, VS_SCOPE_SURFACE, out);
}

/* Returns the loops of one area of a region: its outer loop and its holes. *next is the index of the outer loop, and is
 * set to that of the next area. If it fails, sets the error and returns NULL. */
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
  vs_scope_loops *loops = vs_scope_loops_new(f->store, at, start, (uint32_t)(end - first));
  if (!loops) vs_fail_memory(f->vm);
  *next = end;
  return loops;
}

vs_status vs_p_make_polygon_scope(vs_args *f, vs_value *out) {
  vs_outline o = { 0 };
  vs_error e = { 0 };
  const vs_node *n = f->arg[0].ref.node;
  vs_fineness facets = vs_bend_facets(f->vm, n);
  if (n->class_ == VS_CURVE && !(n->flags & VS_NODE_CLOSED))
    return vs_bind_refuse(f, "region", "a region or a closed curve", f->arg[0].value);
  if (!vs_region_outline(n, &facets, &o, &e)) return vs_bind_error(f->vm, &e);
  size_t next = 0;
  vs_scope *s = NULL;
  vs_status status = VS_ERROR;
  if (!o.count)
    vs_bind_refuse(f, "region", "a region that has an area", f->arg[0].value);
  else if (!(s = vs_scope_fresh(f->store, VS_SCOPE_POLYGON)))
    vs_fail_memory(f->vm);
  else if ((s->loops = vs_rules_outline_loops(f, &o, &next))) {
    if (next < o.count)
      vs_bind_refuse(f, "region", "one piece; make a scope of each piece, or a mesh scope of all",
                     f->arg[0].value);
    else if (!vs_scope_frame_loops(s))
      vs_bind_refuse(f, "region", "a region that has an area", f->arg[0].value);
    else
      status = VS_OK;
  }
  vs_outline_free(&o);
  if (status != VS_OK) return vs_scope_release(s), VS_ERROR;
  return made(f, s, s->loops->points->at[0], out);
}

vs_status vs_p_make_triangle_scope(vs_args *f, vs_value *out) {
  const vs_vec3 at[3] = { f->arg[0].point, f->arg[1].point, f->arg[2].point };
  vs_scope *s = vs_scope_fresh(f->store, VS_SCOPE_TRIANGLE);
  if (!s || !(s->loops = vs_scope_loops_new(s->store, at, (const uint32_t[]){ 0, 3 }, 1)))
    return vs_scope_release(s), vs_fail_memory(f->vm);
  if (!vs_scope_frame_loops(s))
    return vs_scope_release(s), vs_bind_refuse(f, "r", "a point off the line through p and q", f->arg[2].value);
  return made(f, s, at[0], out);
}

vs_status vs_p_make_curve_scope(vs_args *f, vs_value *out) {
  vs_polyline p = { 0 };
  vs_error e = { 0 };
  vs_fineness facets = vs_bend_facets(f->vm, f->arg[0].ref.node);
  if (!vs_curve_sample(f->arg[0].ref.node, &facets, &p, &e)) return vs_bind_error(f->vm, &e);
  if (p.count < 2)
    return vs_polyline_free(&p), vs_bind_refuse(f, "curve", "a curve that has a length", f->arg[0].value);
  vs_scope *s = vs_scope_fresh(f->store, VS_SCOPE_CURVE);
  const uint32_t start[2] = { 0, (uint32_t)p.count };
  if (s) s->loops = vs_scope_loops_new(s->store, p.at, start, 1), s->closed = p.closed;
  vs_polyline_free(&p);
  if (!s || !s->loops) return vs_scope_release(s), vs_fail_memory(f->vm);
  s->object = f->arg[0].ref;
  vs_node_retain(s->object.node);
  if (!box_around(f, s, s->object)) return vs_scope_release(s), VS_ERROR;
  return made(f, s, s->loops->points->at[0], out);
}

/* ---- properties of a scope ---- */

static vs_status is_class(vs_args *f, vs_scope_class c, vs_value *out) {
  const vs_scope *s = vs_bind_take_scope(f->arg[0].value);
  *out = vs_bool(s && s->class_ == c);
  return VS_OK;
}
vs_status vs_p_is_scope(vs_args *f, vs_value *out) {
  return *out = vs_bool(vs_bind_take_scope(f->arg[0].value) != NULL), VS_OK;
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
  return vs_bind_give_real(f, vs_scope_size(f->arg[0].scope).x, out);
}
vs_status vs_p_scope_size_y(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_scope_size(f->arg[0].scope).y, out);
}
vs_status vs_p_scope_size_z(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, vs_scope_size(f->arg[0].scope).z, out);
}

vs_status vs_p_scope_corner(vs_args *f, vs_value *out) {
  static const char *const names[] = { "i", "j", "k" };
  for (int i = 1; i < 4; i++)
    if (f->arg[i].integer > 1) return vs_bind_refuse(f, names[i - 1], "0 or 1", f->arg[i].value);
  return vs_bind_give_point(
      f, vs_scope_corner(f->arg[0].scope, (int)f->arg[1].integer, (int)f->arg[2].integer, (int)f->arg[3].integer), out);
}

vs_status vs_p_scope_frame(vs_args *f, vs_value *out) {
  vs_affine m = vs_scope_frame(f->arg[0].scope);
  return vs_bind_give_matrix(f, &m, out);
}

vs_status vs_p_scope_index(vs_args *f, vs_value *out) { return *out = vs_fix(f->arg[0].scope->index), VS_OK; }
vs_status vs_p_scope_count(vs_args *f, vs_value *out) { return *out = vs_fix(f->arg[0].scope->count), VS_OK; }
vs_status vs_p_scope_first(vs_args *f, vs_value *out) { return *out = vs_bool(f->arg[0].scope->index == 0), VS_OK; }
vs_status vs_p_scope_last(vs_args *f, vs_value *out) {
  return *out = vs_bool(f->arg[0].scope->index + 1 == f->arg[0].scope->count), VS_OK;
}
vs_status vs_p_scope_left_angle(vs_args *f, vs_value *out) { return vs_bind_give_real(f, f->arg[0].scope->left, out); }
vs_status vs_p_scope_right_angle(vs_args *f, vs_value *out) {
  return vs_bind_give_real(f, f->arg[0].scope->right, out);
}
vs_status vs_p_scope_depth(vs_args *f, vs_value *out) { return *out = vs_fix(f->arg[0].scope->depth), VS_OK; }

vs_status vs_p_scope_parent(vs_args *f, vs_value *out) {
  vs_scope *parent = f->arg[0].scope->parent;
  if (!parent) return *out = VS_FALSE, VS_OK;
  return vs_bind_give_scope(f->vm, vs_scope_retain(parent), out);
}

/* Returns the path of a scope, from the root, as a list of (rule operator index). The rule is #f if the operator was
 * called outside of any rule. */
vs_status vs_p_scope_path(vs_args *f, vs_value *out) {
  vs_scheme *vm = f->vm;
  VS_ROOTS(vm, r, 3);
  r[0] = VS_NIL;
  for (const vs_scope *s = f->arg[0].scope; s; s = s->parent) {
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

/* (scope-region s): returns the region that the loops of a polygon or triangle scope bound. */
vs_status vs_p_scope_region(vs_args *f, vs_value *out) {
  if (!vs_rules_class(f, 0, VS_SCOPE_BIT(POLYGON) | VS_SCOPE_BIT(TRIANGLE))) return VS_ERROR;
  const vs_scope_loops *l = f->arg[0].scope->loops;
  vs_store *s = f->store;
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
  const char *name = vs_store_text(f->store, f->arg[1].text.at, f->arg[1].text.length);
  if (!name) return vs_fail_memory(f->vm);
  *out = vs_bool(vs_scope_has_flag(f->arg[0].scope, name));
  return VS_OK;
}

vs_status vs_p_scope_flags(vs_args *f, vs_value *out) {
  const vs_scope_flags *flags = f->arg[0].scope->flags;
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (uint32_t i = flags ? flags->count : 0; i-- > 0;)
    if (!vs_intern_c(f->vm, flags->name[i], &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (%with-flags s flags rule): applies the rule to s with these flags. `flags` is a list of symbols, and of pairs of a
 * symbol and a boolean. */
vs_status vs_p_with_flags(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  vs_scope *s = f->arg[0].scope;
  r[0] = f->arg[2].value;
  int64_t n = vs_list_length(f->arg[1].value);
  const char **names = n >= 0 ? vs_bind_scratch(f, ((size_t)n + 1) * sizeof *names) : NULL;
  size_t count = 0;
  if (n < 0) return vs_bind_refuse(f, "flags", "a list of names and of (name test)", f->arg[1].value);
  if (!names) return VS_ERROR;
  for (vs_value l = f->arg[1].value; l != VS_NIL; l = vs_cdr(l)) {
    vs_value flag = vs_car(l);
    bool holds = true;
    if (vs_is_pair(flag)) holds = vs_cdr(flag) != VS_FALSE, flag = vs_car(flag);
    if (!vs_is_symbol(flag)) return vs_bind_refuse(f, "flags", "a list of names and of (name test)", vs_car(l));
    if (holds &&
        !(names[count++] = vs_store_text(f->store, vs_as_symbol(flag)->name, vs_as_symbol(flag)->length)))
      return vs_fail_memory(f->vm);
  }
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  vs_scope *c = t->child[0] = vs_rules_child(d, s, (vs_scope_class)s->class_, "flags", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_scope_become(c, s);
  c->index = s->index, c->count = s->count, c->left = s->left, c->right = s->right;
  if (count && !vs_scope_add_flags(c, names, count)) return vs_task_drop(d, t), vs_fail_memory(f->vm);
  *out = r[1];
  return vs_task_push(d, t) ? VS_OK : VS_ERROR;
}
