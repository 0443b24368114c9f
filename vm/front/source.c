/* Finds source files, determines their language, and reads their forms. */
#include "vm/front/source.h"

#include <string.h>

#include "vm/autolisp/autolisp_reader.h"
#include "vm/front/reader.h"
#include "vm/gml/gml_reader.h"
#include "vm/javascript/read_script.h"
#include "vm/library/port.h"
#include "vm/openscad/openscad_reader.h"
#include "vm/values/string_chars.h"

/* ---- paths of files ---- */
static size_t folder_length(const char *name) {
  const char *slash = strrchr(name, '/');
  return slash ? (size_t)(slash - name) + 1 : 0;
}

static const char SHIPPED[] = "library:";

bool vs_source_is_shipped(const char *path) { return !strncmp(path, SHIPPED, sizeof SHIPPED - 1); }

const vs_shipped *vs_source_shipped(const vs_scheme *vm, const char *name) {
  for (const vs_shipped *s = vm->config.shipped; s && s->name; s++) if (!strcmp(s->name, name)) return s;
  return NULL;
}

static bool exists(vs_scheme *vm, vs_text *path) {
  if (!vs_text_end(path)) return false;
  if (vs_source_is_shipped(path->at)) return vs_source_shipped(vm, path->at + sizeof SHIPPED - 1) != NULL;
  return vm->config.io && vm->config.io->exists && vm->config.io->exists(vm->config.user, path->at);
}

/* Replaces a/./b and a/c/../b by a/b, so that each file has one name. */
static void normalise(vs_text *path) {
  char *s = path->at;
  size_t n = path->count, out = 0, i = 0;
  while (i < n) {
    size_t end = i;
    while (end < n && s[end] != '/') end++;
    size_t length = end - i;
    bool dot = length == 1 && s[i] == '.', up = length == 2 && s[i] == '.' && s[i + 1] == '.';
    size_t last = out > 1 ? out - 1 : 0;                   /* start of the last folder in the path so far, which ..
                                                            * removes */
    while (last > 0 && s[last - 1] != '/') last--;
    bool can = up && out > 1 && !(out - last == 3 && s[last] == '.' && s[last + 1] == '.');
    if (can) out = last;
    else if (!dot && (length || out == 0)) {
      memmove(s + out, s + i, length);
      out += length;
      if (end < n) s[out++] = '/';
    }
    i = end + 1;
  }
  path->count = out;
}

bool vs_source_name(vs_scheme *vm, uint32_t file, vs_text *t) {
  t->count = 0;
  if (!file || !vs_is_vector(vm->at.files) || file >= vs_as_vector(vm->at.files)->length ||
      !vs_is_string(vs_as_vector(vm->at.files)->at[file]))
    return vs_text_end(t);
  return vs_text_string(t, vs_as_vector(vm->at.files)->at[file]) && vs_text_end(t);
}

/* Sets *path to `folder` followed by `name` if that file exists, or if *path is still empty. */
static bool try_place(vs_scheme *vm, const char *folder, size_t length, const vs_text *name, vs_text *path,
                      bool *found) {
  if (*found) return true;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_put(&t, folder, length) && (!length || folder[length - 1] == '/' || vs_text_put(&t, "/", 1)) &&
            vs_text_put(&t, name->at, name->count);
  if (ok && ((*found = exists(vm, &t)) || !path->count)) {
    path->count = 0;
    ok = vs_text_put(path, t.at, t.count);
  }
  vs_text_close(&t);
  return ok;
}

bool vs_source_find(vs_scheme *vm, vs_value name, uint32_t from, size_t up, vs_text *path, bool *found) {
  vs_text plain, base;
  vs_text_open(vm, &plain, 0);
  vs_text_open(vm, &base, 0);
  *found = false;
  path->count = 0;
  bool ok = vs_text_string(&plain, name) && vs_text_end(&plain);
  if (ok && plain.at[0] == '/') {
    ok = try_place(vm, "", 0, &plain, path, found);
  } else if (ok) {
    ok = vs_source_name(vm, from, &base);
    if (ok) base.count = folder_length(base.at);
    ok = ok && try_place(vm, base.at, base.count, &plain, path, found);
    for (size_t i = 0; ok && i < up; i++) ok = vs_text_puts(&base, "../");
    ok = ok && (!up || try_place(vm, base.at, base.count, &plain, path, found));
    ok = ok && vs_source_name(vm, vm->program_file, &base) &&
         try_place(vm, base.at, folder_length(base.at), &plain, path, found);
    for (const char *p = vm->config.library_path; ok && p && *p;) {
      size_t n = strcspn(p, ":");
      ok = try_place(vm, p, n, &plain, path, found);
      p += n + (p[n] == ':');
    }
    if (ok && !*found && vs_source_shipped(vm, plain.at)) {
      *found = true;
      path->count = 0;
      ok = vs_text_puts(path, SHIPPED) && vs_text_put(path, plain.at, plain.count);
    }
  }
  vs_text_close(&plain);
  vs_text_close(&base);
  if (ok && !vs_source_is_shipped(path->count ? path->at : "")) normalise(path);
  return ok;       /* if no folder has the file, *path names it in the first searched folder; reading it then reports
                    * that it is missing */
}

