/* Runs programs. The native %run expands, compiles and runs top-level forms, one after the other. The natives eval,
 * load and require, the libraries and the functions for the host use %run. */
#include "vm/machine/program.h"

#include "vm/front/derived_syntax.h"
#include "vm/front/source.h"
#include "vm/compiler/compile.h"
#include "vm/front/expand.h"
#include "vm/library/library.h"
#include "vm/front/reader.h"
#include "vm/library/string.h"
#include "vm/machine/run.h"
#include "vm/machine/activation.h"
#include "vm/values/heap.h"
#include "vm/values/string_chars.h"

#include <stdio.h>

/* ---- %run: all its state is in its activation, so that a continuation may enter it again ---- */
enum {
  RUN_FORMS,
  RUN_ENV,
  RUN_TELL,
  RUN_X /* RUN_X: index of the expansion, a foreign object */,
  RUN_PHASE,
  RUN_VALUE /* RUN_VALUE: index of the value of the last form that was run */,
  RUN_SERIAL,
  RUN_PLACE,
  RUN_SLOTS = 5
};
enum { NEXT, TRANSFORMING, RUNNING, RUNNING_DEFINITION, RUNNING_OTHER };

static vs_status call_list(vs_scheme *vm, vs_value procedure, vs_value list) {
  vs_call_begin(vm, procedure);
  for (; vs_is_pair(list); list = vs_cdr(list)) if (!vs_call_push(vm, vs_car(list))) return VS_ERROR;
  return VS_CALL;
}

/* Replaces the tree x->root by (let ((value root)) value), so that a call in the tree is no tail call. */
static bool keep_call(vs_expansion *x) {
  vs_value name;
  vs_core_node *let = vs_expand_many(x, VS_AST_LET, 1, x->root->pos);
  if (!let || !vs_intern_c(x->vm, "value", &name) || !(let->as.let.vars[0] = vs_ast_var(&x->ast, name)) ||
      !(let->as.let.body = vs_ast_local(&x->ast, let->as.let.vars[0], x->root->pos))) return false;
  let->as.let.values[0] = x->root;
  x->root = let;
  return true;
}

