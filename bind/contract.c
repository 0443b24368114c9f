/* Owns the checked call: from a native's arguments to the C data that procedures.def asks for, or the error that says
 * what was wrong.
 *
 * Cost of a call: one pass over the form's parameters; nothing is allocated unless an argument is a list. Memory that
 * the checks allocate hangs off the arguments and goes when the call ends, whatever its outcome. */
#include "bind/functions/dual_points.h"
#include "bind/constructors/files.h"
#include "bind/rules/derivation.h"
#include "vm/library/kept.h"
#include "vm/numbers/dual.h"

#include <stdio.h>
#include <strings.h>

#include "vm/machine/arguments.h"
#include "vm/numbers/number.h"
#include "model/looks/ready_materials.h"

/* ---- the tables ---- */

#define ARG(name, contract) name " "
#define OPT(name, contract) "[" name "] "
#define REST(name, contract) ". " name " "
#define KEY(name, contract) "#:" name " "
#define FORM(...) __VA_ARGS__
#define KEYS(...) __VA_ARGS__
#define PROC(id, name, fn, doc, forms, keys) { name, "" forms keys, vs_bind_enter, 0, doc },
#define PROCS(id, name, signature, fn, doc, forms, keys) { name, signature, vs_bind_enter, 0, doc },
const vs_native_def vs_bind_defs[] = {
#include "bind/procedures.def"
  { NULL, NULL, NULL, 0, NULL }
};
#undef ARG
#undef OPT
#undef REST
#undef KEY
#undef FORM
#undef KEYS
#undef PROC
#undef PROCS

#define ARG(name, contract) { name, VS_ARG_REQUIRED, VS_C_##contract },
#define OPT(name, contract) { name, VS_ARG_OPTIONAL, VS_C_##contract },
#define REST(name, contract) { name, VS_ARG_REST, VS_C_##contract },
#define KEY(name, contract) { name, VS_ARG_OPTIONAL, VS_C_##contract },
#define FORM(...) { 1, { __VA_ARGS__ { "", VS_ARG_END, 0 } } },
#define KEYS(...) { __VA_ARGS__ { "", VS_ARG_END, 0 } }
#define PROC(id, name, fn, doc, forms, keys) { { forms }, keys },
#define PROCS(id, name, signature, fn, doc, forms, keys) { { forms }, keys },
const vs_procedure vs_bind_procedures[] = {
#include "bind/procedures.def"
};
#undef ARG
#undef OPT
#undef REST
#undef KEY
#undef FORM
#undef KEYS
#undef PROC
#undef PROCS

#define PROC(id, name, fn, doc, forms, keys) fn,
#define PROCS(id, name, signature, fn, doc, forms, keys) fn,
vs_procedure_fn *const vs_bind_functions[] = {
#include "bind/procedures.def"
};
#undef PROC
#undef PROCS

const vs_native_table vs_bind_table = { "geometry", vs_bind_defs };

static const struct { const char *noun, *condition; } contracts[] = {
#define VS_CONTRACT(name, noun, condition) { noun, condition },
#include "bind/contracts.def"
#undef VS_CONTRACT
};

static const char *own_name(const vs_args *f, char room[64]) { /* the first of its names */
  const char *names = vs_bind_defs[f->procedure - vs_bind_procedures].name;
  size_t n = strcspn(names, " ");
  if (n > 63) n = 63;
  if (*names == '%') names++, n--; /* a helper speaks for the procedure that it helps */
  memcpy(room, names, n);
  room[n] = 0;
  return room;
}

/* ---- scratch ---- */

struct vs_scratch {
  struct vs_scratch *next;
  size_t bytes;
  vs_node *node;
  max_align_t data[];
};

static struct vs_scratch *scratch_new(vs_args *f, size_t bytes) {
  struct vs_scratch *s = vs_mem(f->vm, NULL, 0, sizeof *s + bytes);
  if (!s) return (void)vs_fail_memory(f->vm), NULL;
  *s = (struct vs_scratch){ .next = f->scratch, .bytes = sizeof *s + bytes };
  return f->scratch = s;
}

void *vs_bind_scratch(vs_args *f, size_t bytes) {
  struct vs_scratch *s = scratch_new(f, bytes);
  return s ? (void *)s->data : NULL;
}

bool vs_bind_keep(vs_args *f, vs_node *node) {
  if (!node) return vs_fail_memory(f->vm);
  struct vs_scratch *s = scratch_new(f, 0);
  if (!s) return vs_node_release(node), false;
  s->node = node;
  return true;
}

void vs_bind_scratch_free(vs_args *f) {
  while (f->scratch) {
    struct vs_scratch *s = f->scratch;
    f->scratch = s->next;
    vs_node_release(s->node);
    vs_mem(f->vm, s, s->bytes, 0);
  }
}

/* ---- refusing ---- */

vs_status vs_bind_refuse(vs_args *f, const char *param, const char *expected, vs_value got) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = got;
  if (!vs_cons(f->vm, r[0], VS_NIL, &r[1])) return VS_ERROR;
  return vs_fail_with(f->vm, f->vm->sym.type, r[1], "%s must be %s, got", param, expected);
}

static vs_status refuse_hint(vs_args *f, const char *param, const char *expected, vs_value got, const char *hint) {
  char text[256];
  snprintf(text, sizeof text, "%s (%s?)", expected, hint);
  return vs_bind_refuse(f, param, text, got);
}

static vs_status convert_text(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out);

/* Two or three numbers in a list or a vector; how many, 0: it is something else. */
static int listed_numbers(vs_scheme *vm, vs_value v, double d[3]) {
  int n = 0;
  d[0] = d[1] = d[2] = 0;
  if (vs_is_vector(v)) {
    const vs_vector *w = vs_as_vector(v);
    while (w->length <= 3 && n < (int)w->length && vs_bind_number(vm, w->at[n], &d[n])) n++;
    return w->length == (size_t)n && n >= 2 ? n : 0;
  }
  for (; vs_is_pair(v) && n < 3 && vs_bind_number(vm, vs_car(v), &d[n]); v = vs_cdr(v)) n++;
  return v == VS_NIL && n >= 2 ? n : 0;
}

