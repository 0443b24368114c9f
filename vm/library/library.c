/* Implements libraries of the language: define-library runs its body in a separate environment, import makes names of a
 * library visible, require runs a file. */
#include "vm/library/library.h"
#include "vm/front/derived_syntax.h"
#include "vm/library/standard.h"
#include "vm/machine/fail.h"
#include "vm/values/equal.h"
#include "vm/library/port.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"
#include "vm/front/source.h"
#include "vm/front/environment.h"

#include <stdio.h>

static bool is_word(vs_value v, const char *word) {
  return vs_is_identifier(v) && !strcmp(vs_as_symbol(vs_identifier_symbol(v))->name, word);
}

static bool library_path(vs_scheme *vm, vs_value name, uint32_t from, vs_value env, vs_text *path, bool *found);

bool vs_library_find(vs_scheme *vm, vs_value name, vs_value *env) {
  for (vs_value l = vm->at.libraries; vs_is_pair(l); l = vs_cdr(l)) {
    bool same;
    if (!vs_equal(vm, vs_car(vs_car(l)), name, &same)) return false;
    if (same) { *env = vs_cdr(vs_car(l)); return true; }
  }
  return vs_library_built_in(vm, name, env);
}

bool vs_library_known(vs_scheme *vm, vs_value name, uint32_t from, vs_value env) {
  VS_ROOTS(vm, r, 3);
  r[2] = env;
  if (!vs_strip(vm, name, &r[0]) || !vs_library_own_name(vm, r[0], &r[0]) || !vs_library_find(vm, r[0], &r[1]))
    return false;
  if (r[1] != VS_FALSE) return true;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool found, ok = library_path(vm, r[0], from, r[2], &t, &found);
  vs_text_close(&t);
  return ok && found;
}

bool vs_library_register(vs_scheme *vm, vs_value name, vs_value env) {
  VS_ROOTS(vm, r, 2);
  r[0] = env;
  if (!vs_is_pair(vm->at.libraries)) vm->at.libraries = VS_NIL;
  vs_environment_seal(env);
  if (!vs_cons(vm, name, r[0], &r[1]) || !vs_cons(vm, r[1], vm->at.libraries, &r[1])) return false;
  vm->at.libraries = r[1];
  return true;
}

/* ---- import sets ---- */
static bool not_exported(vs_scheme *vm, vs_pos pos, vs_value symbol) {
  return vs_fail_at(vm, vm->sym.syntax, pos, VS_NIL, "import: this library has no %s",
                    vs_is_symbol(symbol) ? vs_as_symbol(symbol)->name : "such name");
}

/* Imports the environment `from` into env, and reports a name that cannot be imported. mapping: #t, or a table from
 * local names to names in `from`. name: the library's name, for errors. */
static bool take(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, vs_value name, vs_pos pos) {
  VS_ROOTS(vm, r, 1);
  r[0] = name;
  vs_value clash;
  bool own;
  if (!vs_environment_import(vm, env, from, mapping, &clash, &own))
    return false;
  if (clash == VS_VACANT) return true;
  vs_text t;
  vs_text_open(vm, &t, 300);
  const char *text = vs_as_symbol(clash)->name,
             *why = own ? "is defined here already" : "was imported already, with another meaning";
  bool ok = vs_print(vm, r[0], VS_PRINT_WRITE, &t) && vs_text_end(&t) &&
            vs_fail_at(vm, vm->sym.syntax, pos, VS_NIL,
                       "import: %s %s; (except %s %s) omits the name, rename or prefix keep both names", text, why,
                       t.at, text);
  vs_text_close(&t);
  return ok;
}

