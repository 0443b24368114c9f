/* Implements a host's handles: numbers that refer to values of a program. Contains the table of handles, and the
 * functions by which hosts create and read values.
 *
 * A handle consists of the index of a table entry and a stamp. The entry gets a new stamp each time it is used for
 * another value, and two interpreters begin with different stamps. A released handle, or a handle of another
 * interpreter, is therefore detected. The values themselves are in a vector of the heap, which the garbage collector
 * visits. */
#include "session/handles.h"

#include <stdarg.h>
#include <stdio.h>

#include "bind/call/take.h"
#include "bind/objects.h"
#include "bind/records.h"
#include "session/evaluation.h"
#include "session/host.h"
#include "session/report.h"
#include "vm/front/environment.h"
#include "vm/machine/fail.h"
#include "vm/machine/run.h"
#include "vm/numbers/integer.h"
#include "vm/numbers/number.h"
#include "vm/numbers/number_text.h"
#include "vm/values/heap.h"

enum { HOST_HELD = 5 }; /* index in the VM's vector at.host of the vector that contains the handles' values */

/* ---- errors ---- */

static void usage(vs_session *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void usage(vs_session *s, const char *format, ...) {
  char text[300];
  va_list rest;
  va_start(rest, format);
  vsnprintf(text, sizeof text, format, rest);
  va_end(rest);
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_USAGE, (vs_span){ 0 }, text);
}

bool vs_session_busy(vs_session *s, const char *who) {
  if (!s->phase && !s->writing) return false;
  usage(s,
      "%s: the interpreter is running: a callback may not run code in it; vs_post queues a change for vs_update", who);
  return true;
}

/* ---- the table of handles ---- */

static vs_handles *table(vs_session *s) {
  if (s->handles) return s->handles;
  s->handles = vs_session_memory(s, NULL, 0, sizeof *s->handles);
  if (!s->handles) return NULL;
  memset(s->handles, 0, sizeof *s->handles);
  s->handles->stamp = (uint32_t)(((uintptr_t)s >> 4) * UINT64_C(2654435761)) & 0x7fffffff;
  return s->handles;
}

static bool grow(vs_session *s, void *array, size_t *room, size_t need, size_t size) {
  void **at = array;
  if (need <= *room) return true;
  size_t more = *room ? 2 * *room : 16;
  void *grown = vs_session_memory(s, *at, *room * size, more * size);
  if (!grown) return false;
  *at = grown, *room = more;
  return true;
}

/* Enlarges the vector of values to at least `need` elements. */
static bool grow_values(vs_session *s, size_t need) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  vs_vector *host = vs_as_vector(vm->at.host);
  size_t room = vs_is_vector(host->at[HOST_HELD]) ? vs_as_vector(host->at[HOST_HELD])->length : 0;
  if (need <= room) return true;
  if (!vs_make_vector(vm, room ? 2 * room : 16, VS_FALSE, &r[0])) return false;
  host = vs_as_vector(vm->at.host);
  for (size_t i = 0; i < room; i++)
    vs_gc_store(vm, vs_as_vector(r[0]), &vs_as_vector(r[0])->at[i], vs_as_vector(host->at[HOST_HELD])->at[i]);
  vs_gc_store(vm, host, &host->at[HOST_HELD], r[0]);
  return true;
}

static vs_value *slot(vs_session *s, size_t i) {
  return &vs_as_vector(vs_as_vector(s->bind.vm->at.host)->at[HOST_HELD])->at[i];
}

vs_handle vs_session_hold(vs_session *s, const vs_value *value) {
  vs_handles *t = table(s);
  size_t i = t && t->free ? t->free - 1 : t ? t->count : 0;
  if (!t || !grow(s, &t->at, &t->room, i + 1, sizeof *t->at) || !grow_values(s, i + 1))
      return vs_session_out_of_memory(s), 0;
  if (i < t->count) t->free = t->at[i].next;
  else t->count++;
  if (++t->stamp == 0) t->stamp = 1;
  t->at[i] = (vs_held){ .stamp = t->stamp, .uses = 1 };
  vs_value vector = vs_as_vector(s->bind.vm->at.host)->at[HOST_HELD];
  vs_gc_store(s->bind.vm, vs_as_vector(vector), slot(s, i), *value);
  return (uint64_t)t->stamp << 32 | (i + 1);
}