static vs_status step_forms(vs_scheme *vm, vs_value *a, vs_value *out) {
  if (a[RUN_PHASE] == VS_FALSE) {
    if (!vs_is(a[RUN_ENV], VS_T_ENVIRONMENT)) return vs_fail_type(vm, RUN_ENV, "an environment", a[RUN_ENV]);
    if (!vs_expansion_make(vm, &a[RUN_X])) return VS_ERROR;
    a[RUN_PHASE] = vs_fix(NEXT);
    a[RUN_VALUE] = VS_UNSPECIFIC;
  }
  vs_expansion *x = vs_foreign_get(a[RUN_X], &vs_expansion_type);
  vs_value came = *out;
  bool stepping = false;
  switch (vs_fixnum(a[RUN_PHASE])) {
  case TRANSFORMING:
    if (a[RUN_SERIAL] != vs_fix(x->serial))
      return vs_fail(vm, vm->sym.syntax, "a macro expansion that was finished is entered again");
    stepping = true;
    break;
  case RUNNING:
    a[RUN_VALUE] = came;
    if (a[RUN_TELL] != VS_FALSE && vm->config.value && !vm->config.value(vm, came, vs_pos_of(a[RUN_PLACE])))
      return VS_ERROR;
    break;
  case RUNNING_DEFINITION: a[RUN_VALUE] = VS_UNSPECIFIC; break;
  default: break;
  }
  for (;;) {
    if (!stepping) {
      if (!vs_is_pair(a[RUN_FORMS])) break;
      vs_pos pos = vs_element_pos(a[RUN_FORMS], false, 0);
      a[RUN_PLACE] = vs_fix((int64_t)pos);
      vm->top_place = pos;
      if (!vs_expansion_begin(x, vs_car(a[RUN_FORMS]), a[RUN_ENV], pos)) return VS_ERROR;
      x->later = vs_cdr(a[RUN_FORMS]);
      a[RUN_SERIAL] = vs_fix(x->serial);
    }
    stepping = false;
    vs_enter_phase(vm, VS_VM_EXPAND);
    vs_expand_result result = vs_expansion_step(x, came);
    switch (result) {
    case VS_EXPAND_ERROR: return VS_ERROR;
    case VS_EXPAND_CALL: a[RUN_PHASE] = vs_fix(TRANSFORMING); return call_list(vm, x->procedure, x->args);
    case VS_EXPAND_NODE: {
      VS_ROOTS(vm, r, 1);
      /* The call at top level must not be a tail call, so that errors can report its place. */
      if (a[RUN_TELL] != VS_FALSE && x->root->kind == VS_AST_CALL && !keep_call(x)) return VS_ERROR;
      vs_enter_phase(vm, VS_VM_COMPILE);
      if (!vs_compile(vm, &x->ast, x->root, &r[0])) return VS_ERROR;
      vs_ast_clear(&x->ast);
      a[RUN_FORMS] = vs_cdr(a[RUN_FORMS]);
      a[RUN_PHASE] = vs_fix(x->definition ? RUNNING_DEFINITION : RUNNING);
      /* The last expression of eval is evaluated by a tail call. */
      if (a[RUN_FORMS] == VS_NIL && a[RUN_TELL] == VS_FALSE && !x->definition) return vs_tailcall(vm, r[0], 0, NULL);
      return vs_call(vm, r[0], 0, NULL);
    }
    case VS_EXPAND_FORMS: {                 /* the forms in x->forms replace the first of the remaining forms */
      VS_ROOTS(vm, r, 3);
      r[0] = x->forms; r[1] = VS_NIL;
      for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
        vs_pos pos = vs_pair_pos(r[0]);
        if (!vs_cons_at(vm, vs_car(r[0]), r[1], pos ? pos : vs_pos_of(a[RUN_PLACE]), &r[1])) return VS_ERROR;
      }
      r[2] = vs_cdr(a[RUN_FORMS]);
      while (vs_is_pair(r[1])) {            /* reverses the new pairs in place, since nothing else refers to them */
        vs_value next = vs_cdr(r[1]);
        vs_gc_store(vm, vs_as_pair(r[1]), &vs_as_pair(r[1])->cdr, r[2]);
        r[2] = r[1];
        r[1] = next;
      }
      a[RUN_FORMS] = r[2];
      break;
    }
    case VS_EXPAND_RUN:
      a[RUN_FORMS] = vs_cdr(a[RUN_FORMS]);
      a[RUN_PHASE] = vs_fix(RUNNING_OTHER);
      a[RUN_VALUE] = VS_UNSPECIFIC;
      return call_list(vm, x->procedure, x->args);
    case VS_EXPAND_NOTHING:
      a[RUN_FORMS] = vs_cdr(a[RUN_FORMS]);
      a[RUN_VALUE] = VS_UNSPECIFIC;
      break;
    }
  }
  /* The host has already received the values, as in load; the result is then unspecific. */
  *out = a[RUN_TELL] == VS_UNSPECIFIC ? VS_UNSPECIFIC : a[RUN_VALUE];
  return VS_OK;
}

/* Implements %run: does the next step. Work in the procedures of macros counts as work of the program. */
static vs_status run(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_status status = step_forms(vm, a, out);
  vs_enter_phase(vm, VS_VM_RUN);
  return status;
}

static bool core_value(vs_scheme *vm, const char *name, vs_value *out) {
  vs_value id;
  if (!vs_intern_c(vm, name, &id)) return false;
  *out = vs_environment_value(vm->at.core, id);
  return true;
}

/* ---- eval and environments ---- */
/* Evaluates the forms by a tail call of %run. tell: to whom the values go. #f: only to the caller; #t: to the caller
 * and the host; #unspecific: only to the host. */
static vs_status tail_run(vs_scheme *vm, vs_value forms, vs_value env, vs_value tell) {
  VS_ROOTS(vm, r, 3);
  vs_value procedure;
  r[0] = forms; r[1] = env; r[2] = tell;
  return core_value(vm, "%run", &procedure) ? vs_tailcall(vm, procedure, 3, r) : VS_ERROR;
}

