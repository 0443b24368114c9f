/* Converts arguments that are objects, points, lists of objects and points, materials or colours. Each function
 * vs_convert_* belongs to a row of contracts.def. It sets *out, or the error. Nested lists are flattened without
 * recursion. */
#include "bind/call/call.h"
#include "bind/call/convert.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "bind/call/context.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/files.h"
#include "bind/constructors/operations.h"
#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/print.h"
#include "bind/records.h"
#include "bind/rules/scope.h"
#include "model/looks/ready_materials.h"
#include "vm/front/suggest.h"
#include "vm/machine/fail.h"

static bool finite3(const double *d) { return isfinite(d[0]) && isfinite(d[1]) && isfinite(d[2]); }
static vs_vec3 vec_of(const double *d) { return vs_v3(d[0], d[1], d[2]); }

/* Flattens `values`, each an item or a nested list of items, and calls `add` for each item. If a value is neither list
 * nor item, returns false and sets *bad to the value, or to VS_ABSENT if the error is already set. An explicit stack
 * contains the unread part of each open list. No Scheme objects are allocated, so C variables need not be roots of the
 * garbage collector. A list that contains itself would make the stack grow forever. Each list that is opened is
 * therefore compared with the open list whose depth is the next lower power of two (Brent's cycle detection). */
static bool flatten(vs_args *f, const vs_value *values, size_t count,
                    bool (*add)(vs_args *, vs_value, void *, bool *oom), void *to, vs_value *bad) {
  struct open { vs_value list, rest; } fixed[32], *open = fixed;
  size_t room = 32;
  for (size_t i = 0; i < count; i++) {
    size_t depth = 0;
    vs_value v = values[i];
    for (;;) {
      bool oom = false;
      if (vs_is_pair(v) || v == VS_NIL) {
        if (vs_list_length(v) < 0) return *bad = v, false;
        size_t mark = 0;
        for (size_t power = 1; power < depth; power *= 2) mark = power;
        if (depth && v != VS_NIL && open[mark].list == v) return *bad = v, false;
        if (depth == room) {
          struct open *more = vs_bind_scratch(f, room * 2 * sizeof *more);
          if (!more) return *bad = VS_ABSENT, false;
          memcpy(more, open, room * sizeof *more);
          open = more, room *= 2;
        }
        open[depth++] = (struct open){ v, v };
      } else if (!add(f, v, to, &oom)) {
        return *bad = oom ? VS_ABSENT : v, false;
      }
      while (depth > 0 && open[depth - 1].rest == VS_NIL) depth--;
      if (depth == 0) break;
      if (!vs_poll(f->vm, 8)) return *bad = VS_ABSENT, false;
      v = vs_car(open[depth - 1].rest);
      open[depth - 1].rest = vs_cdr(open[depth - 1].rest);
    }
  }
  return true;
}

static bool add_ref(vs_args *f, vs_value v, void *to, bool *oom) {
  vs_ref ref = vs_bind_take_ref(v);
  if (!ref.node) return false;
  vs_ref *slot = vs_bind_grow(f, to);
  if (!slot) return *oom = true, false;
  *slot = ref;
  return true;
}
static bool add_curve(vs_args *f, vs_value v, void *to, bool *oom) {
  const vs_node *n = vs_bind_take_ref(v).node;
  return n && (n->class_ == VS_CURVE || vs_node_is_empty(n)) && add_ref(f, v, to, oom);
}
/* Adds a section of a loft to the array: a curve or a region itself, a point as a line with one point. Returns false if
 * v is none of these. Sets *oom when memory is out. */
