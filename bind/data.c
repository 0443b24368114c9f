/* Reads data files for programs: texts, the names in a folder, JSON. bind/data.scm reads CSV.
 *
 * A relative name begins at the folder of the program's file, as in load-mesh. The host's functions (vs_io) read the
 * files, so that its restrictions apply. The library jansson, which parses JSON, is loaded when it is first used. */

#include "bind/data.h"

#include <jansson.h>

#include "bind/origins.h"
#include "geometry/dynamic.h"
#include "vm/library/port.h"
#include "vm/front/source.h"
#include "vm/machine/activation.h"
#include "vm/machine/fail.h"
#include "vm/machine/run.h"
#include "vm/numbers/number.h"
#include "vm/numbers/integer.h"
#include "vm/values/heap.h"

/* Returns the number of the source file that contains the innermost call outside of the language's own libraries, or
 * 0. */
static uint32_t calling_file(vs_scheme *vm) {
  enum { FAR = 64 };
  vs_pos place[FAR];
  size_t n = vs_call_places(vm, place, FAR);
  for (size_t i = 0; i < n; i++)
    if (!vs_bind_is_library(vm->host, vs_pos_file(place[i]))) return vs_pos_file(place[i]);
  return 0;
}

/* Sets *path to the path of the file with the name a[0], ending in a NUL. Returns false if a[0] is no string or memory
 * is out. */
static bool path_of(vs_scheme *vm, vs_value *a, vs_text *path) {
  return vs_arg_type(vm, a, 0, VS_T_STRING) && vs_source_path(vm, a[0], calling_file(vm), path) && vs_text_end(path);
}

/* (%data-path name): returns the path of the file with this name, as the program would read it. */
static vs_status data_path(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text path;
  vs_text_open(vm, &path, 0);
  bool ok = path_of(vm, a, &path) && vs_text_to_string(&path, out);
  vs_text_close(&path);
  return ok;
}

/* (%file->string path) and similar procedures: return the text of a file, without a byte order mark. */
static vs_status data_text(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text path, text;
  vs_text_open(vm, &path, 0);
  vs_text_open(vm, &text, 0);
  VS_ROOTS(vm, r, 1);
  bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path) && vs_io_read_file(vm, path.at, &r[0]);
  if (ok) {
    const char *at = (const char *)vs_as_bytes(r[0])->at;
    size_t count = (size_t)vs_as_bytes(r[0])->length, mark = count >= 3 && !memcmp(at, "\xEF\xBB\xBF", 3) ? 3 : 0;
    ok = vs_text_put(&text, at + mark, count - mark) && vs_text_to_string(&text, out);
  }
  vs_text_close(&text);
  vs_text_close(&path);
  return ok;
}

/* ---- names in folders ---- */
typedef struct { vs_scheme *vm; vs_value *list; } names;

static bool take_name(void *context, const char *name, size_t length) {
  names *l = context;
  VS_ROOTS(l->vm, r, 1);
  return vs_string_from_utf8(l->vm, name, length, &r[0]) && vs_cons(l->vm, r[0], *l->list, l->list);
}

/* (%directory-files path): returns the names in a folder, in no particular order. */
static vs_status directory_files(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  names l = { vm, &r[0] };
  const char *why = NULL;
  const vs_io *io = vm->config.io;
  vs_text path;
  vs_text_open(vm, &path, 0);
  bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path);
  bool listed = ok && io && io->list && io->list(vm->config.user, path.at, take_name, &l, &why);
  vs_text_close(&path);
  if (ok && !listed) {
    if (!why && io && io->list) return VS_ERROR; /* why is NULL: listing the folder has not failed, but memory is out,
                                                  * and the error is set */
    return vs_cons(vm, a[0], VS_NIL, &r[0]) &&
           vs_fail_with(vm, vm->sym.file, r[0], "cannot read the folder (%s)", why ? why : "not available here");
  }
  *out = r[0];
  return ok;
}