static vs_status eval(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 1);
  vs_value env = n > 1 ? a[1] : vm->at.program;
  if (!vs_is(env, VS_T_ENVIRONMENT)) return vs_fail_type(vm, 1, "an environment", env);
  return vs_cons(vm, a[0], VS_NIL, &r[0]) ? tail_run(vm, r[0], n > 1 ? a[1] : vm->at.program, VS_FALSE) : VS_ERROR;
}

static vs_status interaction(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a; (void)n;
  *out = vm->at.program;
  return VS_OK;
}

/* Returns an environment for (scheme-report-environment 5), with the names of R5RS, or for (null-environment 5), with
 * the syntax of R5RS only. */
static vs_status report(vs_scheme *vm, vs_value *a, int n, bool syntax, vs_value *out) {
  VS_ROOTS(vm, r, 5);
  if (n && a[0] != vs_fix(5))
    return vs_fail_type(
        vm, 0, "5, the one report with such an environment ((environment '(scheme base) ...) is R7RS' way)", a[0]);
  if (!vs_intern_c(vm, "r5rs", &r[0]) || !vs_cons(vm, r[0], VS_NIL, &r[1]) || !vs_intern_c(vm, "scheme", &r[0]) ||
      !vs_cons(vm, r[0], r[1], &r[1]) || !vs_library_find(vm, r[1], &r[2]) || !vs_idtable_new(vm, &r[3]) ||
      !vs_environment_new(vm, VS_FALSE, &r[4]))
    return VS_ERROR;
  vs_value name, binding, clash;
  for (size_t i = 0; vs_idtable_slot(vs_as_environment(r[2])->table, i, &name, &binding); i++)
    if (name != VS_VACANT && (!syntax || vs_is(binding, VS_T_MACRO)) && !vs_idtable_put(vm, &r[3], name, name))
      return VS_ERROR;
  bool own;
  if (!vs_environment_import(vm, r[4], r[2], r[3], &clash, &own)) return VS_ERROR;
  vs_environment_set_intake(r[4], VS_INTAKE_OPEN);
  *out = r[4];
  return VS_OK;
}
static vs_status report_environment(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return report(vm, a, n, false, out);
}
static vs_status null_environment(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return report(vm, a, n, true, out);
}

static vs_status environment(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  if (!vs_environment_new(vm, VS_FALSE, &r[0])) return VS_ERROR;
  for (int i = 0; i < n; i++) {
    if (!vs_library_import_set(vm, a[i], r[0], vs_call_place(vm), &r[1])) return VS_ERROR;
    if (r[1] == VS_ABSENT) continue;
    return vs_cons(vm, r[1], VS_NIL, &r[1]) && vs_fail_with(vm, vm->sym.error, r[1], "there is no library");
  }
  *out = r[0];
  return VS_OK;
}

/* ---- macros whose transformer is a procedure ---- */
/* (er-macro-transformer procedure): returns a macro. The define-syntax that contains it sets the macro's
 * environment. */
static vs_status er_transformer(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_procedure(a[0])) return vs_fail_type(vm, 0, "a procedure of form, rename and compare", a[0]);
  vs_macro *m = (vs_macro *)(void *)vs_gc_alloc(vm, VS_T_MACRO, VS_WORDS(vs_macro));
  if (!m) return VS_ERROR;
  m->kind = vs_fix(VS_MACRO_PROCEDURE); m->transformer = a[0]; m->env = m->data = VS_FALSE;
  *out = vs_from_object(m);
  return VS_OK;
}

/* (%eval-transformer spec env): evaluates spec, the transformer expression of a define-syntax. */
static vs_status eval_transformer(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n; (void)out;
  VS_ROOTS(vm, r, 1);
  return vs_cons(vm, a[0], VS_NIL, &r[0]) ? tail_run(vm, r[0], a[1], VS_FALSE) : VS_ERROR;
}