/* A procedure where its result is wanted: "..., got the procedure wall; call it: (wall length)". False: v is none. */
static bool refuse_uncalled(vs_args *f, const vs_bind_param *p, vs_value v) {
  char form[120];
  if (!vs_is(v, VS_T_CLOSURE) && !vs_is(v, VS_T_NATIVE)) return false;
  const char *call = vs_procedure_form(v, form, sizeof form);
  if (!call)
    return vs_is(v, VS_T_CLOSURE) && !vs_fail(f->vm, f->vm->sym.type,
                                              "%s must be %s, got #<procedure>, which waits to be called: a lambda, or "
                                              "a call that lacks arguments as (subtract a) does",
                                              p->name, contracts[p->contract].noun);
  size_t name = strcspn(call + 1, " )");
  vs_fail(f->vm, f->vm->sym.type, "%s must be %s, got the procedure %.*s; call it: %s", p->name,
      contracts[p->contract].noun, (int)name, call + 1, call);
  return true;
}

/* The kind is wrong. Where a point and a gvector were taken for each other, say how to write the other. */
static vs_status refuse_kind(vs_args *f, const vs_bind_param *p, vs_value got) {
  if (vs_is_dual(got))
    return vs_fail(f->vm, f->vm->sym.type,
                   "%s is a number that is being differentiated; objects hold plain numbers, so derivatives end here",
                   p->name);
  bool wants_vector = p->contract == VS_C_VECTOR || p->contract == VS_C_DIRECTION || p->contract == VS_C_PATH,
       wants_point = p->contract == VS_C_POINT;
  if ((wants_vector && vs_is_flat(got, VS_FLAT_POINT)) || (wants_point && vs_is_flat(got, VS_FLAT_VECTOR))) {
    const double *d = vs_as_flat(got)->at;
    char x[32], y[32], z[32], hint[128];
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    snprintf(hint, sizeof hint, "(%s %s %s %s)", wants_vector ? "vxyz" : "xyz", x, y, z);
    return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
  }
  double d[3];
  int listed = wants_vector || wants_point ? listed_numbers(f->vm, got, d) : 0;
  if (listed) {
    char x[32], y[32], z[32], hint[128];
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    if (listed == 2 && wants_point) snprintf(hint, sizeof hint, "(xy %s %s)", x, y);
    else snprintf(hint, sizeof hint, "(%s %s %s %s)", wants_vector ? "vxyz" : "xyz", x, y, z);
    return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
  }
  if (refuse_uncalled(f, p, got)) return VS_ERROR;
  const vs_bind_param *first = f->procedure->form[0].at;
  if (wants_point && vs_bind_number(f->vm, got, d) && (!strcmp(p->name, "apex") || !strcmp(p->name, "c2"))) {
    char number[32], hint[96]; /* a height where the solid's other end is due */
    vs_bind_number_text(number, d[0]);
    snprintf(hint, sizeof hint, "(+z %s %s)", first->name, number);
    return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
  }
  if (p->contract == VS_C_ANGLE && first->mode != VS_ARG_END && first->contract == VS_C_SECTIONS &&
      vs_bind_ref(got).node)
    return refuse_hint(f, p->name, contracts[p->contract].noun, got,
                       "the sections stand in one list: (list section ...)");
  vs_arg word; /* 'walls for "walls", "top" for 'top */
  if (((p->contract == VS_C_TEXT && vs_is_symbol(got)) || (p->contract == VS_C_NAME && vs_is_string(got))) &&
      convert_text(f, p, got, &word) && word.text.length < 40 &&
      strcspn(word.text.at, " \t\n\"'()") == word.text.length) {
    char hint[64];
    snprintf(hint, sizeof hint, p->contract == VS_C_TEXT ? "\"%s\"" : "'%s", word.text.at);
    return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
  }
  return vs_bind_refuse(f, p->name, contracts[p->contract].noun, got);
}
static vs_status refuse_condition(vs_args *f, const vs_bind_param *p, vs_value got) {
  return vs_bind_refuse(f, p->name, contracts[p->contract].condition, got);
}

/* ---- converting ---- */

bool vs_bind_number(vs_scheme *vm, vs_value v, double *out) {
  if (vs_is_double(v)) *out = vs_double(v);
  else if (vs_is_fixnum(v)) *out = (double)vs_fixnum(v);
  else return vs_is_number(v) && vs_number_double(vm, v, out);
  return true;
}

static bool finite3(const double *d) { return isfinite(d[0]) && isfinite(d[1]) && isfinite(d[2]); }
static vs_vec3 vec_of(const double *d) { return vs_v3(d[0], d[1], d[2]); }
static bool has_length(vs_vec3 v) { return v.x != 0 || v.y != 0 || v.z != 0; }

static bool symbol_is(vs_value v, const char *name) { return vs_is_symbol(v) && !strcmp(vs_as_symbol(v)->name, name); }

/* The names of the world's axes, and those of the planes across them. */
static const char *const axis_names[3] = { "x", "y", "z" }, *const plane_names[3] = { "yz", "xz", "xy" };

static bool world_axis(vs_value v, const char *const names[3], vs_vec3 *out) {
  for (int i = 0; i < 3; i++)
    if (symbol_is(v, names[i])) return *out = vs_v3(i == 0, i == 1, i == 2), true;
  return false;
}

/* A line through the origin along x, y or z, by one of three names or by a vector; or any, by an object of that
 * kind. */