/* Returns the table entry of the handle h. If h is not valid, reports an error and returns NULL. */
static vs_held *entry(vs_session *s, const char *who, vs_handle h) {
  vs_handles *t = s->handles;
  size_t i = (size_t)(h & 0xffffffff);
  if (t && i > 0 && i <= t->count && t->at[i - 1].uses && t->at[i - 1].stamp == h >> 32) return &t->at[i - 1];
  if (h == 0) usage(s, "%s: 0 is not a handle", who);
  else usage(s, "%s: this handle is another interpreter's, was released, or is older than vs_restart", who);
  return NULL;
}

bool vs_session_held(vs_session *s, const char *who, vs_handle h, vs_value *out) {
  vs_held *e = entry(s, who, h);
  if (e) *out = *slot(s, (size_t)(e - s->handles->at));
  return e != NULL;
}

vs_handle vs_handle_retain(vs_scheme *vm, vs_handle h) {
  vs_held *e = entry(vs_session_of(vm), "vs_handle_retain", h);
  return e ? e->uses++, h : 0;
}

void vs_handle_release(vs_scheme *vm, vs_handle h) {
  vs_session *s = vs_session_of(vm);
  vs_held *e = h ? entry(s, "vs_handle_release", h) : NULL;
  if (!e || --e->uses) return;
  size_t i = (size_t)(e - s->handles->at);
  *slot(s, i) = VS_FALSE;
  e->next = s->handles->free;
  s->handles->free = (uint32_t)i + 1;
}

/* ---- the host's objects ---- */

/* An object of the host, to which a value of the heap refers. When the garbage collector frees that value, it puts the
 * object into the list `gone`. After the collection, the host's release function is called for the object. */
struct vs_host_object {
  vs_session *session;
  void *object;
  void (*release)(void *context, void *object);
  void *context;
  vs_host_object *next;
};

static void host_object_gone(void *object) {
  vs_host_object *o = object;
  o->next = o->session->handles->gone;
  o->session->handles->gone = o;
}
static const vs_foreign_type host_object_type = { "an object of the host's", host_object_gone, NULL, NULL, NULL, NULL,
    false };

void vs_session_release_objects(vs_session *s) {
  const char *phase = s->phase;
  for (vs_host_object *o; s->handles && (o = s->handles->gone) != NULL;) {
    s->handles->gone = o->next;
    s->phase = "evaluating"; /* while the host's release function runs, the interpreter counts as busy */
    if (o->release) o->release(o->context, o->object);
    s->phase = phase;
    vs_session_memory(s, o, sizeof *o, 0);
  }
}

vs_handle vs_handle_host(vs_scheme *vm, void *object, void (*release)(void *context, void *object), void *context) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 1);
  vs_host_object *o = table(s) ? vs_session_memory(s, NULL, 0, sizeof *o) : NULL;
  if (!o) return vs_session_out_of_memory(s), 0;
  *o = (vs_host_object){ .session = s, .object = object }; /* the member `release` is not set yet: if memory runs out
                                                            * below, the host still owns the object */
  if (!vs_make_foreign(vm, &host_object_type, o, sizeof *o, &r[0])) return vs_session_out_of_memory(s), 0;
  vs_handle made = vs_session_hold(s, r);
  if (made) o->release = release, o->context = context;
  return made;
}

void *vs_handle_get_host(vs_scheme *vm, vs_handle h) {
  vs_value v;
  if (!vs_session_held(vs_session_of(vm), "vs_handle_get_host", h, &v)) return NULL;
  const vs_host_object *o = vs_foreign_get(v, &host_object_type);
  return o ? o->object : NULL;
}

void vs_session_forget_handles(vs_session *s) {
  vs_handles *t = s->handles;
  if (!t) return;
  vs_session_release_objects(s);
  t->count = t->free = 0;
  t->procedure_count = t->posted_count = 0;
}

void vs_session_free_handles(vs_session *s) {
  vs_handles *t = s->handles;
  if (!t) return;
  vs_session_release_objects(s);
  vs_session_memory(s, t->at, t->room * sizeof *t->at, 0);
  vs_session_memory(s, t->procedures, t->procedure_room * sizeof *t->procedures, 0);
  vs_session_memory(s, t->posted, t->posted_room * sizeof *t->posted, 0);
  vs_session_memory(s, t->text, t->text_bytes, 0);
  vs_session_memory(s, t, sizeof *t, 0);
  s->handles = NULL;
}

