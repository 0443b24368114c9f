/* Owns what Scheme sees of the model: objects (references to nodes), paints (materials), where they came from, and
 * warnings about them. */
#include "bind/objects.h"

#include "bind/call/refuse.h"
#include "bind/print.h"
#include "bind/state.h"
#include "vm/front/source.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "vm/values/text.h"

/* ---- objects ---- */

static void shape_release(void *object) { vs_node_release(object); }
static bool shape_equal(const void *a, const void *b) { return vs_node_equal(a, b, NULL); }
static uint64_t shape_hash(const void *a) { return ((const vs_node *)a)->hash; }
static bool shape_print(vs_scheme *vm, const void *a, bool (*put)(void *to, const char *s, size_t n), void *to) {
  (void)vm;
  return vs_bind_print_node(a, put, to);
}
const vs_foreign_type vs_shape_type = { "an object", shape_release, shape_equal, shape_hash, shape_print, NULL, false };

static vs_status wrap(vs_bind *b, vs_ref ref, size_t bytes, vs_value *out) {
  if (!vs_make_foreign(b->vm, &vs_shape_type, ref.node, bytes, out)) return VS_ERROR;
  vs_as_foreign(*out)->with = ref.origin;
  return VS_OK;
}

vs_status vs_bind_wrap(vs_bind *b, vs_node *node, vs_value *out) {
  if (!node) return vs_fail_memory(b->vm);
  return wrap(b, (vs_ref){ node, vs_bind_origin(b) }, node->refs == 1 ? vs_node_bytes(node) : 0, out);
}

vs_status vs_bind_wrap_ref(vs_bind *b, vs_ref ref, vs_value *out) {
  return wrap(b, (vs_ref){ vs_node_retain(ref.node), ref.origin ? ref.origin : vs_bind_origin(b) }, 0, out);
}

/* ---- paints: interned materials, which live as long as the store ---- */

static void paint_release(void *object) { (void)object; }
static bool paint_print(vs_scheme *vm, const void *object, bool (*put)(void *to, const char *s, size_t n), void *to) {
  (void)vm;
  const vs_material *m = object;
  const vs_material_pattern *p = &m->pattern;
  char text[1024], c[3][32], v[4][32], q[5][32];
  vs_bind_number_text(c[0], m->red), vs_bind_number_text(c[1], m->green), vs_bind_number_text(c[2], m->blue);
  vs_bind_number_text(v[0], m->roughness), vs_bind_number_text(v[1], m->metallic),
      vs_bind_number_text(v[2], m->transparency), vs_bind_number_text(v[3], m->ior);
  vs_bind_number_text(q[0], p->red), vs_bind_number_text(q[1], p->green), vs_bind_number_text(q[2], p->blue);
  vs_bind_number_text(q[3], vs_pattern_size(p)), vs_bind_number_text(q[4], p->angle);
  int n = snprintf(text, sizeof text,
                   "(make-material #:name \"%.100s\" #:color (list %s %s %s) #:roughness %s #:metallic %s "
                   "#:transparency %s #:ior %s",
                   m->name, c[0], c[1], c[2], v[0], v[1], v[2], v[3]);
  if (n > 0 && (size_t)n < sizeof text && p->picture)
    n += snprintf(text + n, sizeof text - (size_t)n, " #:image \"%.500s\" #:pattern-size %s #:pattern-angle %s",
                  p->picture->path, q[3], q[4]);
  else if (n > 0 && (size_t)n < sizeof text && p->kind != VS_PATTERN_NONE)
    n += snprintf(text + n, sizeof text - (size_t)n,
                  " #:pattern '%s #:pattern-color (list %s %s %s) #:pattern-size %s #:pattern-angle %s",
                  vs_pattern_name(p->kind), q[0], q[1], q[2], q[3], q[4]);
  return n > 0 && put(to, text, (size_t)n < sizeof text ? (size_t)n : sizeof text - 1) && put(to, ")", 1);
}
const vs_foreign_type vs_paint_type = { "a material", paint_release, NULL, NULL, paint_print, NULL, false };

/* ---- origins ----
 * The chain of calls that led here, outermost last, cut to CHAIN callers: enough to find the call in the user's own
 * text, and a bound on the work per object. The same chain is looked up by its key before it is interned call by
 * call. */

enum { CHAIN = 8 };

uint32_t vs_bind_file_count(vs_scheme *vm) {
  vs_value files = vm->at.files;
  uint32_t n = vs_is_vector(files) ? (uint32_t)vs_as_vector(files)->length : 0;
  while (n > 1 && !vs_is_string(vs_as_vector(files)->at[n - 1])) n--; /* the vector has room to grow */
  return n;
}

bool vs_bind_is_library(vs_bind *b, uint32_t number) {
  if (number < b->library_files) return true;
  vs_text name;
  vs_text_open(b->vm, &name, 0);
  bool shipped = vs_source_name(b->vm, number, &name) && vs_source_is_shipped(name.at);
  vs_text_close(&name);
  return shipped;
}

const char *vs_bind_file_name(vs_bind *b, vs_pos place) {
  vs_value files = b->vm->at.files;
  uint32_t number = vs_pos_file(place);
  if (number == 0 || vs_bind_is_library(b, number) || !vs_is_vector(files) || number >= vs_as_vector(files)->length)
    return NULL;
  vs_value name = vs_as_vector(files)->at[number];
  char *text;
  size_t bytes;
  if (!vs_is_string(name) || !vs_bind_text(b->vm, name, &text, &bytes)) return NULL;
  const char *kept = vs_store_text(b->store, text, bytes - 1);
  vs_mem(b->vm, text, bytes, 0);
  return kept;
}