bool vs_library_import_set(vs_scheme *vm, vs_value set, vs_value env, vs_pos pos, vs_value *missing) {
  VS_ROOTS(vm, r, 8);      /* roots of the garbage collector: the import set, env, stack of modifiers, library, two
                            * tables, name, temporary */
  r[0] = set; r[1] = env; r[2] = VS_NIL;
  *missing = VS_ABSENT;
  if (!vs_strip(vm, r[0], &r[0])) return false;
  while (vs_is_pair(r[0]) && vs_is_pair(vs_cdr(r[0])) && vs_is_pair(vs_car(vs_cdr(r[0]))) &&
         (is_word(vs_car(r[0]), "only") || is_word(vs_car(r[0]), "except") || is_word(vs_car(r[0]), "prefix") ||
          is_word(vs_car(r[0]), "rename"))) {
    if (!vs_cons(vm, r[0], r[2], &r[2])) return false;
    r[0] = vs_car(vs_cdr(r[0]));
  }
  if (!vs_library_own_name(vm, r[0], &r[0])) return false;
  r[7] = r[0];
  if (!vs_library_find(vm, r[0], &r[3])) return false;
  if (r[3] == VS_FALSE) { *missing = r[0]; return true; }
  if (r[2] == VS_NIL) return take(vm, r[1], r[3], VS_TRUE, r[7], pos);
  /* Creates a table that maps local names to names of the library. */
  if (!vs_idtable_new(vm, &r[4])) return false;
  for (size_t i = 0;; i++) {
    const vs_environment *e = vs_as_environment(r[3]);
    vs_value k, v;
    if (!vs_idtable_slot(e->exports == VS_TRUE ? e->table : e->exports, i, &k, &v)) break;
    if (k == VS_VACANT || !vs_is_symbol(k) || vs_as_symbol(k)->name[0] == '%') continue;
    if (!vs_idtable_put(vm, &r[4], k, k)) return false;
  }
  for (; vs_is_pair(r[2]); r[2] = vs_cdr(r[2])) {
    vs_value head = vs_car(vs_car(r[2]));
    bool only = is_word(head, "only"), except = is_word(head, "except"), prefix = is_word(head, "prefix");
    r[6] = vs_cdr(vs_cdr(vs_car(r[2])));
    if (!vs_idtable_new(vm, &r[5])) return false;
    if (only) {
      for (; vs_is_pair(r[6]); r[6] = vs_cdr(r[6])) {
        vs_value id = vs_car(r[6]), there = vs_is_symbol(id) ? vs_idtable_get(r[4], id) : VS_VACANT;
        if (there == VS_VACANT) return not_exported(vm, pos, id);
        if (!vs_idtable_put(vm, &r[5], id, there)) return false;
      }
      r[4] = r[5];
      continue;
    }
    if (!prefix)
      for (vs_value l = r[6]; vs_is_pair(l); l = vs_cdr(l)) {
        vs_value id = except ? vs_car(l) : vs_list_length(vs_car(l)) == 2 ? vs_car(vs_car(l)) : VS_FALSE;
        if (!vs_is_symbol(id) || (!except && !vs_is_symbol(vs_car(vs_cdr(vs_car(l))))))
          return vs_fail_at(vm, vm->sym.syntax, pos, VS_NIL, "import: it is written %s",
                            except ? "(except (library name) name ...)"
                                   : "(rename (library name) (name new-name) ...)");
        if (vs_idtable_get(r[4], id) == VS_VACANT) return not_exported(vm, pos, id);
      }
    for (size_t i = 0;; i++) {
      vs_value k, v, local;
      if (!vs_idtable_slot(r[4], i, &k, &v)) break;
      if (k == VS_VACANT) continue;
      local = k;
      bool drop = false;
      if (prefix) {
        char name[512];
        vs_value p = vs_is_pair(r[6]) ? vs_car(r[6]) : VS_FALSE;
        if (!vs_is_symbol(p))
          return vs_fail_at(vm, vm->sym.syntax, pos, VS_NIL, "import: it is written (prefix (library name) prefix)");
        int n = snprintf(name, sizeof name, "%s%s", vs_as_symbol(p)->name, vs_as_symbol(k)->name);
        if (n < 0 || (size_t)n >= sizeof name || !vs_intern(vm, name, (size_t)n, &local)) return vs_fail_memory(vm);
        if (!vs_idtable_slot(r[4], i, &k, &v)) break;
      } else for (vs_value l = r[6]; vs_is_pair(l); l = vs_cdr(l)) {
        if (except) drop = drop || vs_car(l) == k;
        else if (vs_car(vs_car(l)) == k) local = vs_car(vs_cdr(vs_car(l)));
      }
      if (!drop && vs_idtable_get(r[5], local) != VS_VACANT)
        return vs_fail_at(vm, vm->sym.syntax, pos, VS_NIL, "import: two names would become %s",
                          vs_as_symbol(local)->name);
      if (!drop && !vs_idtable_put(vm, &r[5], local, v)) return false;
    }
    r[4] = r[5];
  }
  return take(vm, r[1], r[3], r[4], r[7], pos);
}