static bool add_section(vs_args *f, vs_value v, void *to, bool *oom) {
  const vs_node *object = vs_bind_take_ref(v).node;
  if (object)
    return (object->class_ == VS_CURVE || object->class_ == VS_REGION_CLASS || vs_node_is_empty(object)) &&
           add_ref(f, v, to, oom);
  if (!vs_is_flat(v, VS_FLAT_POINT) || !finite3(vs_as_flat(v)->at)) return false;
  vs_vec3 at = vec_of(vs_as_flat(v)->at);
  vs_points *p = vs_points_new(f->store, &at, 1);
  vs_node *n = p ? vs_node_new(f->store, VS_LINE, &(struct vs_line){ .points = p }, NULL, 0) : NULL;
  if (p) vs_points_release(f->store, p);
  vs_ref *slot = vs_bind_keep(f, n) ? vs_bind_grow(f, to) : NULL;
  if (!slot) return *oom = true, false;
  *slot = (vs_ref){ n, NULL };
  return true;
}
static bool add_point(vs_args *f, vs_value v, void *to, bool *oom) {
  if (!vs_is_flat(v, VS_FLAT_POINT) || !finite3(vs_as_flat(v)->at)) return false;
  vs_vec3 *slot = vs_bind_grow(f, to);
  if (!slot) return *oom = true, false;
  *slot = vec_of(vs_as_flat(v)->at);
  return true;
}

typedef struct { vs_growing refs, points; } grow_things;
static bool add_thing(vs_args *f, vs_value v, void *to, bool *oom) {
  grow_things *g = to;
  return vs_bind_take_ref(v).node ? add_ref(f, v, &g->refs, oom) : add_point(f, v, &g->points, oom);
}

bool vs_bind_take_refs(vs_args *f, vs_value list, vs_ref **out, size_t *count, vs_value *bad) {
  vs_growing g = { .size = sizeof(vs_ref) };
  if (!flatten(f, &list, 1, add_ref, &g, bad)) return false;
  *out = g.at, *count = g.count;
  return true;
}

/* Called if numbers were given instead of points: writes the points that were probably meant. For 0 0 1 0, for (0 0) (1
 * 0) and for lists of such arguments, it writes (make-polygon (xy 0 0) (xy 1 0)). If arguments of other kinds precede
 * the points, it writes (list (xy 0 0) (xy 1 0)). Returns false if there are values other than numbers. */
static bool points_meant(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, char *text, size_t room) {
  enum { MOST = 64, SHOWN = 4 };
  vs_value item[MOST];
  double all[3 * MOST], d[3];
  size_t count = 0, numbers = 0, each = 0;
  vs_value first = n == 1 && vs_is_pair(v[0]) ? vs_car(v[0]) : VS_NIL;
  if (first != VS_NIL && (vs_is_pair(first) || vs_is_vector(first) || !vs_bind_take_numbers(f->vm, v[0], d)))
    for (vs_value l = v[0]; vs_is_pair(l) && count < MOST; l = vs_cdr(l)) item[count++] = vs_car(l);
  else
    while (count < n && count < MOST) item[count] = v[count], count++;
  for (size_t i = 0; i < count; i++) {
    size_t listed = vs_bind_take_number(f->vm, item[i], d) ? 1 : (size_t)vs_bind_take_numbers(f->vm, item[i], d);
    if (listed == 0 || (i > 0 && listed != each)) return false;
    each = listed;
    for (size_t k = 0; k < listed; k++) all[numbers++] = d[k];
  }
  if (each == 1) each = numbers % 2 == 0 ? 2 : 3;
  if (numbers < 2 * each || numbers % each != 0) return false; /* a single point makes no line, so the numbers were not
                                                                * meant as points */
  char name[64], x[3][32];
  size_t at = (size_t)snprintf(text, room, "(%s", p->mode == VS_ARG_REST ? vs_bind_own_name(f, name) : "list");
  for (size_t i = 0; i < numbers; i += each) {
    if (i == SHOWN * each) {
      at += (size_t)snprintf(text + at, room - at, " ...");
      break;
    }
    for (size_t k = 0; k < 3; k++) vs_bind_number_text(x[k], k < each ? all[i + k] : 0);
    if (each == 2) at += (size_t)snprintf(text + at, room - at, " (xy %.16s %.16s)", x[0], x[1]);
    else at += (size_t)snprintf(text + at, room - at, " (xyz %.16s %.16s %.16s)", x[0], x[1], x[2]);
  }
  snprintf(text + at, room - at, ")");
  return true;
}

/* Refuses an item of a list. If the item is the value of an expression without a result, the error names the usual
 * causes: an `if` without else, a `for-each` instead of a `map`. */