/* ---- functions that create values ---- */

vs_handle vs_handle_boolean(vs_scheme *vm, bool b) { return vs_session_hold(vs_session_of(vm),
    &(vs_value){ vs_bool(b) }); }
vs_handle vs_handle_number(vs_scheme *vm, double x) { return vs_session_hold(vs_session_of(vm),
    &(vs_value){ vs_flonum(x) }); }

vs_handle vs_handle_integer(vs_scheme *vm, int64_t n) {
  VS_ROOTS(vm, r, 1);
  if (!vs_int_from_int64(vm, n, &r[0])) return vs_session_out_of_memory(vs_session_of(vm)), 0;
  return vs_session_hold(vs_session_of(vm), r);
}
vs_handle vs_handle_number_text(vs_scheme *vm, const char *text) {
  VS_ROOTS(vm, r, 1);
  if (!vs_number_parse(vm, text, strlen(text), 10, &r[0])) return vs_session_out_of_memory(vs_session_of(vm)), 0;
  if (!vs_is_number(r[0]))
    return usage(vs_session_of(vm), "vs_handle_number_text: \"%.60s\" is no number", text), 0;
  return vs_session_hold(vs_session_of(vm), r);
}
vs_handle vs_handle_text(vs_scheme *vm, const char *text) { return vs_handle_text_bytes(vm, text, strlen(text)); }
vs_handle vs_handle_text_bytes(vs_scheme *vm, const char *text, size_t length) {
  VS_ROOTS(vm, r, 1);
  if (!vs_string_from_utf8(vm, text, length, &r[0])) return vs_session_out_of_memory(vs_session_of(vm)), 0;
  return vs_session_hold(vs_session_of(vm), r);
}
vs_handle vs_handle_symbol(vs_scheme *vm, const char *name) {
  VS_ROOTS(vm, r, 1);
  if (!vs_intern(vm, name, strlen(name), &r[0])) return vs_session_out_of_memory(vs_session_of(vm)), 0;
  return vs_session_hold(vs_session_of(vm), r);
}
static vs_handle flat(vs_scheme *vm, uint32_t tag, double x, double y, double z) {
  VS_ROOTS(vm, r, 1);
  if (!vs_make_flat(vm, tag, (const double[]){ x, y, z }, 3, &r[0])) return vs_session_out_of_memory(vs_session_of(vm)),
      0;
  return vs_session_hold(vs_session_of(vm), r);
}
vs_handle vs_handle_point(vs_scheme *vm, double x, double y, double z) { return flat(vm, VS_FLAT_POINT, x, y, z); }
vs_handle vs_handle_vector(vs_scheme *vm, double x, double y, double z) { return flat(vm, VS_FLAT_VECTOR, x, y, z); }

vs_handle vs_handle_list(vs_scheme *vm, const vs_handle *items, size_t count) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = count; i-- > 0;) {
    if (!vs_session_held(s, "vs_handle_list", items[i], &r[1])) return 0;
    if (!vs_cons(vm, r[1], r[0], &r[0])) return vs_session_out_of_memory(s), 0;
  }
  return vs_session_hold(s, r);
}

/* ---- functions that read values ---- */

static bool is_record(vs_value v, const char *type) {
  if (!vs_is(v, VS_T_RECORD)) return false;
  vs_value name = vs_as_record_type(vs_as_record(v)->type)->name;
  return vs_is_symbol(name) && !strcmp(vs_as_symbol(name)->name, type);
}