/* ---- reading JSON ---- */
#define JANSSON_FUNCTIONS(F)                                                           \
  F(load, json_loadb, json_t *, (const char *, size_t, size_t, json_error_t *))       \
  F(discard, json_delete, void, (json_t *))                                           \
  F(first, json_object_iter, void *, (json_t *))                                      \
  F(next, json_object_iter_next, void *, (json_t *, void *))                          \
  F(key, json_object_iter_key, const char *, (void *))                                \
  F(member, json_object_iter_value, json_t *, (void *))                               \
  F(size, json_array_size, size_t, (const json_t *))                                  \
  F(element, json_array_get, json_t *, (const json_t *, size_t))                      \
  F(string, json_string_value, const char *, (const json_t *))                        \
  F(length, json_string_length, size_t, (const json_t *))                             \
  F(integer, json_integer_value, json_int_t, (const json_t *))                        \
  F(real, json_real_value, double, (const json_t *))

VS_DYNAMIC_FUNCTIONS(JANSSON_FUNCTIONS);

/* An array or object of JSON that is being converted. index: number of the array's next element; iterator: the object's
 * next member. The Scheme value is an element of the list `containers` of take_json, at the same depth. For an array,
 * it is a vector. For an object, it is the part of the association list whose members have no value yet. */
typedef struct { json_t *node; void *iterator; size_t index; } level;

/* Converts one node of JSON without its contents. An array becomes a vector of the same length, whose elements are set
 * later. An object becomes an association list of its keys, whose values are set later. */
static bool shallow(vs_scheme *vm, const dynamic_functions *j, json_t *node, vs_value *out) {
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: the list, its last pair, the new value */
  switch (json_typeof(node)) {
    case JSON_OBJECT:
      r[0] = r[1] = VS_NIL;
      for (void *i = j->first(node); i; i = j->next(node, i)) {
        const char *key = j->key(i);
        vs_value name;
        if (!vs_poll(vm, 16) || !vs_intern(vm, key, strlen(key), &name) || !vs_cons(vm, name, VS_FALSE, &r[2]) ||
            !vs_cons(vm, r[2], VS_NIL, &r[2]))
          return false;
        if (r[0] == VS_NIL) r[0] = r[2];
        else vs_gc_store(vm, vs_as_pair(r[1]), &vs_as_pair(r[1])->cdr, r[2]);
        r[1] = r[2];
      }
      *out = r[0];
      return true;
    case JSON_ARRAY: return vs_make_vector(vm, j->size(node), VS_FALSE, out);
    case JSON_STRING: return vs_string_from_utf8(vm, j->string(node), j->length(node), out);
    case JSON_INTEGER: return vs_int_from_int64(vm, j->integer(node), out);
    case JSON_REAL: *out = vs_flonum(j->real(node)); return true;
    case JSON_TRUE: *out = VS_TRUE; return true;
    case JSON_FALSE: *out = VS_FALSE; return true;
    case JSON_NULL: return vs_intern(vm, "null", 4, out);
  }
  return false;
}