/* (%rename table env id): returns the alias for the identifier id, always the same one for a table. table is a list
 * whose only element is an association list from identifiers to aliases. */
static vs_status rename_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_identifier(a[2])) return vs_fail_type(vm, 2, "a symbol", a[2]);
  for (vs_value l = vs_car(a[0]); vs_is_pair(l); l = vs_cdr(l))
    if (vs_car(vs_car(l)) == a[2]) {
      *out = vs_cdr(vs_car(l));
      return VS_OK;
    }
  VS_ROOTS(vm, r, 2);
  if (!vs_make_alias(vm, a[2], a[1], &r[0]) || !vs_cons(vm, a[2], r[0], &r[1]) ||
      !vs_cons(vm, r[1], vs_car(a[0]), &r[1]))
    return VS_ERROR;
  vs_gc_store(vm, vs_as_pair(a[0]), &vs_as_pair(a[0])->car, r[1]);
  *out = r[0];
  return VS_OK;
}

static vs_status same_identifier(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm; (void)n;
  *out = vs_bool(vs_is_identifier(a[1]) && vs_is_identifier(a[2]) ? vs_same_meaning(a[0], a[1], a[0], a[2])
                                                                  : a[1] == a[2]);
  return VS_OK;
}

static vs_status is_identifier(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm; (void)n;
  *out = vs_bool(vs_is_identifier(a[0]));
  return VS_OK;
}

static vs_status syntax_to_datum(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_strip(vm, a[0], out);
}

/* ---- loading files ---- */
/* Data about a load of a file whose load is already running. If each file between the two loads contains the next load
 * as a top-level form of its own, loading would never end. */
typedef struct {
  vs_value run;        /* procedure object of the native %run, by which the walk recognizes its activations */
  uint32_t file;
  unsigned calls;      /* number of activations since the last %run: that of load itself, and its callers */
  vs_pos place;        /* place in the source of the outermost of these calls */
  bool plain;          /* whether each file between the two loads contains the next load as a top-level form of its
                        * own */
  bool endless;
  unsigned times, others;
} nesting;
enum { LOADS = 100 };

static bool see_nesting(void *to, vs_value procedure, const vs_value *base, vs_pos place) {
  nesting *n = to;
  if (procedure != n->run) {
    n->calls++;
    if (place) n->place = place;
    return true;
  }
  vs_pos form = vs_is_fixnum(base[RUN_PLACE]) ? vs_pos_of(base[RUN_PLACE]) : 0;
  n->plain = n->plain && n->calls <= 2 && n->place == form;
  n->calls = 0;
  if (vs_pos_file(form) != n->file) return n->others++, true;
  n->times++;
  n->endless = n->plain || n->times >= LOADS;
  return !n->endless;
}

/* Returns false with the error set if the file's load is already running and loading the file again would never end. */
static bool may_load(vs_scheme *vm, const char *path) {
  nesting n = {.plain = true};
  if (!vs_file_number(vm, path, strlen(path), &n.file) || !core_value(vm, "%run", &n.run)) return false;
  vs_see_activations(vm, see_nesting, &n);
  if (!n.endless) return true;
  if (!n.plain) return vs_fail(vm, vm->sym.recursion,
      "%s has loaded itself %d times, one within the other; is there an `if` that stops it?", path, LOADS);
  return vs_fail(vm, vm->sym.recursion, n.others ? "%s loads itself here, by way of others, without end"
      : "%s loads itself here, without end", path);
}

static vs_status load_path(vs_scheme *vm, vs_value name, uint32_t from, vs_value env, vs_value tell) {
  VS_ROOTS(vm, r, 2);
  r[1] = env;
  vs_text path;
  vs_text_open(vm, &path, 0);
  bool ok = vs_source_path(vm, name, from, &path) && vs_text_end(&path) && may_load(vm, path.at) &&
            vs_source_read(vm, path.at, false, &r[0]);
  vs_text_close(&path);
  return ok ? tail_run(vm, r[0], r[1], tell) : VS_ERROR;
}