vs_handle_kind vs_handle_kind_of(vs_scheme *vm, vs_handle h) {
  vs_value v;
  if (!vs_session_held(vs_session_of(vm), "vs_handle_kind_of", h, &v)) return VS_HANDLE_NONE;
  if (v == VS_TRUE || v == VS_FALSE) return VS_HANDLE_BOOLEAN;
  if (vs_is_number(v)) return VS_HANDLE_NUMBER;
  if (vs_is_string(v)) return VS_HANDLE_TEXT;
  if (vs_is_symbol(v)) return VS_HANDLE_SYMBOL;
  if (vs_list_length(v) >= 0) return VS_HANDLE_LIST;
  if (vs_is_flat(v, VS_FLAT_POINT)) return VS_HANDLE_POINT;
  if (vs_is_flat(v, VS_FLAT_VECTOR)) return VS_HANDLE_VECTOR;
  if (vs_is_flat(v, VS_FLAT_MATRIX)) return VS_HANDLE_MATRIX;
  if (vs_bind_take_ref(v).node) return VS_HANDLE_OBJECT;
  if (is_record(v, "%node")) return VS_HANDLE_NODE;
  if (is_record(v, "%property")) return VS_HANDLE_PROPERTY;
  if (vs_foreign_get(v, &host_object_type)) return VS_HANDLE_HOST;
  return vs_is(v, VS_T_NATIVE) || vs_is(v, VS_T_CLOSURE) || vs_is(v, VS_T_CASE) ? VS_HANDLE_PROCEDURE : VS_HANDLE_OTHER;
}

bool vs_handle_get_boolean(vs_scheme *vm, vs_handle h) { /* as in Scheme, every value except #f counts as true */
  vs_value v;
  return vs_session_held(vs_session_of(vm), "vs_handle_get_boolean", h, &v) && v != VS_FALSE;
}

size_t vs_handle_get_numbers(vs_scheme *vm, vs_handle h, double *out, size_t room) {
  vs_value v;
  double one;
  if (!vs_session_held(vs_session_of(vm), "vs_handle_get_numbers", h, &v)) return 0;
  if (vs_is_number(v) && vs_number_double(vm, v, &one)) {
    if (room) *out = one;
    return 1;
  }
  size_t count = vs_is_flat(v, VS_FLAT_MATRIX) ? 16 : vs_is_flat(v, VS_FLAT_POINT) || vs_is_flat(v, VS_FLAT_VECTOR) ? 3
      : 0;
  for (size_t i = 0; i < count && i < room; i++) out[i] = vs_as_flat(v)->at[i];
  return count;
}

bool vs_handle_get_integer(vs_scheme *vm, vs_handle h, int64_t *out) {
  vs_value v;
  return vs_session_held(vs_session_of(vm), "vs_handle_get_integer", h, &v) && vs_is_exact_integer(v) &&
         vs_int_to_int64(v, out);
}

bool vs_handle_is_exact(vs_scheme *vm, vs_handle h) {
  vs_value v;
  return vs_session_held(vs_session_of(vm), "vs_handle_is_exact", h, &v) && vs_is_number(v) && vs_is_exact(v);
}

static bool number_string(vs_scheme *vm, vs_value *v) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_number_print(vm, *v, 10, &t) && vs_text_to_string(&t, v);
  vs_text_close(&t);
  return ok;
}

const char *vs_handle_get_text(vs_scheme *vm, vs_handle h) {
  size_t length;
  return vs_handle_get_text_bytes(vm, h, &length);
}

const char *vs_handle_get_text_bytes(vs_scheme *vm, vs_handle h, size_t *length) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 1);
  *length = 0;
  if (!vs_session_held(s, "vs_handle_get_text", h, &r[0])) return NULL;
  if (vs_is_number(r[0]) && !number_string(vm, &r[0])) return vs_session_out_of_memory(s), NULL;
  if (!vs_is_string(r[0]) && !vs_is_symbol(r[0])) return NULL;
  vs_handles *t = s->handles;
  vs_session_memory(s, t->text, t->text_bytes, 0);
  t->text = NULL, t->text_bytes = 0;
  if (!vs_bind_take_text(vm, r[0], &t->text, &t->text_bytes)) return vs_session_out_of_memory(s), NULL;
  *length = t->text_bytes - 1;
  return t->text;
}

size_t vs_handle_count(vs_scheme *vm, vs_handle h) {
  vs_value v;
  if (!vs_session_held(vs_session_of(vm), "vs_handle_count", h, &v)) return 0;
  int64_t n = vs_list_length(v);
  return n > 0 ? (size_t)n : 0;
}

vs_handle vs_handle_item(vs_scheme *vm, vs_handle h, size_t index) {
  VS_ROOTS(vm, r, 1);
  if (!vs_session_held(vs_session_of(vm), "vs_handle_item", h, &r[0])) return 0;
  while (vs_is_pair(r[0]) && index--) r[0] = vs_cdr(r[0]);
  if (!vs_is_pair(r[0])) return usage(vs_session_of(vm), "vs_handle_item: the list has no such element"), 0;
  r[0] = vs_car(r[0]);
  return vs_session_hold(vs_session_of(vm), r);
}