static bool convert_line(vs_value v, const char *const names[3], uint32_t kind, vs_arg *out) {
  out->line.at = vs_v3(0, 0, 0);
  if (world_axis(v, names, &out->line.direction)) return true;
  if (vs_is_flat(v, VS_FLAT_VECTOR)) return out->line.direction = vec_of(vs_as_flat(v)->at), true;
  if (!vs_is_flat(v, kind)) return false;
  out->line.at = vec_of(vs_as_flat(v)->at), out->line.direction = vec_of(vs_as_flat(v)->at + 3);
  return true;
}

static bool convert_axis(vs_value v, vs_arg *out) { return convert_line(v, axis_names, VS_FLAT_AXIS, out); }
static bool convert_plane(vs_value v, vs_arg *out) { /* its normal */
  return convert_line(v, plane_names, VS_FLAT_PLANE, out);
}

/* Flattens values (each an item or a list of lists of items) by an explicit stack of lists, each with what is left of
 * it; add takes one item. False: *bad is what is neither, or absent and the error is set. Nothing here allocates Scheme
 * objects, so plain locals are safe. A list that contains itself makes the stack grow for ever, its lists coming round
 * again; so each new one is compared with the one at the highest power of two below (Brent's way). */
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

/* a growing array in scratch: in its place where it is the newest there, else anew, and the old one stays until the
 * call ends */
typedef struct { void *at; size_t count, room, size; } grow;
static void *grow_push(vs_args *f, grow *g) {
  if (g->count == g->room) {
    size_t room = g->room ? g->room * 2 : 8;
    struct vs_scratch *last = f->scratch;
    if (g->at && last && (void *)last->data == g->at) {
      size_t bytes = sizeof *last + room * g->size;
      last = vs_mem(f->vm, last, last->bytes, bytes);
      if (!last) return (void)vs_fail_memory(f->vm), NULL;
      last->bytes = bytes;
      f->scratch = last;
      g->at = last->data, g->room = room;
      return (char *)g->at + g->size * g->count++;
    }
    void *at = vs_bind_scratch(f, room * g->size);
    if (!at) return NULL;
    if (g->count) memcpy(at, g->at, g->count * g->size);
    g->at = at, g->room = room;
  }
  return (char *)g->at + g->size * g->count++;
}

static bool add_ref(vs_args *f, vs_value v, void *to, bool *oom) {
  vs_ref ref = vs_bind_ref(v);
  if (!ref.node) return false;
  vs_ref *slot = grow_push(f, to);
  if (!slot) return *oom = true, false;
  *slot = ref;
  return true;
}
static bool add_curve(vs_args *f, vs_value v, void *to, bool *oom) {
  const vs_node *n = vs_bind_ref(v).node;
  return n && (n->class_ == VS_CURVE || vs_bind_is_empty(n)) && add_ref(f, v, to, oom);
}
/* a section: a curve, a region, or a point, which becomes a line of one point */
static bool add_section(vs_args *f, vs_value v, void *to, bool *oom) {
  const vs_node *object = vs_bind_ref(v).node;
  if (object)
    return (object->class_ == VS_CURVE || object->class_ == VS_REGION_CLASS || vs_bind_is_empty(object)) &&
           add_ref(f, v, to, oom);
  if (!vs_is_flat(v, VS_FLAT_POINT) || !finite3(vs_as_flat(v)->at)) return false;
  vs_vec3 at = vec_of(vs_as_flat(v)->at);
  vs_points *p = vs_points_new(f->bind->store, &at, 1);
  vs_node *n = p ? vs_node_new(f->bind->store, VS_LINE, &(struct vs_line){ .points = p }, NULL, 0) : NULL;
  if (p) vs_points_release(f->bind->store, p);
  vs_ref *slot = vs_bind_keep(f, n) ? grow_push(f, to) : NULL;
  if (!slot) return *oom = true, false;
  *slot = (vs_ref){ n, NULL };
  return true;
}
static bool add_point(vs_args *f, vs_value v, void *to, bool *oom) {
  if (!vs_is_flat(v, VS_FLAT_POINT) || !finite3(vs_as_flat(v)->at)) return false;
  vs_vec3 *slot = grow_push(f, to);
  if (!slot) return *oom = true, false;
  *slot = vec_of(vs_as_flat(v)->at);
  return true;
}

typedef struct { grow refs, points; } grow_things;
static bool add_thing(vs_args *f, vs_value v, void *to, bool *oom) {
  grow_things *g = to;
  return vs_bind_ref(v).node ? add_ref(f, v, &g->refs, oom) : add_point(f, v, &g->points, oom);
}

bool vs_bind_refs(vs_args *f, vs_value list, vs_ref **out, size_t *count, vs_value *bad) {
  grow g = { .size = sizeof(vs_ref) };
  if (!flatten(f, &list, 1, add_ref, &g, bad)) return false;
  *out = g.at, *count = g.count;
  return true;
}

/* Writes what numbers where points belong seem to mean, as (make-polygon (xy 0 0) (xy 1 0)) for 0 0 1 0, for (0 0) (1
 * 0) or for a list of either, and (list (xy 0 0) (xy 1 0)) where the points are one argument among others. False:
 * something else stands among them. */