static vs_status load(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  if (!vs_is_string(a[0])) return vs_fail_type(vm, 0, "the name of a file", a[0]);
  if (n > 1 && !vs_is(a[1], VS_T_ENVIRONMENT)) return vs_fail_type(vm, 1, "an environment", a[1]);
  return load_path(vm, a[0], vs_pos_file(vs_call_place(vm)), n > 1 ? a[1] : vm->at.program, VS_UNSPECIFIC);
}

/* Runs the file that must define the library `name`. Arguments: path name | the file's entry in vm->at.required. */
static vs_status load_library(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 4);
  if (n >= 0) {
    for (vs_value l = vm->at.required; vs_is_pair(l); l = vs_cdr(l))
      if (vs_cdr(vs_car(l)) == VS_FALSE && vs_is_string(vs_car(vs_car(l))) &&
          vs_string_compare(vs_car(vs_car(l)), a[0]) == 0) {
        vm->native = NULL;
        return vs_cons(vm, a[1], VS_NIL, &r[0]) &&
               vs_fail_with(vm, vm->sym.syntax, r[0], "import: libraries import each other in a circle, through");
      }
    vs_text path;
    vs_text_open(vm, &path, 0);
    bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path) && vs_source_read(vm, path.at, false, &r[0]) &&
              vs_program_new(vm, &r[1]);
    vs_text_close(&path);
    if (!ok || !vs_cons(vm, a[0], VS_FALSE, &a[2])) return VS_ERROR;
    if (!vs_is_pair(vm->at.required)) vm->at.required = VS_NIL;
    if (!vs_cons(vm, a[2], vm->at.required, &r[3])) return VS_ERROR;
    vm->at.required = r[3];
    r[2] = VS_FALSE;
    return core_value(vm, "%run", &r[3]) ? vs_call(vm, r[3], 3, r) : VS_ERROR;
  }
  vs_as_pair(a[2])->cdr = VS_TRUE;
  *out = VS_UNSPECIFIC;
  if (!vs_library_find(vm, a[1], &r[0])) return VS_ERROR;
  if (r[0] != VS_FALSE) return VS_OK;
  vs_text path;
  vs_text_open(vm, &path, 0);
  vm->native = NULL;
  bool ok = vs_text_string(&path, a[0]) && vs_text_end(&path) && vs_cons(vm, a[1], VS_NIL, &r[0]) &&
            vs_fail_with(vm, vm->sym.syntax, r[0], "import: %s defines no library", path.at);
  vs_text_close(&path);
  return ok;
}

static vs_status register_library(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n; (void)out;
  return vs_library_register(vm, a[0], a[1]);
}

/* (%require path env): loads the file unless a require has loaded it before. */
static vs_status require(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (a[2] == VS_FALSE) {
    VS_ROOTS(vm, r, 2);
    vs_text t, u;
    vs_text_open(vm, &t, 0);
    vs_text_open(vm, &u, 0);
    bool ok = vs_text_string(&t, a[0]), known = false;
    for (vs_value l = vm->at.required; ok && !known && vs_is_pair(l); l = vs_cdr(l)) {
      u.count = 0;
      ok = vs_text_string(&u, vs_car(vs_car(l)));
      known = ok && u.count == t.count && !memcmp(u.at, t.at, t.count);
    }
    ok = ok && vs_text_end(&t) && (known || vs_source_read(vm, t.at, false, &r[0]));
    vs_text_close(&t);
    vs_text_close(&u);
    if (!ok) return VS_ERROR;
    if (known) return VS_OK;
    if (!vs_cons(vm, a[0], VS_FALSE, &a[2])) return VS_ERROR;
    if (!vs_is_pair(vm->at.required)) vm->at.required = VS_NIL;
    if (!vs_cons(vm, a[2], vm->at.required, &r[1])) return VS_ERROR;
    vm->at.required = r[1];
    VS_ROOTS(vm, p, 3);
    vs_value procedure;
    p[0] = r[0]; p[1] = a[1]; p[2] = VS_FALSE;
    if (!core_value(vm, "%run", &procedure)) return VS_ERROR;
    return vs_call(vm, procedure, 3, p);
  }
  vs_as_pair(a[2])->cdr = VS_TRUE;
  *out = VS_UNSPECIFIC;
  return VS_OK;
}