/* Writes the file name of the library to t: a/b/1.sld for (a b 1). */
static bool library_file(vs_scheme *vm, vs_value name, vs_text *t) {
  bool ok = true;
  for (bool first = true; ok && vs_is_pair(name); name = vs_cdr(name), first = false) {
    ok = (first || vs_text_put(t, "/", 1)) && vs_print(vm, vs_car(name), VS_PRINT_DISPLAY, t);
  }
  return ok && vs_text_puts(t, ".sld");
}

/* Sets *depth to the number of folders between the file `from` and the folder to which library names are relative. A
 * library (towers spiral) in towers/spiral.sld has depth 1. Sets *depth to 0 if env is no library, or if its file has
 * another name. */
static bool library_depth(vs_scheme *vm, vs_value env, uint32_t from, size_t *depth) {
  vs_value name = vs_as_environment(env)->name;
  int64_t parts = vs_list_length(name);
  *depth = 0;
  if (parts < 2) return true;
  VS_ROOTS(vm, r, 1);
  r[0] = name;
  vs_text own, file;
  vs_text_open(vm, &own, 0);
  vs_text_open(vm, &file, 0);
  bool ok = library_file(vm, r[0], &own) && vs_source_name(vm, from, &file);
  if (ok && file.count >= own.count && !memcmp(file.at + file.count - own.count, own.at, own.count))
    *depth = (size_t)parts - 1;
  vs_text_close(&own);
  vs_text_close(&file);
  return ok;
}

/* Finds the file that may define the library `name`, for an import in file number `from` and the environment env. Sets
 * *path and *found as vs_source_find does. */
static bool library_path(vs_scheme *vm, vs_value name, uint32_t from, vs_value env, vs_text *path, bool *found) {
  VS_ROOTS(vm, r, 2);
  vs_text t;
  size_t up;
  *found = false;
  if (!vs_is_pair(name)) return true;
  r[1] = name;
  vs_text_open(vm, &t, 0);
  bool ok = library_depth(vm, env, from, &up) && library_file(vm, r[1], &t) && vs_text_to_string(&t, &r[0]) &&
            vs_source_find(vm, r[0], from, up, path, found) && vs_text_end(path);
  vs_text_close(&t);
  return ok;
}

static bool core_value(vs_scheme *vm, const char *name, vs_value *out) {
  vs_value id;
  if (!vs_intern_c(vm, name, &id)) return false;
  *out = vs_environment_value(vm->at.core, id);
  return true;
}

/* Returns the name of a library that replaces `name`, a library of other Schemes that VisualScheme lacks. Returns NULL
 * for other names. */
static const char *instead_of(vs_value name) {
  static const struct { int number; const char *instead; } absent[] = {
#define VS_ABSENT_LIBRARY(number, instead) {number, instead},
#include "vm/library/absent_libraries.def"
#undef VS_ABSENT_LIBRARY
  };
  int number = 0;
  if (vs_is_symbol(name)) {
    if (sscanf(vs_as_symbol(name)->name, "srfi/%d", &number) != 1) return NULL;
  } else {
    if (!vs_is_pair(name) || !vs_is_pair(vs_cdr(name)) || !vs_is_symbol(vs_car(name)) ||
        strcmp(vs_as_symbol(vs_car(name))->name, "srfi") != 0)
      return NULL;
    vs_value second = vs_car(vs_cdr(name));
    if (vs_is_fixnum(second)) number = vs_fixnum(second) < 1000 ? (int)vs_fixnum(second) : 0;
    else if (!vs_is_symbol(second) || sscanf(vs_as_symbol(second)->name, ":%d", &number) != 1) return NULL;
  }
  for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
    if (absent[i].number == number) return absent[i].instead;
  return NULL;
}