static bool points_meant(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, char *text, size_t room) {
  enum { MOST = 64, SHOWN = 4 };
  vs_value item[MOST];
  double all[3 * MOST], d[3];
  size_t count = 0, numbers = 0, each = 0;
  vs_value first = n == 1 && vs_is_pair(v[0]) ? vs_car(v[0]) : VS_NIL;
  if (first != VS_NIL && (vs_is_pair(first) || vs_is_vector(first) || !listed_numbers(f->vm, v[0], d)))
    for (vs_value l = v[0]; vs_is_pair(l) && count < MOST; l = vs_cdr(l)) item[count++] = vs_car(l);
  else
    while (count < n && count < MOST) item[count] = v[count], count++;
  for (size_t i = 0; i < count; i++) {
    size_t listed = vs_bind_number(f->vm, item[i], d) ? 1 : (size_t)listed_numbers(f->vm, item[i], d);
    if (listed == 0 || (i > 0 && listed != each)) return false;
    each = listed;
    for (size_t k = 0; k < listed; k++) all[numbers++] = d[k];
  }
  if (each == 1) each = numbers % 2 == 0 ? 2 : 3;
  if (numbers < 2 * each || numbers % each != 0) return false; /* one point is no line: nobody means it */
  char name[64], x[3][32];
  size_t at = (size_t)snprintf(text, room, "(%s", p->mode == VS_ARG_REST ? own_name(f, name) : "list");
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

/* An `if` without else, a `for-each` in place of a `map`: the commonest ways to get no value. */
static vs_status refuse_item(vs_args *f, const vs_bind_param *p, const vs_value *given, size_t count, vs_value bad,
                             const char *item) {
  if (bad == VS_ABSENT) return VS_ERROR; /* the error is set */
  if (bad == VS_UNSPECIFIC)
    return vs_fail(f->vm, f->vm->sym.type, "%s must hold only %ss, but " VS_BIND_NO_VALUE, p->name, item);
  if (refuse_uncalled(f, p, bad)) return VS_ERROR;
  char text[96], meant[400], expected[480];
  snprintf(text, sizeof text, "%s", contracts[p->contract].noun);
  double d;
  if (!strcmp(item, "point") && points_meant(f, p, given, count, meant, sizeof meant)) {
    snprintf(expected, sizeof expected, "a point or a list of points (%s?)", meant);
    return vs_bind_refuse(f, p->name, expected, bad);
  }
  if (!strcmp(item, "point") && vs_bind_number(f->vm, bad, &d))
    return vs_bind_refuse(f, p->name, "a point or a list of points, each written (xy x y) or (xyz x y z)", bad);
  if (!strcmp(item, "point") && vs_is_flat(bad, VS_FLAT_VECTOR))
    return refuse_hint(f, p->name, text, bad, "(+ origin v)");
  bool holds_points = p->contract == VS_C_POINTS || p->contract == VS_C_THINGS || p->contract == VS_C_SECTIONS;
  if (holds_points && vs_is_flat(bad, VS_FLAT_POINT)) return vs_bind_refuse(f, p->name, "of finite coordinates", bad);
  return vs_bind_refuse(f, p->name, text, bad);
}

static vs_status convert_refs(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  grow g = { .size = sizeof(vs_ref) };
  vs_value bad;
  bool curves = p->contract == VS_C_CURVES, sections = p->contract == VS_C_SECTIONS;
  if (!flatten(f, v, n, curves ? add_curve : sections ? add_section : add_ref, &g, &bad))
    return refuse_item(f, p, v, n, bad, curves ? "curve" : sections ? "section" : "object");
  out->refs.at = g.at, out->refs.count = g.count;
  return VS_OK;
}

static vs_status convert_points(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  grow g = { .size = sizeof(vs_vec3) };
  vs_value bad;
  if (!flatten(f, v, n, add_point, &g, &bad)) return refuse_item(f, p, v, n, bad, "point");
  out->points.at = g.at, out->points.count = g.count;
  return VS_OK;
}

static vs_status convert_things(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out) {
  grow_things g = { { .size = sizeof(vs_ref) }, { .size = sizeof(vs_vec3) } };
  vs_value bad;
  if (!flatten(f, v, n, add_thing, &g, &bad)) return refuse_item(f, p, v, n, bad, "object");
  out->things.at = g.refs.at, out->things.count = g.refs.count;
  out->things.points = g.points.at, out->things.point_count = g.points.count;
  return VS_OK;
}

/* one object, or the union of a list */
static vs_status convert_object(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->ref = vs_bind_ref(v);
  if (out->ref.node) return VS_OK;
  vs_arg list;
  if (!convert_refs(f, p, &v, 1, &list)) return VS_ERROR;
  if (list.refs.count == 1) return out->ref = list.refs.at[0], VS_OK;
  /* several closed curves are one profile */
  if (p->contract == VS_C_PROFILE && !vs_bind_fill(f, list.refs.at, list.refs.count)) return VS_ERROR;
  vs_node *n = vs_node_new(f->bind->store, list.refs.count ? VS_UNION : VS_EMPTY,
                           list.refs.count ? (const void *)&(struct vs_union){ 0 } : &(struct vs_empty){ 0 },
                           list.refs.at, list.refs.count);
  if (!vs_bind_keep(f, n)) return VS_ERROR;
  out->ref = (vs_ref){ n, vs_bind_origin(f->bind) };
  return VS_OK;
}

static bool has_no_end(const vs_node *n) { /* an xline or a ray, placed or bare */
  while (n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER) n = n->children[0].node;
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

/* A list of three, as nearly all faces are? */
static bool has_three(vs_value v) {
  for (int i = 0; i < 3; i++, v = vs_cdr(v))
    if (!vs_is_pair(v)) return false;
  return v == VS_NIL;
}

static vs_status convert_faces(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  int64_t count = vs_list_length(v);
  if (count < 0) return refuse_kind(f, p, v);
  grow starts = { .size = sizeof(uint32_t) }, corners = { .size = sizeof(uint32_t) };
  uint32_t *slot = grow_push(f, &starts);
  if (!slot) return VS_ERROR;
  *slot = 0;
  for (vs_value l = v; l != VS_NIL; l = vs_cdr(l)) {
    vs_value face = vs_car(l);
    if (!has_three(face) && vs_list_length(face) < 3) return refuse_kind(f, p, face);
    if (!vs_poll(f->vm, 16)) return VS_ERROR;
    for (vs_value c = face; c != VS_NIL; c = vs_cdr(c)) {
      vs_value index = vs_car(c);
      if (!vs_is_fixnum(index) || vs_fixnum(index) < 1 || vs_fixnum(index) > UINT32_MAX)
        return vs_bind_refuse(f, p->name, "lists of exact integers from 1", index);
      if (!(slot = grow_push(f, &corners))) return VS_ERROR;
      *slot = (uint32_t)(vs_fixnum(index) - 1);
    }
    if (corners.count > UINT32_MAX / 2) return vs_fail_memory(f->vm);
    if (!(slot = grow_push(f, &starts))) return VS_ERROR;
    *slot = (uint32_t)corners.count;
  }
  out->faces.starts = starts.at, out->faces.corners = corners.at, out->faces.count = starts.count - 1;
  return VS_OK;
}

static vs_status convert_text(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  char *text;
  size_t bytes;
  if (!vs_is_string(v) && !vs_is_symbol(v)) return refuse_kind(f, p, v);
  if (!vs_bind_text(f->vm, v, &text, &bytes)) return VS_ERROR;
  char *kept = vs_bind_scratch(f, bytes);
  if (kept) memcpy(kept, text, bytes);
  vs_mem(f->vm, text, bytes, 0);
  out->text.at = kept, out->text.length = bytes - 1;
  return kept ? VS_OK : VS_ERROR;
}

/* The spelling that was meant: "#f80", or a name with a slip. */
static vs_status refuse_material(vs_args *f, const vs_bind_param *p, vs_value got, const char *name) {
  char hint[64];
  const char *near = vs_nearest_word(name, vs_ready_material_name);
  if (name[0] == '#' && strlen(name) == 4 && strspn(name + 1, "0123456789abcdefABCDEF") == 3)
    snprintf(hint, sizeof hint, "\"#%c%c%c%c%c%c\"", name[1], name[1], name[2], name[2], name[3], name[3]);
  else if (near) snprintf(hint, sizeof hint, "\"%s\"", near);
  else return refuse_kind(f, p, got);
  return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
}

/* Three numbers, not all from 0 to 1: from 0 to 255, and not all small, they are what other programs take. */
static vs_status refuse_parts(vs_args *f, const vs_bind_param *p, vs_value got) {
  double c[3];
  char hint[96];
  vs_value l = got;
  for (int i = 0; i < 3; i++, l = vs_cdr(l))
    if (!vs_bind_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 255)) return refuse_kind(f, p, got);
  if (c[0] < 32 && c[1] < 32 && c[2] < 32) return refuse_kind(f, p, got);
  snprintf(hint, sizeof hint, "(list %.3g %.3g %.3g)", c[0] / 255, c[1] / 255, c[2] / 255);
  return refuse_hint(f, p->name, contracts[p->contract].noun, got, hint);
}

/* a material from a paint, or from a name; a colour also from three numbers */
static bool is_photograph(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot && (!strcasecmp(dot, ".png") || !strcasecmp(dot, ".jpg") || !strcasecmp(dot, ".jpeg"));
}

/* A material by its photograph: a matt surface, the picture a metre wide. */
static vs_status convert_photograph(vs_args *f, vs_value v, vs_arg *out) {
  vs_material m = { .roughness = 0.9, .ior = 1.5, .pattern = { .kind = VS_PATTERN_PICTURE } };
  double mean[3];
  if (vs_bind_picture(f, v, &m.pattern.picture, &m.name, mean) != VS_OK) return VS_ERROR;
  m.red = mean[0], m.green = mean[1], m.blue = mean[2];
  out->material = vs_store_material(f->bind->store, &m);
  return out->material ? VS_OK : vs_fail_memory(f->vm);
}

static vs_status convert_material(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->material = vs_foreign_get(v, &vs_paint_type);
  if (out->material) return VS_OK;
  if (vs_is_pair(v) && p->contract == VS_C_COLOR && vs_list_length(v) == 3) {
    double c[3];
    vs_value l = v;
    for (int i = 0; i < 3; i++, l = vs_cdr(l))
      if (!vs_bind_number(f->vm, vs_car(l), &c[i]) || !(c[i] >= 0 && c[i] <= 1)) return refuse_parts(f, p, v);
    vs_material m = { "", c[0], c[1], c[2], .5, 0, 0, 1.5, { 0 } };
    out->material = vs_store_material(f->bind->store, &m);
    return out->material ? VS_OK : vs_fail_memory(f->vm);
  }
  if (!vs_is_string(v) && !vs_is_symbol(v)) return refuse_kind(f, p, v);
  vs_arg name;
  if (!convert_text(f, p, v, &name)) return VS_ERROR;
  if (p->contract == VS_C_MATERIAL && vs_is_string(v) && is_photograph(name.text.at))
    return convert_photograph(f, v, out);
  size_t refused = f->bind->refused;
  out->material = vs_store_ready_material(f->bind->store, name.text.at);
  return out->material                 ? VS_OK
         : f->bind->refused != refused ? vs_fail_memory(f->vm)
                                       : refuse_material(f, p, v, name.text.at);
}

static vs_status convert_real(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_bind_number(f->vm, v, &out->real)) return refuse_kind(f, p, v);
  if (!isfinite(out->real)) return vs_bind_refuse(f, p->name, "finite", v);
  return VS_OK;
}