static vs_status features(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a;
  (void)n;
  return vs_features(vm, out);
}

/* (macroexpand form): expands the macro at the form's head, repeatedly, until the form is core syntax, a call or no
 * pair. */
static vs_status macroexpand(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  vs_expansion *x;
  if (n >= 0) {
    if (!vs_expansion_make(vm, &a[1])) return VS_ERROR;
    x = vs_foreign_get(a[1], &vs_expansion_type);
    if (!vs_expansion_begin(x, a[0], vm->at.program, vs_call_place(vm))) return VS_ERROR;
    x->now = x->tasks[--x->count];
  } else {                                /* continues with the value that the macro's transformer procedure has
                                           * returned */
    a[0] = *out;
    x = vs_foreign_get(a[1], &vs_expansion_type);
    x->now.waiting = false;
  }
  VS_ROOTS(vm, r, 1);
  vs_meaning m;
  vs_pos pos = x->now.pos;
  r[0] = a[0];
  vm->native = NULL;
  bool settled = vs_expand_settle(x, &r[0], &m, &pos);
  if (!settled && x->now.waiting) return call_list(vm, x->procedure, x->args);
  return settled && vs_strip(vm, r[0], out);
}

static vs_status assertion_failed(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 1);
  vm->native = NULL;
  r[0] = VS_NIL;
  for (int i = n; i-- > 0;)
    if (!vs_cons(vm, a[i], r[0], &r[0])) return VS_ERROR;
  return vs_fail_with(vm, vm->sym.error, r[0], "assertion failed:");
}

static const vs_native_def defs[] = {
  { "%run", "forms env tell", run, RUN_SLOTS, NULL },
  { "eval", "expression [environment]", eval, 0, "the value of an expression" },
  { "interaction-environment", "", interaction, 0, "the environment of the program" },
  { "scheme-report-environment", "[version]", report_environment, 0, "a fresh environment with the names of R5RS" },
  { "null-environment", "[version]", null_environment, 0, "a fresh environment with the syntax of R5RS" },
  { "environment", ". imports", environment, 0, "a fresh environment with these imports" },
  { "er-macro-transformer", "procedure", er_transformer, 0,
    "a macro by explicit renaming: (procedure form rename compare)" },
  { "%eval-transformer", "spec env", eval_transformer, 0, NULL },
  { "%rename", "table env id", rename_, 0, NULL },
  { "%same-identifier?", "env a b", same_identifier, 0, NULL },
  { "identifier?", "v", is_identifier, 0, "a symbol, or one that a macro renamed" },
  { "macroexpand", "form", macroexpand, 1, "form with the macros at its head used, without renamings" },
  { "syntax->datum", "form", syntax_to_datum, 0, "a form without renamings" },
  { "load", "file [environment]", load, 0, "run a file" },
  { "%load-library", "path name", load_library, 1, NULL },
  { "%register-library", "name env", register_library, 0, NULL },
  { "%require", "path env", require, 1, NULL },
  { "%assertion-failed", "form . details", assertion_failed, 0, NULL },
  { "features", "", features, 0, "what cond-expand knows" },
  { 0 }
};
const vs_native_table vs_unit_natives = {"unit", defs};

/* ---- the library, and functions for the host ---- */
static bool define_constant(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure) {
  (void)context;
  VS_ROOTS(vm, r, 1);
  if (!vs_make_cell(vm, symbol, procedure, &r[0])) return false;
  vs_object_of(r[0])->flags |= VS_F_CONSTANT;
  return vs_environment_bind(vm, vm->at.core, symbol, r[0]);
}

#define VS_NATIVES(name) extern const vs_native_table vs_##name##_natives;
#include "vm/machine/natives.def"
#undef VS_NATIVES