bool vs_handle_same(vs_scheme *vm, vs_handle a, vs_handle b) {
  vs_value x, y;
  vs_session *s = vs_session_of(vm);
  return vs_session_held(s, "vs_handle_same", a, &x) && vs_session_held(s, "vs_handle_same", b, &y) && x == y;
}

/* ---- names of the program ---- */

vs_handle vs_lookup(vs_scheme *vm, const char *name) {
  VS_ROOTS(vm, r, 1);
  if (!vs_intern(vm, name, strlen(name), &r[0])) return vs_session_out_of_memory(vs_session_of(vm)), 0;
  vs_meaning m = vs_environment_find(vm->at.program, r[0]);
  /* A program in another language cannot name Scheme's procedures, so the core library is searched, too. A name that
   * begins with % belongs to an internal procedure, and is not found. */
  if (m.kind != VS_MEANS_CELL && name[0] != '%') m = vs_environment_find(vm->at.core, r[0]);
  if (m.kind != VS_MEANS_CELL || vs_as_cell(m.value)->value == VS_UNDEFINED)
    return usage(vs_session_of(vm), "vs_lookup: %.200s is not defined", name), 0;
  r[0] = vs_as_cell(m.value)->value;
  return vs_session_hold(vs_session_of(vm), r);
}

/* ---- calling procedures ---- */

static vs_outcome run(vs_session *s, const vs_value *procedure, size_t count, const vs_value *argv, vs_value *result) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  uint64_t stopped = vm->top_place; /* saves the place at which a program has stopped; it is restored after the call,
                                     * for when the program continues */
  vs_session_begin(s, 0);
  vm->top_place = 0; /* a call from the host has no place in a source text */
  bool ok = vs_run(vm, *procedure, count, argv, &r[0]);
  if (ok && result) *result = r[0];
  vs_outcome outcome = vs_session_finish(s, ok, false);
  vm->top_place = stopped;
  return outcome;
}

vs_outcome vs_session_invoke(vs_session *s, const char *name, size_t count, const vs_value *argv, vs_value *result) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, 1);
  if (!vs_intern_c(vm, name, &r[0])) return vs_session_out_of_memory(s);
  r[0] = vs_environment_value(vm->at.core, r[0]);
  return run(s, r, count, argv, result);
}

vs_outcome vs_apply(vs_scheme *vm, vs_handle procedure, const vs_handle *arguments, size_t count, vs_handle *result) {
  enum { MOST = 64 };
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, MOST + 2);
  if (result) *result = 0;
  if (vs_session_busy(s, "vs_apply") || !vs_session_held(s, "vs_apply", procedure, &r[MOST])) return VS_OUTCOME_USAGE;
  if (count > MOST) return usage(s, "vs_apply: at most %d arguments", MOST), VS_OUTCOME_USAGE;
  for (size_t i = 0; i < count; i++)
    if (!vs_session_held(s, "vs_apply", arguments[i], &r[i])) return VS_OUTCOME_USAGE;
  vs_outcome outcome = run(s, &r[MOST], count, r, &r[MOST + 1]);
  if (outcome == VS_OUTCOME_DONE && result && !(*result = vs_session_hold(s, &r[MOST + 1]))) return VS_OUTCOME_MACHINE;
  return outcome;
}

/* ---- procedures of the host ---- */

void vs_host_fail(vs_scheme *vm, const char *message) {
  vs_handles *t = table(vs_session_of(vm));
  if (t) snprintf(t->failure, sizeof t->failure, "%s", message);
}