/* Converts jansson's tree to Scheme data, with an explicit stack instead of recursion. */
static bool take_json(vs_scheme *vm, const dynamic_functions *j, json_t *root, vs_value *out) {
  VS_ROOTS(vm, r, 3); /* roots of the garbage collector: the result, the containers (innermost first), a value */
  level *levels = NULL;
  size_t depth = 0, room = 0;
  bool ok = shallow(vm, j, root, &r[0]);
  r[1] = VS_NIL, r[2] = r[0];
  for (json_t *fresh = root; ok;) {
    if (fresh && (json_is_object(fresh) || json_is_array(fresh))) {
      if (depth == room) {
        size_t more = room ? 2 * room : 16;
        level *grown = vs_mem(vm, levels, room * sizeof *grown, more * sizeof *grown);
        if (!(ok = grown != NULL)) break;
        levels = grown, room = more;
      }
      levels[depth++] = (level){ fresh, json_is_object(fresh) ? j->first(fresh) : NULL, 0 };
      if (!(ok = vs_cons(vm, r[2], r[1], &r[1]))) break;
    }
    fresh = NULL;
    if (!depth) break;
    level *l = &levels[depth - 1];
    bool array = json_is_array(l->node);
    if (array ? l->index == j->size(l->node) : !l->iterator) {
      depth--;
      r[1] = vs_cdr(r[1]);
      continue;
    }
    fresh = array ? j->element(l->node, l->index) : j->member(l->iterator);
    if (!(ok = vs_poll(vm, 16) && shallow(vm, j, fresh, &r[2]))) break;
    vs_value into = vs_car(r[1]);
    if (array) {
      vs_gc_store(vm, vs_as_vector(into), &vs_as_vector(into)->at[l->index++], r[2]);
    } else {
      vs_value member = vs_car(into);
      vs_gc_store(vm, vs_as_pair(member), &vs_as_pair(member)->cdr, r[2]);
      vs_gc_store(vm, vs_as_pair(r[1]), &vs_as_pair(r[1])->car, vs_cdr(into));
      l->iterator = j->next(l->node, l->iterator);
    }
  }
  if (levels) vs_mem(vm, levels, room * sizeof *levels, 0);
  if (ok) *out = r[0];
  return ok;
}

/* Parses JSON text. `name` is the name of the source in messages. */
static vs_status json_parse(vs_scheme *vm, const char *text, size_t length, const char *name, vs_value *out) {
  dynamic_functions j;
  vs_error e = { 0 };
  if (!vs_dynamic_load(VS_LIBRARY_JANSSON, "JSON", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names, &j,
                       &e)) {
    vs_fail(vm, vm->sym.file, "%s", e.message);
    return VS_ERROR;
  }
  json_error_t wrong;
  json_t *root = j.load(text, length, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, &wrong);
  if (!root)
    return vs_fail(vm, vm->sym.error, "%s:%d:%d: %s", name, wrong.line > 0 ? wrong.line : 1,
                   wrong.column > 0 ? wrong.column : 1, wrong.text);
  bool ok = take_json(vm, &j, root, out);
  /* does the work of json_decref, an inline function of jansson: calling it would require jansson when the program is
   * linked */
  if (root->refcount != (size_t)-1 && --root->refcount == 0) j.discard(root);
  return ok;
}

static vs_status load_json(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text path, text;
  vs_text_open(vm, &path, 0);
  vs_text_open(vm, &text, 0);
  VS_ROOTS(vm, r, 1);
  bool ok = path_of(vm, a, &path) && vs_io_read_file(vm, path.at, &r[0]);
  if (ok) { /* parses a copy of the file's text, since the garbage collector may move its bytes */
    const char *at = (const char *)vs_as_bytes(r[0])->at;
    size_t count = (size_t)vs_as_bytes(r[0])->length, mark = count >= 3 && !memcmp(at, "\xEF\xBB\xBF", 3) ? 3 : 0;
    ok = vs_text_put(&text, at + mark, count - mark) && vs_text_end(&text);
    r[0] = VS_FALSE;
  }
  ok = ok && json_parse(vm, text.at, text.count, path.at, out);
  vs_text_close(&text);
  vs_text_close(&path);
  return ok;
}

static vs_status string_to_json(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING)) return VS_ERROR;
  vs_text text;
  vs_text_open(vm, &text, 0);
  bool ok = vs_text_string(&text, a[0]) && vs_text_end(&text) && json_parse(vm, text.at, text.count, "text", out);
  vs_text_close(&text);
  return ok;
}

static const vs_native_def defs[] = {
  { "%data-path", "file", data_path, 0, NULL },
  /* one native for several procedures; errors show the procedure's own name */
  { "%file->string %file->lines %load-csv %load-mtl", "file", data_text, 0, NULL },
  { "%directory-files", "folder", directory_files, 0, NULL },
  { "load-json", "file", load_json, 0, "the data of a JSON file: objects are association lists, arrays vectors" },
  { "string->json", "text", string_to_json, 0, "the data of a JSON text" },
  { 0 },
};
const vs_native_table vs_bind_data_table = { "data", defs };