bool vs_front_open(vs_scheme *vm) {
  static const vs_native_table *const tables[] = {
#define VS_NATIVES(name) &vs_##name##_natives,
#include "vm/machine/natives.def"
#undef VS_NATIVES
  };
  static const struct { const char *name; int form; } forms[] = {
#define VS_FORM(id, name, kind, shape) {name, VS_FORM_##id},
#include "vm/front/forms.def"
#undef VS_FORM
  };
  if (vs_is(vm->at.core, VS_T_ENVIRONMENT)) return true;       /* a heap image already contains the library */
  VS_ROOTS(vm, r, 2);
  if (!vs_intern_c(vm, "visualscheme", &r[0]) || !vs_environment_new(vm, r[0], &vm->at.core)) return false;
  vm->at.libraries = vm->at.required = VS_NIL;
  for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
    if (!vs_native_define(vm, tables[i], define_constant, NULL)) return false;
  for (size_t i = 0; vm->config.tables && vm->config.tables[i]; i++)
    if (!vs_native_define(vm, vm->config.tables[i], define_constant, NULL)) return false;
  for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
    vs_macro *m = (vs_macro *)(void *)vs_gc_alloc(vm, VS_T_MACRO, VS_WORDS(vs_macro));
    if (!m) return false;
    m->kind = vs_fix(forms[i].form); m->transformer = m->env = m->data = VS_FALSE;
    r[1] = vs_from_object(m);
    if (!vs_intern_c(vm, forms[i].name, &r[0]) || !vs_environment_bind(vm, vm->at.core, r[0], r[1])) return false;
  }
  return vs_program_new(vm, &vm->at.program);
}

bool vs_program_new(vs_scheme *vm, vs_value *env) {
  VS_ROOTS(vm, r, 1);
  vs_value clash;
  bool own;
  if (!vs_environment_new(vm, VS_FALSE, &r[0])) return false;
  vs_environment_set_intake(r[0], VS_INTAKE_FRESH);
  if (!vs_environment_import(vm, r[0], vm->at.core, VS_TRUE, &clash, &own)) return false;
  *env = r[0];
  return true;
}

static bool run_forms(vs_scheme *vm, vs_value forms, vs_value env, bool tell, vs_value *last) {
  VS_ROOTS(vm, r, 4);
  vs_value procedure;
  r[0] = forms; r[1] = env; r[2] = vs_bool(tell);
  vm->top_place = 0;
  if (!core_value(vm, "%run", &procedure)) return false;
  if (vs_run(vm, procedure, 3, r, last ? last : &r[3])) return true;
  vs_value c = vm->condition;           /* after tail calls the error object may have no place, and gets that of the
                                         * top-level form */
  if (vs_is(c, VS_T_CONDITION) && c != vm->at.no_memory && !vs_as_condition(c)->place)
    vs_as_condition(c)->place = vm->top_place;
  return false;
}

bool vs_library_load(vs_scheme *vm, const char *name, const char *text, size_t size) {
  VS_ROOTS(vm, r, 1);
  return vs_source_text(vm, name, &(vs_passage){ text, size, 1 }, false, &r[0]) &&
         run_forms(vm, r[0], vm->at.core, false, NULL);
}

void vs_library_done(vs_scheme *vm) {
  vs_environment_seal(vm->at.core);
  vm->at.nearby = VS_FALSE; /* deletes the similar names that were recorded while the library was compiled */
}

/* Deletes the entries of files that a failed run has loaded only in part, so that they can be required again. */
static bool forget_unfinished(vs_scheme *vm) {
  VS_ROOTS(vm, r, 2);
  r[0] = vm->at.required; r[1] = VS_NIL;
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0]))
    if (vs_cdr(vs_car(r[0])) == VS_TRUE && !vs_cons(vm, vs_car(r[0]), r[1], &r[1])) return false;
  vm->at.required = r[1];
  return true;
}

/* Sets the file that the host runs. load and import search for files in its folder. */
static bool begin_program(vs_scheme *vm, const char *name) {
  return vs_file_number(vm, name, strlen(name), &vm->program_file) && forget_unfinished(vm);
}

/* Sets the imports of a program. A script (JavaScript) sees only its own library. Scheme text after a script, at the
 * prompt or by -e, also sees the names of the complete library; the script's names have precedence. */
