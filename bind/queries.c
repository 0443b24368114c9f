/* Implements questions about an object: its kind and parts, its bounds and measures. */
#include "bind/queries.h"

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/planar_evaluation.h"
#include "vm/values/heap.h"

static vs_status truth(bool b, vs_value *out) {
  *out = vs_bool(b);
  return VS_OK;
}
static const vs_node *node_of(const vs_args *f) { /* returns the node of argument 0, or NULL if it is no object */
  return vs_bind_take_ref(f->arg[0].value).node;
}
static vs_status is_class(const vs_args *f, vs_class c, vs_value *out) {
  return truth(node_of(f) && node_of(f)->class_ == c, out);
}

vs_status vs_p_is_object(vs_args *f, vs_value *out) { return truth(node_of(f) != NULL, out); }
vs_status vs_p_is_curve(vs_args *f, vs_value *out) { return is_class(f, VS_CURVE, out); }
vs_status vs_p_is_region(vs_args *f, vs_value *out) { return is_class(f, VS_REGION_CLASS, out); }
vs_status vs_p_is_surface(vs_args *f, vs_value *out) { return is_class(f, VS_SURFACE, out); }
vs_status vs_p_is_solid(vs_args *f, vs_value *out) { return is_class(f, VS_SOLID, out); }
vs_status vs_p_is_empty(vs_args *f, vs_value *out) { return truth(node_of(f) && node_of(f)->kind == VS_EMPTY, out); }

static bool is_operation(const vs_node *n) {
  vs_level level = vs_kind_get((vs_kind)n->kind)->level;
  return level == VS_LEVEL_OPERATION || level == VS_LEVEL_SWEPT;
}
vs_status vs_p_is_csg(vs_args *f, vs_value *out) { return truth(node_of(f) && vs_node_is_set(node_of(f)), out); }
vs_status vs_p_is_operation(vs_args *f, vs_value *out) { return truth(node_of(f) && is_operation(node_of(f)), out); }
vs_status vs_p_is_primitive(vs_args *f, vs_value *out) { return truth(node_of(f) && !is_operation(node_of(f)), out); }

vs_status vs_p_object_kind(vs_args *f, vs_value *out) {
  const vs_node *n = f->arg[0].ref.node;
  return vs_intern_c(f->vm, n->kind == VS_CUSTOM ? VS_AS(custom, n)->name : vs_kind_get((vs_kind)n->kind)->name, out);
}

/* ---- fields of a node as Scheme values ---- */

static vs_status list_points(vs_args *f, const vs_points *p, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (uint32_t i = p->count; i-- > 0;)
    if (!vs_bind_give_point(f, p->at[i], &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

static vs_status list_faces(vs_args *f, const vs_faces *g, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (uint32_t i = g->count; i-- > 0;) {
    r[1] = VS_NIL;
    for (uint32_t c = vs_faces_starts(g)[i + 1]; c-- > vs_faces_starts(g)[i];)
      if (!vs_cons(f->vm, vs_fix((int64_t)vs_faces_corners(g)[c] + 1), r[1], &r[1])) return VS_ERROR;
    if (!vs_cons(f->vm, r[1], r[0], &r[0])) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

static vs_status field_value(vs_args *f, const vs_field_info *i, const vs_node *n, vs_value *out) {
  const void *at = (const char *)vs_node_data(n) + i->offset;
  switch (i->type) {
    case VS_FIELD_real: return vs_bind_give_real(f, *(const double *)at, out);
    case VS_FIELD_integer: *out = vs_fix(*(const int32_t *)at); return VS_OK;
    case VS_FIELD_boolean: return truth(*(const bool *)at, out);
    case VS_FIELD_point: return vs_bind_give_point(f, *(const vs_vec3 *)at, out);
    case VS_FIELD_vector: return vs_bind_give_vector(f, *(const vs_vec3 *)at, out);
    case VS_FIELD_affine: return vs_bind_give_matrix(f, at, out);
    case VS_FIELD_points: return list_points(f, *(const vs_points *const *)at, out);
    case VS_FIELD_faces: return list_faces(f, *(const vs_faces *const *)at, out);
    case VS_FIELD_text:
      return vs_string_from_utf8(f->vm, *(const char *const *)at, strlen(*(const char *const *)at), out);
    case VS_FIELD_ticket: *out = vs_fix((*(const vs_ticket *const *)at)->id); return VS_OK;
    case VS_FIELD_material: {
      const vs_material *m = *(const vs_material *const *)at;
      return vs_make_foreign(f->vm, &vs_paint_type, (void *)(uintptr_t)m, 0, out);
    }
  }
  return vs_fail_memory(f->vm);
}

/* Returns the arguments of the constructor's call. Omits `segments` if the call did not give it. */
vs_status vs_p_object_arguments(vs_args *f, vs_value *out) {
  const vs_node *n = f->arg[0].ref.node;
  const vs_kind_info *k = vs_kind_get((vs_kind)n->kind);
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = k->field_count; i-- > 0;) {
    if (!strcmp(k->fields[i].argument, "segments") &&
        *(const int32_t *)(const void *)((const char *)vs_node_data(n) + k->fields[i].offset) == 0)
      continue;
    if (!field_value(f, &k->fields[i], n, &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0])) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

vs_status vs_p_object_children(vs_args *f, vs_value *out) {
  const vs_node *n = f->arg[0].ref.node;
  return vs_bind_give_refs(f->bind, n->children, n->child_count, out);
}

vs_status vs_p_object_count(vs_args *f, vs_value *out) {
  vs_bind_counts c;
  vs_error e = { 0 };
  if (!vs_bind_count(f->arg[0].ref, &c, &e)) return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f->vm, &e);
  *out = c.all < (double)VS_FIXNUM_MAX ? vs_fix((int64_t)c.all) : vs_flonum(c.all);
  return VS_OK;
}

/* ---- measures ---- */

vs_status vs_bind_finite(vs_args *f, int i) {
  const vs_arg *a = &f->arg[i];
  if (!(a->ref.node->flags & VS_NODE_ENDLESS)) return VS_OK;
  return vs_bind_refuse(f, f->procedure->form[f->form].at[i].name,
                        "finite (a half-space has to be intersected with something that is, or subtracted from it)",
                        a->value);
}

vs_status vs_p_contains(vs_args *f, vs_value *out) {
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  const vs_node *n = f->arg[0].ref.node;
  bool inside = false;
  vs_error e = { 0 };
  if (n->class_ == VS_NOTHING) return truth(false, out);
  if (n->class_ == VS_REGION_CLASS)
    return vs_region_contains(n, f->arg[1].point, &inside, &e) ? truth(inside, out) : vs_bind_error(f->vm, &e);
  if (n->class_ == VS_CURVE && n->flags & VS_NODE_CLOSED) { /* a closed curve counts as the area that it encloses */
    if (!vs_bind_uncrossed(f, f->arg[0].ref, "a closed curve that is taken as filled")) return VS_ERROR;
    vs_node *region = vs_node_new(f->store, VS_REGION, &(struct vs_region){ 0 }, &f->arg[0].ref, 1);
    if (!vs_bind_keep(f, region)) return VS_ERROR;
    return vs_region_contains(region, f->arg[1].point, &inside, &e) ? truth(inside, out) : vs_bind_error(f->vm, &e);
  }
  if (n->class_ != VS_SOLID) return vs_bind_refuse(f, "o", "a solid, a region or a closed curve", f->arg[0].value);
  if (!vs_inside_cached(&f->bind->inside, n, f->arg[1].point, &inside, &e)) return vs_bind_error(f->vm, &e);
  return truth(inside, out);
}
