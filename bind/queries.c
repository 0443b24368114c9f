/* Implements procedures that return facts about an object: its kind and parts, its bounds and measures, its material,
 * layer and place. */
#include "bind/queries.h"

#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/procedure.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/planar_evaluation.h"
#include "model/store/array.h"
#include "model/store/nodemap.h"
#include "model/scene.h"
#include "model/walk.h"
#include "solids/named_parts.h"
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

static vs_status give_material(vs_scheme *vm, const vs_material *m, vs_value *out) {
  return vs_make_foreign(vm, &vs_paint_type, (void *)(uintptr_t)m, 0, out);
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
      return give_material(f->vm, m, out);
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

/* ---- the look that all parts of an object have in common ----
 *
 * A look is a material or the name of a layer. A part may have a look of its own; otherwise it has the look of the
 * innermost node of kind material or layer around it. If all parts of a node have one look, it is the node's look. The
 * result for a node is computed from the results for its children, once for each node. */

typedef struct {
  const void *look; /* the only look of the parts that have one; NULL if no part has a look */
  bool bare;        /* whether a part has no look of its own */
  bool several;     /* whether two parts have different looks */
} look_of;

static look_of both(look_of a, look_of b) {
  bool differ = a.look && b.look && a.look != b.look;
  return (look_of){ a.look ? a.look : b.look, a.bare || b.bare, a.several || b.several || differ };
}

/* Returns the number of children that are parts of the visible object; they are the node's first children. */
static size_t shown(const vs_node *n) {
  switch (vs_node_role(n)) {
    case VS_ROLE_SHAPE: case VS_ROLE_LEAF: case VS_ROLE_MADE: break;
    case VS_ROLE_PLACED: case VS_ROLE_WRAPPER: return n->child_count;
    case VS_ROLE_SET: return n->kind == VS_DIFFERENCE && n->child_count ? 1 : n->child_count;
  }
  return 0;
}

static const void *own_look(const vs_node *n, vs_kind kind) {
  if (n->kind != kind) return NULL;
  if (kind == VS_PART) return VS_AS(part, n)->name;
  return kind == VS_MATERIAL ? (const void *)VS_AS(material, n)->material : VS_AS(layer, n)->name;
}

typedef struct {
  vs_kind kind;       /* kind of look that is searched: VS_MATERIAL, VS_LAYER or VS_PART */
  vs_nodemap answers; /* for each node, 1 + the index of its result in `made` */
  look_of *made;
  size_t count, room;
} look_search;

/* Computes and stores the result for a node; its children already have results. Returns false when memory is out. */
static bool answer(look_search *l, const vs_node *n) {
  const void *own = own_look(n, l->kind);
  look_of sum = { NULL, shown(n) == 0, false };
  for (size_t i = 0; i < shown(n); i++) {
    const vs_node *child = n->children[i].node;
    if (child->kind != VS_EMPTY) sum = both(sum, l->made[*vs_nodemap_get(&l->answers, child) - 1]);
  }
  if (own && sum.bare) sum = both((look_of){ sum.look, false, sum.several }, (look_of){ own, false, false });
  if (!VS_GROW(l->made, l->room, l->count + 1)) return false;
  uint64_t *place = vs_nodemap_put(&l->answers, n, NULL);
  if (!place) return false;
  l->made[l->count++] = sum;
  *place = l->count;
  return true;
}

/* Sets *out to the look that all parts of the object have, or to NULL if they differ. Returns false when memory is
 * out. */
static bool find_look(vs_store *s, vs_ref root, vs_kind kind, const void **out) {
  look_search l = { .kind = kind, .answers = { .store = s } };
  vs_walk *w = vs_walk_new(s, root);
  vs_ref at;
  size_t depth;
  vs_walk_event event = VS_WALK_FAILED;
  while (w && (event = vs_walk_next(w, &at, &depth)) < VS_WALK_DONE) {
    if (vs_nodemap_get(&l.answers, at.node)) {
      if (event == VS_WALK_ENTER) vs_walk_skip(w);
    } else if (event == VS_WALK_ENTER) {
      if (shown(at.node) == 0) vs_walk_skip(w);
    } else if (!answer(&l, at.node)) {
      event = VS_WALK_FAILED;
      break;
    }
  }
  *out = NULL;
  if (event == VS_WALK_DONE) {
    look_of whole = l.made[*vs_nodemap_get(&l.answers, root.node) - 1];
    if (!whole.bare && !whole.several) *out = whole.look;
  }
  vs_walk_free(w);
  vs_nodemap_free(&l.answers);
  free(l.made);
  return event == VS_WALK_DONE;
}

vs_status vs_p_object_material(vs_args *f, vs_value *out) {
  const void *look;
  if (!find_look(f->store, f->arg[0].ref, VS_MATERIAL, &look)) return vs_fail_memory(f->vm);
  *out = VS_FALSE;
  return look ? give_material(f->vm, look, out) : VS_OK;
}

static vs_status give_name(vs_args *f, vs_kind kind, vs_value *out) {
  const void *look;
  if (!find_look(f->store, f->arg[0].ref, kind, &look)) return vs_fail_memory(f->vm);
  *out = VS_FALSE;
  return look ? vs_string_from_utf8(f->vm, look, strlen(look), out) : VS_OK;
}

vs_status vs_p_object_layer(vs_args *f, vs_value *out) { return give_name(f, VS_LAYER, out); }
vs_status vs_p_object_part(vs_args *f, vs_value *out) { return give_name(f, VS_PART, out); }

/* Returns a list of the parts in the objects, without the objects outside of parts. */
vs_status vs_p_object_parts(vs_args *f, vs_value *out) {
  vs_scene scene = { .store = f->store };
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  bool ok = true;
  for (size_t i = 0; ok && i < f->arg[0].refs.count; i++) ok = vs_scene_draw(&scene, f->arg[0].refs.at[i]);
  vs_status status = !ok ? vs_fail_memory(f->vm)
                     : vs_scene_parts(&scene, true, &why) ? VS_OK : vs_bind_error(f->vm, &why);
  size_t count = 0;
  for (size_t i = 0; status == VS_OK && i < scene.drawn_count; i++) { /* the parts come first, the others after them */
    vs_ref ref = scene.drawn[i];
    if (ref.node->kind != VS_PART) continue;
    scene.drawn[i] = scene.drawn[count];
    scene.drawn[count++] = ref;
  }
  if (status == VS_OK) status = vs_bind_give_refs(f->bind, scene.drawn, count, out);
  for (size_t i = 0; i < scene.drawn_count; i++) vs_node_release(scene.drawn[i].node);
  if (scene.drawn) vs_store_realloc(f->store, scene.drawn, scene.drawn_room * sizeof *scene.drawn, 0);
  return status;
}

vs_status vs_p_object_origin(vs_args *f, vs_value *out) {
  const vs_origin *o = f->arg[0].ref.origin;
  VS_ROOTS(f->vm, r, 2);
  *out = VS_FALSE;
  if (!o) return VS_OK;
  r[0] = VS_NIL;
  if (!vs_cons(f->vm, vs_fix(o->column), r[0], &r[0]) || !vs_cons(f->vm, vs_fix(o->line), r[0], &r[0]) ||
      !vs_string_from_utf8(f->vm, o->file, strlen(o->file), &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0]))
    return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* ---- materials ---- */

vs_status vs_p_material_name(vs_args *f, vs_value *out) {
  const char *name = f->arg[0].material->name;
  return vs_string_from_utf8(f->vm, name, strlen(name), out);
}

vs_status vs_p_material_color(vs_args *f, vs_value *out) {
  const vs_material *m = f->arg[0].material;
  const double parts[] = { m->blue, m->green, m->red };
  VS_ROOTS(f->vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    if (!vs_cons(f->vm, vs_flonum(parts[i]), r[0], &r[0])) return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

vs_status vs_p_material_roughness(vs_args *f, vs_value *out) {
  *out = vs_flonum(f->arg[0].material->roughness);
  return VS_OK;
}

vs_status vs_p_material_transparency(vs_args *f, vs_value *out) {
  *out = vs_flonum(f->arg[0].material->transparency);
  return VS_OK;
}