static vs_status convert_integer(vs_args *f, const vs_bind_param *p, vs_value v, int64_t low, int64_t high,
                                 vs_arg *out) {
  if (!vs_is_fixnum(v)) return refuse_kind(f, p, v);
  out->integer = vs_fixnum(v);
  if (out->integer > high && high == INT32_MAX) return vs_bind_refuse(f, p->name, "at most 2147483647", v);
  return out->integer >= low && out->integer <= high ? VS_OK : refuse_condition(f, p, v);
}

static vs_status convert(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->given = true, out->value = v;
  switch ((vs_contract)p->contract) {
    case VS_C_ANY: return VS_OK;
    case VS_C_REAL: case VS_C_DEGREES: return convert_real(f, p, v, out);
    case VS_C_RADIUS:
      return !convert_real(f, p, v, out) ? VS_ERROR : out->real >= 0 ? VS_OK : refuse_condition(f, p, v);
    case VS_C_POSITIVE:
      return !convert_real(f, p, v, out) ? VS_ERROR : out->real > 0 ? VS_OK : refuse_condition(f, p, v);
    case VS_C_UNIT:
      return !convert_real(f, p, v, out)        ? VS_ERROR
             : out->real >= 0 && out->real <= 1 ? VS_OK
                                                : refuse_condition(f, p, v);
    case VS_C_ANGLE:
      if (!convert_real(f, p, v, out)) return VS_ERROR;
      if (vs_is_fixnum(v) && (out->real > 6 || out->real < -6)) {
        char name[64];
        vs_bind_warn(f->bind, "degrees", "%s: %.0f radians are %.1f turns; (degrees->radians %.0f)?", own_name(f, name),
                     out->real, fabs(out->real) / 6.283185307179586, out->real);
      }
      return VS_OK;
    case VS_C_SOME: return convert_integer(f, p, v, 1, INT32_MAX, out);
    case VS_C_NATURAL: return convert_integer(f, p, v, 0, INT32_MAX, out);
    case VS_C_SIDES: return convert_integer(f, p, v, 3, 100000, out);
    case VS_C_SEGMENTS:
      if (v == VS_FALSE) return out->integer = 0, VS_OK;
      return convert_integer(f, p, v, 3, 100000, out);
    case VS_C_BOOLEAN:
      out->boolean = v != VS_FALSE;
      return v == VS_TRUE || v == VS_FALSE ? VS_OK : refuse_kind(f, p, v);
    case VS_C_TEXT: return vs_is_string(v) ? convert_text(f, p, v, out) : refuse_kind(f, p, v);
    case VS_C_NAME: return vs_is_symbol(v) ? convert_text(f, p, v, out) : refuse_kind(f, p, v);
    case VS_C_POINT:
      if (!vs_is_flat(v, VS_FLAT_POINT)) return refuse_kind(f, p, v);
      out->point = vec_of(vs_as_flat(v)->at);
      return finite3(vs_as_flat(v)->at) ? VS_OK : refuse_condition(f, p, v);
    case VS_C_DIRECTION:
      if (world_axis(v, axis_names, &out->point)) return VS_OK;
      /* fall through */
    case VS_C_VECTOR:
      if (!vs_is_flat(v, VS_FLAT_VECTOR)) return refuse_kind(f, p, v);
      out->point = vec_of(vs_as_flat(v)->at);
      if (!finite3(vs_as_flat(v)->at)) return vs_bind_refuse(f, p->name, "of finite coordinates", v);
      return p->contract == VS_C_VECTOR || has_length(out->point) ? VS_OK : refuse_condition(f, p, v);
    case VS_C_PLACE:
      if (!vs_is_flat(v, VS_FLAT_POINT) && !vs_is_flat(v, VS_FLAT_VECTOR)) return refuse_kind(f, p, v);
      return out->point = vec_of(vs_as_flat(v)->at), VS_OK;
    case VS_C_NUMERIC:
      if (vs_is(v, VS_T_FLAT)) return VS_OK;
      return vs_bind_number(f->vm, v, &out->real) ? VS_OK : refuse_kind(f, p, v);
    case VS_C_AXIS: case VS_C_PLANE: case VS_C_STAND:
      if (!(p->contract == VS_C_AXIS ? convert_axis : convert_plane)(v, out)) return refuse_kind(f, p, v);
      return has_length(out->line.direction) && finite3(&out->line.direction.x) && finite3(&out->line.at.x)
                 ? VS_OK
                 : refuse_condition(f, p, v);
    case VS_C_CUT: /* a height is the plane there, of which the lower side is kept */
      if (v == VS_FALSE) return VS_OK;
      if (vs_bind_number(f->vm, v, &out->real)) {
        double height = out->real;
        out->line.at = vs_v3(0, 0, height), out->line.direction = vs_v3(0, 0, -1);
      } else if (!convert_plane(v, out)) {
        return refuse_kind(f, p, v);
      }
      return has_length(out->line.direction) && finite3(&out->line.direction.x) && finite3(&out->line.at.x)
          ? VS_OK : refuse_condition(f, p, v);
    case VS_C_MATRIX:
      if (!vs_is_flat(v, VS_FLAT_MATRIX)) return refuse_kind(f, p, v);
      return out->matrix = vs_bind_affine(vs_as_flat(v)->at), VS_OK;
    case VS_C_FACTOR: {
      double d[3];
      if (vs_is_flat(v, VS_FLAT_VECTOR)) memcpy(d, vs_as_flat(v)->at, sizeof d);
      else if (vs_is_pair(v) && vs_list_length(v) == 3) {
        vs_value l = v;
        for (int i = 0; i < 3; i++, l = vs_cdr(l))
          if (!vs_bind_number(f->vm, vs_car(l), &d[i])) return refuse_kind(f, p, v);
      } else if (vs_bind_number(f->vm, v, &d[0])) d[1] = d[2] = d[0];
      else return refuse_kind(f, p, v);
      out->point = vec_of(d);
      return finite3(d) && d[0] > 0 && d[1] > 0 && d[2] > 0 ? VS_OK : refuse_condition(f, p, v);
    }
    case VS_C_OBJECT: case VS_C_CURVE: case VS_C_PROFILE: case VS_C_FLAT: case VS_C_SOLID:
      if (!convert_object(f, p, v, out)) return VS_ERROR;
      return class_fits((vs_contract)p->contract, out->ref.node) ? VS_OK : refuse_kind(f, p, v);
    case VS_C_OBJECTS: case VS_C_CURVES: case VS_C_SECTIONS: return convert_refs(f, p, &v, 1, out);
    case VS_C_POINTS: return convert_points(f, p, &v, 1, out);
    case VS_C_THINGS: return convert_things(f, p, &v, 1, out);
    case VS_C_FACES: return convert_faces(f, p, v, out);
    case VS_C_PATH:
      out->ref = vs_bind_ref(v);
      if (out->ref.node) return class_fits(VS_C_CURVE, out->ref.node) ? VS_OK : refuse_kind(f, p, v);
      if (!vs_is_flat(v, VS_FLAT_VECTOR)) return convert_real(f, p, v, out);
      return out->point = vec_of(vs_as_flat(v)->at), finite3(vs_as_flat(v)->at) ? VS_OK : refuse_condition(f, p, v);
    case VS_C_TANGENT:
      if (vs_is_flat(v, VS_FLAT_VECTOR)) out->point = vec_of(vs_as_flat(v)->at);
      else if (!convert_real(f, p, v, out)) return VS_ERROR;
      else {
        double s, c;
        vs_sincos(out->real, &s, &c);
        out->point = vs_v3(c, s, 0);
      }
      return finite3(&out->point.x) && has_length(out->point) ? VS_OK : refuse_condition(f, p, v);
    case VS_C_MATERIAL: case VS_C_COLOR: return convert_material(f, p, v, out);
    case VS_C_SCOPE:
      out->scope = vs_bind_scope(v);
      return out->scope ? VS_OK : refuse_kind(f, p, v);
    case VS_C_OWN_AXIS:
      for (int i = 0; i < 3; i++)
        if (symbol_is(v, (const char *const[]){ "x", "y", "z" }[i])) return out->integer = i, VS_OK;
      return refuse_kind(f, p, v);
    case VS_C_RULE: return vs_is_rule(v) ? VS_OK : refuse_kind(f, p, v);
  }
  return vs_bind_refuse(f, p->name, "known", v); /* not reached: every contract is above */
}