static bool beside_script(vs_scheme *vm, const char *name) {
  vs_value clash;
  bool own;
  bool script = vs_source_language(name) != NULL;
  vs_intake intake = vs_environment_intake(vm->at.program);
  if (intake == VS_INTAKE_FRESH) vm->scripted = script;
  if (script || !vm->scripted) return true;
  vs_environment_set_intake(vm->at.program, VS_INTAKE_OPEN); /* a setting other than OPEN would let imports replace the
                                                              * script's variables */
  bool ok = vs_environment_import(vm, vm->at.program, vm->at.core, VS_TRUE, &clash, &own);
  vs_environment_set_intake(vm->at.program, intake);
  return ok;
}

bool vs_program_text(vs_scheme *vm, const char *name, const vs_passage *text, bool prompt, vs_value *last) {
  VS_ROOTS(vm, r, 1);
  if (prompt) vs_environment_set_intake(vm->at.program, VS_INTAKE_PROMPT);
  return begin_program(vm, name) && beside_script(vm, name) &&
         vs_source_text(vm, name, text, false, &r[0]) && run_forms(vm, r[0], vm->at.program, true, last);
}

/* Returns true for a form that binds names at top level, or is valid only there. */
static bool is_top_form(vs_value form) {
  static const char *const words[] = {"import", "require", "provide", "begin", "load", "include"};
  if (!vs_is_pair(form) || !vs_is_symbol(vs_car(form))) return false;
  const char *head = vs_as_symbol(vs_car(form))->name;
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) if (!strcmp(head, words[i])) return true;
  return !strncmp(head, "define", 6);
}

/* Replaces the form by ((lambda (name ...) form) (quote value) ...). bindings: list of the pairs (name . value). lambda
 * and quote are those of the library. */
static bool bind_around(vs_scheme *vm, vs_value *form, vs_pos pos, vs_value bindings) {
  VS_ROOTS(vm, r, 6);                     /* roots of the garbage collector: bindings, names, values, quote, lambda,
                                           * temporary value */
  r[0] = bindings; r[1] = r[2] = VS_NIL;
  if (!vs_intern_c(vm, "lambda", &r[5]) || !vs_make_alias(vm, r[5], vm->at.core, &r[4]) ||
      !vs_make_alias(vm, vm->sym.quote, vm->at.core, &r[3])) return false;
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0]))
    if (!vs_cons(vm, vs_car(vs_car(r[0])), r[1], &r[1]) || !vs_cons(vm, vs_cdr(vs_car(r[0])), VS_NIL, &r[5]) ||
        !vs_cons(vm, r[3], r[5], &r[5]) || !vs_cons(vm, r[5], r[2], &r[2])) return false;
  return vs_cons_at(vm, *form, VS_NIL, pos, &r[5]) && vs_cons(vm, r[1], r[5], &r[5]) && vs_cons(vm, r[4], r[5],
      &r[5]) &&
         vs_cons_at(vm, r[5], r[2], pos, form);
}

bool vs_program_within(vs_scheme *vm, const char *name, const vs_passage *text, vs_value bindings, vs_value *last) {
  VS_ROOTS(vm, r, 4);                     /* roots of the garbage collector: forms, bindings, rewritten forms, the
                                           * current form */
  r[1] = bindings;
  vs_environment_set_intake(vm->at.program, VS_INTAKE_PROMPT);
  if (!vs_source_text(vm, name, text, false, &r[0])) return false;
  for (r[2] = r[0]; vs_is_pair(r[2]) && vs_is_pair(r[1]); r[2] = vs_cdr(r[2])) {
    r[3] = vs_car(r[2]);
    if (is_top_form(r[3])) continue;
    if (!bind_around(vm, &r[3], vs_element_pos(r[2], false, 0), r[1])) return false;
    vs_gc_store(vm, vs_as_pair(r[2]), &vs_as_pair(r[2])->car, r[3]);
  }
  return run_forms(vm, r[0], vm->at.program, true, last);
}