static vs_status refuse_item(vs_args *f, const vs_bind_param *p, const vs_value *given, size_t count, vs_value bad,
                             const char *item) {
  if (bad == VS_ABSENT) return VS_ERROR; /* the error is already set */
  if (bad == VS_UNSPECIFIC)
    return vs_fail(f->vm, f->vm->sym.type, "%s must hold only %ss, but " VS_BIND_NO_VALUE, p->name, item);
  if (vs_bind_refuse_uncalled(f, p, bad)) return VS_ERROR;
  char text[96], meant[400], expected[480];
  snprintf(text, sizeof text, "%s", vs_contract_noun(p->contract));
  double d;
  if (!strcmp(item, "point") && points_meant(f, p, given, count, meant, sizeof meant)) {
    snprintf(expected, sizeof expected, "a point or a list of points (%s?)", meant);
    return vs_bind_refuse(f, p->name, expected, bad);
  }
  if (!strcmp(item, "point") && vs_bind_take_number(f->vm, bad, &d))
    return vs_bind_refuse(f, p->name, "a point or a list of points, each written (xy x y) or (xyz x y z)", bad);
  if (!strcmp(item, "point") && vs_is_flat(bad, VS_FLAT_VECTOR))
    return vs_bind_refuse_hint(f, p->name, text, bad, "(+ origin v)");
  bool holds_points = p->contract == VS_C_POINTS || p->contract == VS_C_THINGS || p->contract == VS_C_SECTIONS;
  if (holds_points && vs_is_flat(bad, VS_FLAT_POINT)) return vs_bind_refuse(f, p->name, "of finite coordinates", bad);
  return vs_bind_refuse(f, p->name, text, bad);
}

vs_status vs_convert_all_refs(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  vs_growing g = { .size = sizeof(vs_ref) };
  vs_value bad;
  bool curves = p->contract == VS_C_CURVES, sections = p->contract == VS_C_SECTIONS;
  if (!flatten(f, v, n, curves ? add_curve : sections ? add_section : add_ref, &g, &bad))
    return refuse_item(f, p, v, n, bad, curves ? "curve" : sections ? "section" : "object");
  out->refs.at = g.at, out->refs.count = g.count;
  return VS_OK;
}

vs_status vs_convert_all_points(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  vs_growing g = { .size = sizeof(vs_vec3) };
  vs_value bad;
  if (!flatten(f, v, n, add_point, &g, &bad)) return refuse_item(f, p, v, n, bad, "point");
  out->points.at = g.at, out->points.count = g.count;
  return VS_OK;
}

vs_status vs_convert_all_things(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  grow_things g = { { .size = sizeof(vs_ref) }, { .size = sizeof(vs_vec3) } };
  vs_value bad;
  if (!flatten(f, v, n, add_thing, &g, &bad)) return refuse_item(f, p, v, n, bad, "object");
  out->things.at = g.refs.at, out->things.count = g.refs.count;
  out->things.points = g.points.at, out->things.point_count = g.points.count;
  return VS_OK;
}

/* Sets *out to the object v or, if v is a list of objects, to their union. */
static vs_status one_object(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->ref = vs_bind_take_ref(v);
  if (out->ref.node) return VS_OK;
  vs_arg list;
  if (!vs_convert_all_refs(f, p, &v, 1, &list)) return VS_ERROR;
  if (list.refs.count == 1) return out->ref = list.refs.at[0], VS_OK;
  /* Several closed curves form one profile, so their areas are united. */
  if (p->contract == VS_C_PROFILE && !vs_bind_fill(f, list.refs.at, list.refs.count)) return VS_ERROR;
  vs_node *n = vs_node_new(f->store, list.refs.count ? VS_UNION : VS_EMPTY,
                           list.refs.count ? (const void *)&(struct vs_union){ 0 } : &(struct vs_empty){ 0 },
                           list.refs.at, list.refs.count);
  if (!vs_bind_keep(f, n)) return VS_ERROR;
  out->ref = (vs_ref){ n, vs_bind_origin(f->bind) };
  return VS_OK;
}