/* ---- choosing the form ---- */

/* Is v of this contract's kind, by a look that cannot fail? Only what tells the forms of one procedure apart. */
static bool looks_like(vs_args *f, vs_contract c, vs_value v) {
  vs_arg unused;
  if (c == VS_C_POINT) return vs_is_flat(v, VS_FLAT_POINT);
  if (c == VS_C_VECTOR || c == VS_C_DIRECTION) return vs_is_flat(v, VS_FLAT_VECTOR);
  if (c == VS_C_AXIS) return convert_axis(v, &unused);
  if (c == VS_C_REAL || c == VS_C_RADIUS || c == VS_C_POSITIVE || c == VS_C_ANGLE)
    return vs_bind_number(f->vm, v, &unused.real);
  return true;
}

static size_t append(char *text, size_t room, size_t at, const char *more) {
  int n = snprintf(text + at, room - at, "%s", more);
  return n < 0 ? at : at + (size_t)n < room ? at + (size_t)n : room - 1;
}

void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room) {
  size_t at = append(text, room, 0, "takes ");
  for (int i = 0; i < VS_MAX_FORMS && procedure->form[i].used; i++) {
    if (i) at = append(text, room, at, " or ");
    at = append(text, room, append(text, room, at, "("), name);
    for (const vs_bind_param *p = procedure->form[i].at; p->mode != VS_ARG_END; p++) {
      at = append(text, room, at, p->mode == VS_ARG_OPTIONAL ? " [" : " ");
      at = append(text, room, at, p->name);
      at = append(text, room, at, p->mode == VS_ARG_OPTIONAL ? "]" : p->mode == VS_ARG_REST ? " ..." : "");
    }
    at = append(text, room, at, ")");
  }
}