/* Reports that there is no library of this name. */
static bool no_library(vs_expansion *x, vs_pos pos, vs_value name) {
  const char *instead = instead_of(name);
  vs_text t;
  vs_text_open(x->vm, &t, 0);
  bool ok = vs_text_puts(&t, instead ? "import: " : "import: there is no library ") &&
            vs_print(x->vm, name, VS_PRINT_WRITE, &t) &&
            vs_text_puts(&t, instead ? " is not part of VisualScheme: "
                                     : "; sqrt, sin, pi, xyz and the rest need no import") &&
            vs_text_puts(&t, instead ? instead : "") && vs_text_end(&t);
  if (ok) vs_expand_fail(x, pos, VS_ABSENT, "%s", t.at);
  vs_text_close(&t);
  return false;
}

/* ---- the form import ---- */
bool vs_library_import(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 5);
  if (vs_list_length(x->now.form) < 1) return vs_expand_shape(x, VS_FORM_import);
  /* The program begins with an import, so only imported names are visible in it. */
  if (vs_environment_intake(x->now.env) == VS_INTAKE_FRESH) {
    vs_environment_forget_imports(x->now.env);
    vs_environment_set_intake(x->now.env, VS_INTAKE_STRICT);
  }
  r[0] = vs_cdr(x->now.form);
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    vs_pos pos = vs_element_pos(r[0], false, x->now.pos);
    if (!vs_library_import_set(vm, vs_car(r[0]), x->now.env, pos, &r[1])) return false;
    if (r[1] == VS_ABSENT) continue;
    /* The library is not loaded yet. Its file may define it: loads the file, then tries the import again. */
    vs_text t;
    vs_text_open(vm, &t, 0);
    bool found, ok = library_path(vm, r[1], vs_pos_file(x->now.pos), x->now.env, &t, &found);
    if (ok && found) ok = vs_text_to_string(&t, &r[2]);
    vs_text_close(&t);
    if (!ok) return false;
    if (!found || x->now.n) return no_library(x, pos, r[1]);
    VS_ROOTS(vm, quoted, 2);      /* roots of the garbage collector, for the call (%load-library path 'name) */
    if (!vs_core_name(vm, "quote", &quoted[0]) || !vs_cons(vm, r[1], VS_NIL, &quoted[1]) ||
        !vs_cons(vm, quoted[0], quoted[1], &quoted[0]) || !vs_cons(vm, quoted[0], VS_NIL, &r[4]) ||
        !vs_cons(vm, r[2], r[4], &r[4]) || !core_value(vm, "%load-library", &r[3]) ||
        !vs_cons_at(vm, r[3], r[4], pos, &r[4]))
      return false;
    if (!vs_core_name(vm, "import", &r[2]) || !vs_cons_at(vm, r[2], vs_cdr(x->now.form), x->now.pos, &r[2]))
      return false;
    if (!vs_cons(vm, r[2], VS_NIL, &r[2]) || !vs_cons(vm, r[4], r[2], &x->forms)) return false;
    x->result = VS_EXPAND_FORMS;
    return true;
  }
  x->result = VS_EXPAND_NOTHING;
  return true;
}

/* ---- the form define-library ---- */
typedef struct { vs_expansion *x; vs_value *r; } library;
enum {
  L_NAME,
  L_ENV,
  L_EXPORTS,
  L_FORMS /* index of the list of the library's forms, newest first */,
  L_LATER /* index of the list of declarations that are not yet processed */,
  L_A,
  L_B,
  L_C,
  L_COUNT
};

static bool export_name(library *l, vs_value spec, vs_pos pos) {
  vs_scheme *vm = l->x->vm;
  vs_value inside = spec, outside = spec;
  if (vs_list_length(spec) == 3 && is_word(vs_car(spec), "rename")) {
    inside = vs_car(vs_cdr(spec));
    outside = vs_car(vs_cdr(vs_cdr(spec)));
  }
  if (!vs_is_identifier(inside) || !vs_is_identifier(outside))
    return vs_expand_fail(l->x, pos, spec, "export: a name or (rename inside outside), not");
  return vs_idtable_put(vm, &l->r[L_EXPORTS], vs_identifier_symbol(outside), vs_identifier_symbol(inside));
}