/* a[0] is the index of the host's procedure; the arguments of the call follow it. */
vs_status vs_session_host_call(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  enum { MOST = 64 };
  vs_session *s = vs_session_of(vm);
  vs_handles *t = s->handles;
  vs_handle handles[MOST], result = 0;
  size_t number = (size_t)vs_fixnum(a[0]), count = (size_t)n - 1, made = 0;
  if (!t || number >= t->procedure_count) return vs_fail(vm, vm->sym.error, "the host's procedure is gone");
  vs_host_entry p = t->procedures[number];
  vm->native = NULL; /* errors begin with the name that the host gave the procedure */
  if (count > MOST)
    return vs_fail(vm, vm->sym.arity, "%s: a procedure of the host accepts at most %d arguments", p.name, MOST);
  while (made < count && (handles[made] = vs_session_hold(s, &a[made + 1])) != 0) made++;
  *t->failure = 0;
  bool ok = made == count && p.fn(p.context, vm, handles, count, &result);
  t = s->handles;
  while (made > 0) vs_handle_release(vm, handles[--made]);
  if (!ok) return vs_fail(vm, vm->sym.error, "%s: %s", p.name, *t->failure ? t->failure : "the host has failed");
  *out = VS_UNSPECIFIC;
  if (!result) return VS_OK;
  if (!vs_session_held(s, p.name, result, out)) return vs_fail(vm, vm->sym.error,
      "%s: the host gave a result that is no handle", p.name);
  vs_handle_release(vm, result);
  return VS_OK;
}

vs_handle vs_host_procedure(vs_scheme *vm, const char *name, vs_host_fn *fn, void *context) {
  vs_session *s = vs_session_of(vm);
  vs_handles *t = table(s);
  VS_ROOTS(vm, r, 2);
  if (vs_session_busy(s, "vs_host_procedure")) return 0;
  if (!t || !grow(s, &t->procedures, &t->procedure_room, t->procedure_count + 1, sizeof *t->procedures))
      return vs_session_out_of_memory(s), 0;
  vs_host_entry made = { fn, context, vs_store_text(s->bind.store, name, strlen(name)) };
  if (!made.name) return vs_session_out_of_memory(s), 0;
  t->procedures[t->procedure_count] = made;
  r[0] = vs_fix((int64_t)t->procedure_count++);
  return vs_session_invoke(s, "%host-procedure", 1, r, &r[1]) == VS_OUTCOME_DONE ? vs_session_hold(s, &r[1]) : 0;
}

bool vs_define(vs_scheme *vm, const char *name, vs_handle value) {
  vs_session *s = vs_session_of(vm);
  VS_ROOTS(vm, r, 2);
  if (vs_session_busy(s, "vs_define") || !vs_session_held(s, "vs_define", value, &r[1])) return false;
  if (!vs_intern(vm, name, strlen(name), &r[0])) return vs_session_out_of_memory(s), false;
  return vs_session_invoke(s, "%host-define", 2, r, NULL) == VS_OUTCOME_DONE;
}

/* ---- posted changes of properties ---- */

bool vs_post(vs_scheme *vm, vs_handle property, vs_handle value) {
  vs_session *s = vs_session_of(vm);
  vs_handles *t = s->handles;
  if (!entry(s, "vs_post", property) || !entry(s, "vs_post", value)) return false;
  if (!grow(s, &t->posted, &t->posted_room, t->posted_count + 1, sizeof *t->posted)) return vs_session_out_of_memory(s),
      false;
  t->posted[t->posted_count++] = (vs_posted){ vs_handle_retain(vm, property), vs_handle_retain(vm, value) };
  return true;
}

vs_outcome vs_update(vs_scheme *vm) {
  vs_session *s = vs_session_of(vm);
  vs_outcome outcome = VS_OUTCOME_DONE;
  VS_ROOTS(vm, r, 2);
  if (vs_session_busy(s, "vs_update")) return VS_OUTCOME_USAGE;
  size_t count = s->handles ? s->handles->posted_count : 0; /* changes that callbacks post during this update wait for
                                                             * the next update */
  for (size_t i = 0; i < count; i++) {
    vs_posted p = s->handles->posted[i];
    bool held = vs_session_held(s, "vs_update", p.property, &r[0]) && vs_session_held(s, "vs_update", p.value, &r[1]);
    vs_outcome one = held ? vs_session_invoke(s, "property-set!", 2, r, NULL) : VS_OUTCOME_USAGE;
    if (one != VS_OUTCOME_DONE && outcome == VS_OUTCOME_DONE) outcome = one;
    vs_handle_release(vm, p.property);
    vs_handle_release(vm, p.value);
  }
  if (count) {
    vs_handles *t = s->handles;
    memmove(t->posted, t->posted + count, (t->posted_count - count) * sizeof *t->posted);
    t->posted_count -= count;
  }
  return outcome;
}