/* No form takes so many arguments: show them all, and what beginners mean by three numbers. */
static vs_status refuse_count(vs_args *f, const vs_value *a, int n) {
  char name[64], text[512], hint[300];
  vs_bind_forms(f->procedure, own_name(f, name), text, sizeof text);
  double d[3];
  bool two_corners = f->procedure->form[1].used && f->procedure->form[0].at[1].contract == VS_C_POINT &&
      f->procedure->form[0].at[2].mode == VS_ARG_END;
  if (two_corners && n == 3 && vs_bind_number(f->vm, a[0], &d[0]) && vs_bind_number(f->vm, a[1], &d[1]) &&
      vs_bind_number(f->vm, a[2], &d[2])) {
    char x[32], y[32], z[32]; /* one corner is the origin */
    vs_bind_number_text(x, d[0]), vs_bind_number_text(y, d[1]), vs_bind_number_text(z, d[2]);
    snprintf(hint, sizeof hint, "(%s (xyz 0 0 0) (xyz %s %s %s))", name, x, y, z);
    return vs_fail(f->vm, f->vm->sym.arity, "%s; perhaps %s", text, hint);
  }
  if (vs_bind_grouped(f->vm, f->procedure, name, a, n, hint, sizeof hint)) return vs_fail(f->vm, f->vm->sym.arity,
      "%s; perhaps %s", text, hint);
  return vs_fail(f->vm, f->vm->sym.arity, "%s, got %d argument%s", text, n, n == 1 ? "" : "s");
}

/* How many of n arguments look like the form's first parameters (0 where there is no other form); -1: it takes fewer,
 * or more. */
static int form_fits(vs_args *f, const vs_form *form, const vs_value *a, int n) {
  int fits = f->procedure->form[1].used ? 0 : -1;
  const vs_bind_param *p = form->at;
  for (int i = 0; i < n && p->mode != VS_ARG_REST; i++, p++) {
    if (p->mode == VS_ARG_END) return -1;
    if (fits == i && looks_like(f, (vs_contract)p->contract, a[i])) fits++;
  }
  if (p->mode == VS_ARG_REQUIRED) return -1; /* they come first */
  if (p->mode == VS_ARG_REST && fits >= 0 && fits < n && looks_like(f, (vs_contract)p->contract, a[fits])) fits++;
  return fits < 0 ? 0 : fits;
}

/* the number of the form, or -1 with the error set */
static int choose_form(vs_args *f, const vs_value *a, int n) {
  int best = -1, best_fits = -1;
  for (int i = 0; i < VS_MAX_FORMS && f->procedure->form[i].used; i++) {
    int fits = form_fits(f, &f->procedure->form[i], a, n);
    if (fits > best_fits) best = i, best_fits = fits;
    if (fits == n) break;
  }
  if (best < 0) refuse_count(f, a, n);
  return best;
}