bool vs_library_define(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, L_COUNT);
  library lib = {x, r};
  if (vs_list_length(x->now.form) < 2 || !vs_is_pair(vs_car(vs_cdr(x->now.form))))
    return vs_expand_shape(x, VS_FORM_define_library);
  r[L_FORMS] = VS_NIL;
  r[L_LATER] = vs_cdr(vs_cdr(x->now.form));
  if (!vs_strip(vm, vs_car(vs_cdr(x->now.form)), &r[L_NAME]) || !vs_environment_new(vm, r[L_NAME], &r[L_ENV]) ||
      !vs_idtable_new(vm, &r[L_EXPORTS]))
    return false;
  while (vs_is_pair(r[L_LATER])) {
    vs_value d = vs_car(r[L_LATER]);
    vs_pos pos = vs_element_pos(r[L_LATER], false, x->now.pos);
    r[L_LATER] = vs_cdr(r[L_LATER]);
    if (vs_list_length(d) < 1 || !vs_is_identifier(vs_car(d)))
      return vs_expand_fail(x, pos, d, "define-library: not a declaration:");
    vs_value head = vs_car(d);
    if (is_word(head, "export")) {
      for (r[L_A] = vs_cdr(d); vs_is_pair(r[L_A]); r[L_A] = vs_cdr(r[L_A]))
        if (!export_name(&lib, vs_car(r[L_A]), pos)) return false;
    } else if (is_word(head, "begin")) {
      for (r[L_A] = vs_cdr(d); vs_is_pair(r[L_A]); r[L_A] = vs_cdr(r[L_A]))
        if (!vs_cons(vm, vs_car(r[L_A]), r[L_FORMS], &r[L_FORMS])) return false;
    } else if (is_word(head, "import") || is_word(head, "include") || is_word(head, "include-ci")) {
      r[L_A] = d;      /* the word is compared by its name in the core environment, since the library's environment is
                        * still empty */
      if (!vs_core_name(vm,
                        is_word(head, "import")    ? "import"
                        : is_word(head, "include") ? "include"
                                                   : "include-ci",
                        &r[L_B]) ||
          !vs_cons_at(vm, r[L_B], vs_cdr(r[L_A]), pos, &r[L_B]) || !vs_cons(vm, r[L_B], r[L_FORMS], &r[L_FORMS]))
        return false;
    } else if (is_word(head, "cond-expand")) {
      r[L_B] = x->now.env;      /* a requirement (library ...) tests whether the library can be imported into this
                                 * environment */
      x->now.env = r[L_ENV];
      bool ok = vs_cond_expand(x, d, &r[L_A]);
      x->now.env = r[L_B];
      if (!ok) return false;
      r[L_B] = VS_NIL;
      for (; vs_is_pair(r[L_A]); r[L_A] = vs_cdr(r[L_A]))
        if (!vs_cons(vm, vs_car(r[L_A]), r[L_B], &r[L_B])) return false;
      for (; vs_is_pair(r[L_B]); r[L_B] = vs_cdr(r[L_B]))
        if (!vs_cons(vm, vs_car(r[L_B]), r[L_LATER], &r[L_LATER])) return false;
    } else if (is_word(head, "include-library-declarations")) {
      for (r[L_A] = vs_cdr(d); vs_is_pair(r[L_A]); r[L_A] = vs_cdr(r[L_A])) {
        bool circle;
        if (!vs_is_string(vs_car(r[L_A])))
          return vs_expand_fail(x, pos, vs_car(r[L_A]), "a file name is a string, not");
        if (!vs_source_include(vm, vs_car(r[L_A]), vs_pos_file(pos), false, &r[L_B], &circle))
          return circle && vs_expand_fail(x, pos, vs_car(r[L_A]), "this file includes itself, without end, through");
        r[L_C] = VS_NIL;
        for (; vs_is_pair(r[L_B]); r[L_B] = vs_cdr(r[L_B]))
          if (!vs_cons(vm, vs_car(r[L_B]), r[L_C], &r[L_C])) return false;
        for (; vs_is_pair(r[L_C]); r[L_C] = vs_cdr(r[L_C]))
          if (!vs_cons(vm, vs_car(r[L_C]), r[L_LATER], &r[L_LATER])) return false;
      }
    } else return vs_expand_fail(x, pos, d, "define-library: not a declaration:");
  }
  vs_environment *e = vs_as_environment(r[L_ENV]);
  vs_gc_store(vm, e, &e->exports, r[L_EXPORTS]);
  /* Imports are processed first, even if the library contains other forms before them. The last form registers the
   * library. */
  VS_ROOTS(vm, q, 3);
  if (!vs_core_name(vm, "quote", &q[0]) || !vs_cons(vm, r[L_NAME], VS_NIL, &q[1]) || !vs_cons(vm, q[0], q[1], &q[0]) ||
      !vs_cons(vm, r[L_ENV], VS_NIL, &q[1]) || !vs_cons(vm, q[0], q[1], &q[1]) ||
      !core_value(vm, "%register-library", &q[0]) || !vs_cons(vm, q[0], q[1], &q[1]) ||
      !vs_cons(vm, q[1], VS_NIL, &q[2]))
    return false;
  for (int imports = 0; imports < 2; imports++)
    for (r[L_A] = r[L_FORMS]; vs_is_pair(r[L_A]); r[L_A] = vs_cdr(r[L_A])) {
      vs_value f = vs_car(r[L_A]);
      bool import = vs_is_pair(f) && vs_is_form(vm->at.core, vs_car(f), VS_FORM_import) && vs_is(vs_car(f), VS_T_ALIAS);
      if (import == (imports == 1) && !vs_cons(vm, f, q[2], &q[2])) return false;
    }
  q[0] = q[2]; q[1] = r[L_ENV]; q[2] = VS_FALSE;
  if (!vs_make_form_list(vm, &x->args, 3, q) || !core_value(vm, "%run", &x->procedure)) return false;
  x->result = VS_EXPAND_RUN;
  return true;
}