static bool has_no_end(const vs_node *n) { /* returns true for an xline or a ray (infinite lines), perhaps inside
                                            * placements */
  while (vs_node_is_around(n)) n = n->children[0].node;
  return vs_node_has(n, VS_IS_UNRESOLVED) && !n->child_count;
}

static bool class_fits(vs_contract c, const vs_node *n) {
  if (n->class_ == VS_NOTHING) return true;
  if ((c == VS_C_CURVE || c == VS_C_PROFILE || c == VS_C_FLAT) && n->class_ == VS_CURVE && has_no_end(n)) return false;
  if (c == VS_C_CURVE) return n->class_ == VS_CURVE;
  if (c == VS_C_PROFILE) return n->class_ == VS_CURVE || n->class_ == VS_REGION_CLASS;
  if (c == VS_C_FLAT) return n->class_ == VS_CURVE || n->class_ == VS_REGION_CLASS || n->class_ == VS_SURFACE;
  return c != VS_C_SOLID || n->class_ == VS_SOLID;
}

/* Returns true if v is a list of exactly three elements, as most faces are. */
static bool has_three(vs_value v) {
  for (int i = 0; i < 3; i++, v = vs_cdr(v))
    if (!vs_is_pair(v)) return false;
  return v == VS_NIL;
}

vs_status vs_convert_faces(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  int64_t count = vs_list_length(v);
  if (count < 0) return vs_bind_refuse_kind(f, p, v);
  vs_growing starts = { .size = sizeof(uint32_t) }, corners = { .size = sizeof(uint32_t) };
  uint32_t *slot = vs_bind_grow(f, &starts);
  if (!slot) return VS_ERROR;
  *slot = 0;
  for (vs_value l = v; l != VS_NIL; l = vs_cdr(l)) {
    vs_value face = vs_car(l);
    if (!has_three(face) && vs_list_length(face) < 3) return vs_bind_refuse_kind(f, p, face);
    if (!vs_poll(f->vm, 16)) return VS_ERROR;
    for (vs_value c = face; c != VS_NIL; c = vs_cdr(c)) {
      vs_value index = vs_car(c);
      if (!vs_is_fixnum(index) || vs_fixnum(index) < 1 || vs_fixnum(index) > UINT32_MAX)
        return vs_bind_refuse(f, p->name, "lists of exact integers from 1", index);
      if (!(slot = vs_bind_grow(f, &corners))) return VS_ERROR;
      *slot = (uint32_t)(vs_fixnum(index) - 1);
    }
    if (corners.count > UINT32_MAX / 2) return vs_fail_memory(f->vm);
    if (!(slot = vs_bind_grow(f, &starts))) return VS_ERROR;
    *slot = (uint32_t)corners.count;
  }
  out->faces.starts = starts.at, out->faces.corners = corners.at, out->faces.count = starts.count - 1;
  return VS_OK;
}

/* Converts an object; a list of objects becomes their union. Refuses an object that is not of the class in the
 * contract. */
vs_status vs_convert_object(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!one_object(f, p, v, out)) return VS_ERROR;
  return class_fits((vs_contract)p->contract, out->ref.node) ? VS_OK : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_refs(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return vs_convert_all_refs(f, p, &v, 1, out);
}

vs_status vs_convert_points(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return vs_convert_all_points(f, p, &v, 1, out);
}

vs_status vs_convert_things(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return vs_convert_all_things(f, p, &v, 1, out);
}