/* Every reading of what is absent gives 0: but for a matrix, which nobody reads then. */
static inline void set_absent(vs_arg *to) {
  to->given = false, to->value = VS_ABSENT;
  to->line.at = to->line.direction = vs_v3(0, 0, 0);
}

/* Points and numbers that are as they should be, which most calls take: the form chosen and its arguments converted in
 * one go, as choose_form and convert do. False: those see to it. */
typedef enum { QUICK_FITS, QUICK_OTHER /* looks_like says no */, QUICK_UNSURE } quick;
static inline quick convert_quickly(const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->given = true, out->value = v;
  if (p->contract == VS_C_POINT) {
    if (!vs_is_flat(v, VS_FLAT_POINT)) return QUICK_OTHER;
    out->point = vec_of(vs_as_flat(v)->at);
    return finite3(vs_as_flat(v)->at) ? QUICK_FITS : QUICK_UNSURE;
  }
  if (p->contract != VS_C_REAL && p->contract != VS_C_RADIUS && p->contract != VS_C_POSITIVE) return QUICK_UNSURE;
  if (vs_is_fixnum(v)) out->real = (double)vs_fixnum(v);
  else if (vs_is_double(v)) out->real = vs_double(v);
  else return vs_is(v, VS_T_FLAT) ? QUICK_OTHER : QUICK_UNSURE;
  return isfinite(out->real) && (p->contract == VS_C_REAL || out->real > 0) ? QUICK_FITS : QUICK_UNSURE;
}

static bool enter_quickly(vs_args *f, const vs_value *a, int n) {
  for (f->form = 0; f->form < VS_MAX_FORMS && f->procedure->form[f->form].used; f->form++) {
    const vs_bind_param *p = f->procedure->form[f->form].at;
    quick fits = QUICK_FITS;
    int i = 0;
    for (; i < n && fits == QUICK_FITS; i++, p++)
      if (p->mode == VS_ARG_REST) fits = QUICK_UNSURE;
      else fits = p->mode == VS_ARG_END ? QUICK_OTHER : convert_quickly(p, a[i], &f->arg[i]);
    if (fits == QUICK_UNSURE || p->mode == VS_ARG_REST) return false;
    if (fits == QUICK_OTHER || p->mode == VS_ARG_REQUIRED) continue;
    for (; p->mode == VS_ARG_OPTIONAL; i++, p++) set_absent(&f->arg[i]);
    f->count = i;
    return p->mode == VS_ARG_END;
  }
  return false;
}

/* ---- the one native ---- */

/* The form's arguments, one by one. */
static bool enter_slowly(vs_args *f, const vs_value *a, int given) {
  f->form = choose_form(f, a, given);
  if (f->form < 0) return false;
  const vs_form *form = &f->procedure->form[f->form];
  for (int i = 0; form->at[i].mode != VS_ARG_END; i++) {
    const vs_bind_param *p = &form->at[i];
    vs_arg *to = &f->arg[i];
    f->count = i + 1;
    if (p->mode == VS_ARG_REST) {
      const vs_value *rest = a + i;
      size_t count = given > i ? (size_t)(given - i) : 0;
      *to = (vs_arg){ .given = true, .value = VS_UNSPECIFIC };
      if (p->contract == VS_C_POINTS) { if (!convert_points(f, p, rest, count, to)) return false; }
      else if (p->contract == VS_C_THINGS) { if (!convert_things(f, p, rest, count, to)) return false; }
      else if (p->contract == VS_C_ANY) to->values.at = rest, to->values.count = count;
      else if (!convert_refs(f, p, rest, count, to)) return false;
      continue;
    }
    if (i >= given) set_absent(to);
    else if (!convert(f, p, a[i], to)) return false;
  }
  return true;
}

static vs_status run(vs_args *f, vs_value *a, int n, vs_value *out) {
  bool keyed = f->procedure->key[0].mode != VS_ARG_END;
  int given = n, places = n;
  /* a[] holds every positional place, then the keywords; behind a rest just these */
  if (keyed && f->vm->native->max != UINT32_MAX) {
    places = (int)f->vm->native->max;
    for (given = 0; given < places && a[given] != VS_ABSENT; given++) {}
  }
  if (!enter_quickly(f, a, given)) {
    vs_status status;
    bool duals = vs_is_fixnum(vs_lib_get(f->vm, VS_LIB_DUALS)); /* a differentiation has begun */
    if (duals && vs_dual_level(a, (size_t)given) >= 0 && vs_dual_points(f, a, given, out, &status)) return status;
    if (!enter_slowly(f, a, given)) return VS_ERROR;
  }
  for (int i = 0; f->procedure->key[i].mode != VS_ARG_END; i++) {
    vs_value v = a[places + i];
    if (v == VS_ABSENT) set_absent(&f->key[i]);
    else if (!convert(f, &f->procedure->key[i], v, &f->key[i])) return VS_ERROR;
  }
  const vs_arg *stand = NULL;
  for (int i = 0; i < VS_MAX_KEYS && f->procedure->key[i].mode != VS_ARG_END; i++)
    if (f->procedure->key[i].contract == VS_C_STAND && f->key[i].given) stand = &f->key[i];
  vs_status status = vs_bind_function(f)(f, out);
  return stand && status == VS_OK ? vs_bind_stand(f, stand, out) : status;
}

vs_status vs_bind_enter(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_args f; /* arguments are set one by one: clearing all of it would cost more than most procedures */
  f.vm = vm, f.bind = vs_bind_of(vm), f.scratch = NULL, f.count = 0;
  f.procedure = &vs_bind_procedures[vm->native->def - vs_bind_defs];
  vs_status s = run(&f, a, n, out);
  vs_bind_scratch_free(&f);
  return s;
}