/* ---- the form require ---- */
bool vs_library_require(vs_expansion *x) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 4);
  int64_t n = vs_list_length(x->now.form);
  if (n < 2) return vs_expand_shape(x, VS_FORM_require);
  if (n > 2) {                                     /* (require a b ...) loads several files in order */
    r[1] = VS_NIL;
    for (r[0] = vs_cdr(x->now.form); vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
      vs_pos pos = vs_element_pos(r[0], false, x->now.pos);
      if (!vs_cons(vm, vs_car(r[0]), VS_NIL, &r[2]) || !vs_cons_at(vm, vs_car(x->now.form), r[2], pos, &r[2]) ||
          !vs_cons(vm, r[2], r[1], &r[1]))
        return false;
    }
    x->forms = VS_NIL;
    for (; vs_is_pair(r[1]); r[1] = vs_cdr(r[1])) if (!vs_cons(vm, vs_car(r[1]), x->forms, &x->forms)) return false;
    x->result = VS_EXPAND_FORMS;
    return true;
  }
  vs_value spec = vs_car(vs_cdr(x->now.form));
  vs_pos pos = vs_element_pos(vs_cdr(x->now.form), false, x->now.pos);
  if (!vs_is_string(spec)) {
    /* Handles (lib "..."), (only-in ...) and (prefix-in ...) of PLT Scheme around a built-in library. */
    for (int i = 0; i < 8 && vs_is_pair(spec) && vs_list_length(spec) > 1 && !vs_library_is_built_in(spec); i++) {
      if (is_word(vs_car(spec), "lib") || is_word(vs_car(spec), "planet")) { spec = VS_FALSE; break; }
      spec = is_word(vs_car(spec), "prefix-in") && vs_list_length(spec) > 2 ? vs_car(vs_cdr(vs_cdr(spec)))
                                                                            : vs_car(vs_cdr(spec));
    }
    if (spec == VS_FALSE || !vs_library_is_built_in(spec))
      return vs_expand_fail(x, pos, vs_car(vs_cdr(x->now.form)),
                            "require: this is not built in, and a file is named by a string:");
    x->result = VS_EXPAND_NOTHING;
    /* The names of (srfi 26) are not visible in a program without an import, so require becomes an import. */
    return vs_library_import_set(vm, spec, x->now.env, pos, &r[1]);
  }
  vs_text path;
  vs_text_open(vm, &path, 0);
  r[0] = spec;
  bool ok = vs_source_path(vm, r[0], vs_pos_file(pos), &path) && vs_text_to_string(&path, &r[1]);
  vs_text_close(&path);
  if (!ok) return false;
  r[2] = x->now.env;
  if (!vs_make_form_list(vm, &x->args, 2, &r[1]) || !core_value(vm, "%require", &x->procedure)) return false;
  x->result = VS_EXPAND_RUN;
  return true;
}