static const vs_origin *intern_chain(vs_bind *b, const vs_pos *place, size_t n) {
  const vs_origin *o = NULL;
  for (size_t i = n; i-- > 0;) {
    const char *file = vs_bind_file_name(b, place[i]);
    const vs_origin *next =
        file ? vs_store_origin(b->store, file, vs_pos_line(place[i]), vs_pos_col(place[i]), o) : NULL;
    if (next) o = next;
  }
  return o;
}

const vs_origin *vs_bind_origin(vs_bind *b) {
  uint64_t key = vs_call_key(b->vm, CHAIN);
  size_t slot = key % (sizeof b->recent / sizeof *b->recent);
  if (b->recent_collection != b->vm->collections) { /* code may have gone, and other code be where it was */
    memset(b->recent, 0, sizeof b->recent);
    b->recent_collection = b->vm->collections;
  }
  if (b->recent[slot].key != key || !b->recent[slot].origin) {
    vs_pos place[CHAIN];
    size_t n = vs_call_places(b->vm, place, CHAIN);
    b->recent[slot].origin = intern_chain(b, place, n);
    b->recent[slot].key = key;
  }
  return b->recent[slot].origin;
}

/* ---- warnings ---- */

/* true when this place has been told so already; false also when it cannot be remembered */
static bool told(vs_bind *b, uint64_t key) {
  if (!key) key = 1;
  if (2 * b->told_count >= b->told_room) {
    size_t room = b->told_room ? b->told_room * 2 : 64;
    uint64_t *t = vs_store_realloc(b->store, NULL, 0, room * sizeof *t);
    if (!t) return false;
    memset(t, 0, room * sizeof *t);
    for (size_t i = 0; i < b->told_room; i++)
      if (b->told[i]) {
        size_t k = b->told[i] & (room - 1);
        while (t[k]) k = (k + 1) & (room - 1);
        t[k] = b->told[i];
      }
    vs_store_realloc(b->store, b->told, b->told_room * sizeof *t, 0);
    b->told = t, b->told_room = room;
  }
  size_t k = key & (b->told_room - 1);
  while (b->told[k] && b->told[k] != key) k = (k + 1) & (b->told_room - 1);
  if (b->told[k] == key) return true;
  b->told[k] = key, b->told_count++;
  return false;
}

bool vs_bind_warned(vs_bind *b, const vs_origin *o, const char *kind) {
  /* the place, whoever called it */
  uint64_t key = o ? ((uint64_t)o->line << 20 | o->column) ^ (uint64_t)(uintptr_t)o->file : 0;
  for (const char *c = kind; *c; c++) key = (key ^ (unsigned char)*c) * UINT64_C(0x100000001B3);
  key ^= key >> 31;
  return told(b, key);
}

void vs_bind_clear(vs_bind *b, const char *kind) {
  if (b->warn) vs_bind_warned(b, vs_bind_origin(b), kind);
}

void vs_bind_warn(vs_bind *b, const char *kind, const char *format, ...) {
  const vs_origin *o = vs_bind_origin(b);
  if (!b->warn || vs_bind_warned(b, o, kind)) return;
  char text[512];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  b->warn(b->warn_context, o, text);
}

/* ---- text ---- */

bool vs_bind_text(vs_scheme *vm, vs_value v, char **out, size_t *bytes) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok =
      (vs_is_symbol(v) ? vs_text_put(&t, vs_as_symbol(v)->name, vs_as_symbol(v)->length) : vs_text_string(&t, v)) &&
      vs_text_end(&t);
  *bytes = t.count + 1;
  if (ok && !(*out = vs_mem(vm, NULL, 0, *bytes))) ok = vs_fail_memory(vm);
  if (ok) memcpy(*out, t.at, *bytes);
  vs_text_close(&t);
  return ok;
}

/* ---- (current-segments), (current-tolerance): parameter objects of geometry.scm ---- */

enum { CURRENT_SEGMENTS, CURRENT_TOLERANCE };

static double current(vs_bind *b, size_t which) {
  vs_value all = b->vm->at.host, v;
  double d;
  if (!vs_is_vector(all) || which >= vs_as_vector(all)->length) return 0;
  vs_value parameter = vs_as_vector(all)->at[which];
  if (!vs_is(parameter, VS_T_PARAMETER)) return 0;
  v = vs_as_parameter(parameter)->value;
  for (vs_value l = b->vm->parameters; vs_is_pair(l); l = vs_cdr(l)) /* parameterize: innermost first */
    if (vs_car(vs_car(l)) == parameter) { v = vs_cdr(vs_car(l)); break; }
  return vs_bind_number(b->vm, v, &d) ? d : 0;
}
int32_t vs_bind_segments(vs_bind *b) { return (int32_t)current(b, CURRENT_SEGMENTS); }
double vs_bind_tolerance(vs_bind *b) { return current(b, CURRENT_TOLERANCE); }

/* ---- warnings of the library in Scheme ---- */

vs_status vs_p_warn(vs_args *f, vs_value *out) {
  (void)out;
  vs_bind_warn(f->bind, f->arg[0].text.at, "%s", f->arg[0].text.at);
  return VS_OK;
}