bool vs_source_path(vs_scheme *vm, vs_value name, uint32_t from, vs_text *path) {
  bool found;
  return vs_source_find(vm, name, from, 0, path, &found);
}

/* ---- front ends: languages other than Scheme ---- */
typedef bool read_fn(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);
typedef struct { const char *ending, *language; read_fn *read; } front_end;

/* Returns the front end for the language of a file of this name, or NULL if the file is in Scheme. */
static const front_end *front_end_of(const char *name) {
  static const front_end all[] = {
#define VS_FRONT_END(ending, language, read) { ending, language, read },
#include "vm/front/front_ends.def"
#undef VS_FRONT_END
  };
  size_t n = strlen(name);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    size_t length = strlen(all[i].ending);
    if (n > length && !strcmp(name + n - length, all[i].ending)) return &all[i];
  }
  return NULL;
}

const char *vs_source_language(const char *name) {
  const front_end *other = front_end_of(name);
  return other ? other->language : NULL;
}

const char *vs_source_said(vs_scheme *vm, const char *name, vs_pos place) {
  vs_text file;
  if (*name != ':' || !name[1]) return name;
  vs_text_open(vm, &file, 0);
  bool other = vs_source_name(vm, vs_pos_file(place), &file) && vs_source_language(file.at);
  vs_text_close(&file);
  return other ? name + 1 : name;
}

const char *vs_source_word(vs_scheme *vm, const char *name) {
  return vs_source_said(vm, name, vs_pos_make(vm->program_file, 1, 1));
}

/* ---- files that include each other ---- */
/* Returns the pair (file . includer) for file number `file` in the list vm->at.included, or #f. */
static vs_value including(const vs_scheme *vm, uint32_t file) {
  for (vs_value l = vm->at.included; vs_is_pair(l); l = vs_cdr(l))
    if (vs_car(vs_car(l)) == vs_fix(file)) return vs_car(l);
  return VS_FALSE;
}

/* Records that file number `from` (0: none) includes file number `file`. */
static bool note_included(vs_scheme *vm, uint32_t file, uint32_t from) {
  VS_ROOTS(vm, r, 2);
  vs_value pair = including(vm, file);
  if (vs_is_pair(pair)) {
    vs_as_pair(pair)->cdr = vs_fix(from); /* a fixnum needs no write barrier */
    return true;
  }
  if (!from) return true;
  r[1] = vs_is_pair(vm->at.included) ? vm->at.included : VS_NIL;
  if (!vs_cons(vm, vs_fix(file), vs_fix(from), &r[0]) || !vs_cons(vm, r[0], r[1], &r[1])) return false;
  vm->at.included = r[1];
  return true;
}

static bool in_circle(const vs_scheme *vm, uint32_t file, uint32_t from) {
  while (from && from != file) {
    vs_value pair = including(vm, from);
    from = vs_is_pair(pair) ? (uint32_t)vs_fixnum(vs_cdr(pair)) : 0;
  }
  return from != 0;
}

/* ---- reading files ---- */
bool vs_source_text(vs_scheme *vm, const char *name, const vs_passage *text, bool fold, vs_value *forms) {
  uint32_t file;
  vs_vm_phase was = vs_enter_phase(vm, VS_VM_READ);
  const front_end *other = front_end_of(name);
  bool ok = vs_file_number(vm, name, strlen(name), &file) && note_included(vm, file, 0) &&
            (other ? other->read(vm, text->at, text->size, file, text->line, forms)
                   : vs_read_all(vm, text, file, fold, forms));
  vs_enter_phase(vm, was);
  return ok;
}

bool vs_source_include(vs_scheme *vm, vs_value name, uint32_t from, bool fold, vs_value *forms, bool *circle) {
  vs_text path;
  uint32_t file;
  vs_text_open(vm, &path, 0);
  bool ok = vs_source_path(vm, name, from, &path) && vs_text_end(&path) &&
            vs_file_number(vm, path.at, path.count, &file);
  *circle = ok && in_circle(vm, file, from);
  ok = ok && !*circle && vs_source_read(vm, path.at, fold, forms) && note_included(vm, file, from);
  vs_text_close(&path);
  return ok;
}

bool vs_source_read(vs_scheme *vm, const char *path, bool fold, vs_value *forms) {
  VS_ROOTS(vm, r, 1);
  const vs_shipped *shipped = vs_source_is_shipped(path) ? vs_source_shipped(vm, path + sizeof SHIPPED - 1) : NULL;
  if (shipped) {
    const vs_passage whole = {shipped->text, (size_t)(shipped->end - shipped->text), 1};
    return vs_source_text(vm, path, &whole, fold, forms);
  }
  if (!vs_io_read_file(vm, path, &r[0])) return false;
  size_t size = (size_t)vs_as_bytes(r[0])->length;
  char *text = vs_mem(vm, NULL, 0, size + 1);        /* copies the text, since an allocation of the reader may move the
                                                      * string's bytes */
  if (!text) return false;
  memcpy(text, vs_as_bytes(r[0])->at, size);
  bool ok = vs_source_text(vm, path, &(vs_passage){text, size, 1}, fold, forms);
  vs_mem(vm, text, size + 1, 0);
  return ok;
}