/* Converts the argument that says how far a profile is extruded: a curve, a gvector, or a height along Z. */
vs_status vs_convert_path(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->ref = vs_bind_take_ref(v);
  if (out->ref.node) return class_fits(VS_C_CURVE, out->ref.node) ? VS_OK : vs_bind_refuse_kind(f, p, v);
  if (!vs_is_flat(v, VS_FLAT_VECTOR)) return vs_convert_real(f, p, v, out);
  out->point = vec_of(vs_as_flat(v)->at);
  return finite3(vs_as_flat(v)->at) ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_scope(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->scope = vs_bind_take_scope(v);
  return out->scope ? VS_OK : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_rule(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  (void)out;
  return vs_is_rule(v) ? VS_OK : vs_bind_refuse_kind(f, p, v);
}

/* ---- materials and colours ---- */

/* Refuses a name that is no material, and suggests the probable spelling: "#ff8800" for "#f80", or the most similar
 * name. */
static vs_status refuse_material(vs_args *f, const vs_bind_param *p, vs_value got, const char *name) {
  char hint[64];
  const char *near = vs_nearest_word(name, vs_ready_material_name);
  if (name[0] == '#' && strlen(name) == 4 && strspn(name + 1, "0123456789abcdefABCDEF") == 3)
    snprintf(hint, sizeof hint, "\"#%c%c%c%c%c%c\"", name[1], name[1], name[2], name[2], name[3], name[3]);
  else if (near) snprintf(hint, sizeof hint, "\"%s\"", near);
  else return vs_bind_refuse_kind(f, p, got);
  return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
}

/* Refuses a colour of three numbers, of which one is not between 0 and 1. If all are between 0 and 255, and one is 32
 * or more, the error suggests the numbers divided by 255, since other programs use the range 0 to 255. */
static vs_status refuse_parts(vs_args *f, const vs_bind_param *p, vs_value got) {
  double c[3];
  char hint[96];
  vs_value l = got;
  for (int i = 0; i < 3; i++, l = vs_cdr(l))
    if (!vs_bind_take_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 255))
      return vs_bind_refuse_kind(f, p, got);
  if (c[0] < 32 && c[1] < 32 && c[2] < 32) return vs_bind_refuse_kind(f, p, got);
  snprintf(hint, sizeof hint, "(list %.3g %.3g %.3g)", c[0] / 255, c[1] / 255, c[2] / 255);
  return vs_bind_refuse_hint(f, p->name, vs_contract_noun(p->contract), got, hint);
}

/* Returns true if the name ends as the name of a photograph's file does. */
static bool is_photograph(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot && (!strcasecmp(dot, ".png") || !strcasecmp(dot, ".jpg") || !strcasecmp(dot, ".jpeg"));
}

/* Creates the material for the file of a photograph: a matt surface with the photograph as its pattern, one metre
 * wide. */
static vs_status convert_photograph(vs_args *f, vs_value v, vs_arg *out) {
  vs_material m = { .roughness = 0.9, .ior = 1.5, .pattern = { .kind = VS_PATTERN_PICTURE } };
  double mean[3];
  if (vs_bind_picture(f, v, &m.pattern.picture, &m.name, mean) != VS_OK) return VS_ERROR;
  m.red = mean[0], m.green = mean[1], m.blue = mean[2];
  out->material = vs_store_material(f->store, &m);
  return out->material ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_convert_material(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->material = vs_foreign_get(v, &vs_paint_type);
  if (out->material) return VS_OK;
  if (vs_is_pair(v) && p->contract == VS_C_COLOR && vs_list_length(v) == 3) {
    double c[3];
    vs_value l = v;
    for (int i = 0; i < 3; i++, l = vs_cdr(l))
      if (!vs_bind_take_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 1)) return refuse_parts(f, p, v);
    vs_material m = vs_material_default;
    m.red = c[0], m.green = c[1], m.blue = c[2];
    out->material = vs_store_material(f->store, &m);
    return out->material ? VS_OK : vs_fail_memory(f->vm);
  }
  if (!vs_is_string(v) && !vs_is_symbol(v)) return vs_bind_refuse_kind(f, p, v);
  vs_arg name;
  if (!vs_convert_text(f, p, v, &name)) return VS_ERROR;
  if (p->contract == VS_C_MATERIAL && vs_is_string(v) && is_photograph(name.text.at))
    return convert_photograph(f, v, out);
  size_t refused = vs_bind_refused(f->vm);
  out->material = vs_store_ready_material(f->store, name.text.at);
  return out->material                           ? VS_OK
         : vs_bind_refused(f->vm) != refused ? vs_fail_memory(f->vm)
                                                 : refuse_material(f, p, v, name.text.at);
}
