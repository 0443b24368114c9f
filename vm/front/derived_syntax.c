/* Expands syntax by rewriting it to other syntax: define-record-type, include, cond-expand. */
#include "vm/front/derived_syntax.h"

#include "vm/front/expand.h"
#include "vm/library/library.h"
#include "vm/front/source.h"
#include "vm/library/standard.h"
#include "vm/machine/fail.h"
#include "vm/values/heap.h"

#include <stdio.h>

bool vs_core_name(vs_scheme *vm, const char *name, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  return vs_intern_c(vm, name, &r[0]) && vs_make_alias(vm, r[0], vm->at.core, out);
}

bool vs_make_form_list(vs_scheme *vm, vs_value *out, size_t n, const vs_value *items) {
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  while (n-- > 0) if (!vs_cons(vm, items[n], r[0], &r[0])) return false;
  *out = r[0];
  return true;
}

/* Sets *out to the form (head a b ...), where head is a name of the library. `items` (a, b, ...) are roots of the
 * garbage collector. */
static bool make(vs_scheme *vm, const char *head, size_t n, const vs_value *items, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  return vs_make_form_list(vm, &r[0], n, items) && vs_core_name(vm, head, &r[1]) && vs_cons(vm, r[1], r[0], out);
}

/* Adds (define name value) to the list of definitions, which is newest first. */
static bool define(vs_scheme *vm, vs_value name, vs_value value, vs_pos pos, vs_value *list) {
  VS_ROOTS(vm, r, 3);
  r[0] = name; r[1] = value;
  return make(vm, "define", 2, r, &r[2]) && vs_cons_at(vm, vs_car(r[2]), vs_cdr(r[2]), pos, &r[2]) &&
         vs_cons(vm, r[2], *list, list);
}

static bool quoted(vs_scheme *vm, vs_value v, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  return make(vm, "quote", 1, r, out);
}

static int64_t field_index(vs_value fields, vs_value id) {
  for (int64_t i = 0; vs_is_pair(fields); fields = vs_cdr(fields), i++) {
    vs_value f = vs_is_pair(vs_car(fields)) ? vs_car(vs_car(fields)) : vs_car(fields);
    if (f == id) return i;
  }
  return -1;
}

/* Rewrites define-record-type to (define type (%make-record-type 'name '(field ...))), (define constructor (lambda
 * (field ...) (%record type field ...))) and so on. */
bool vs_form_define_record_type(vs_expansion *x, vs_value *form) {
  vs_scheme *vm = x->vm;
  enum { NAME, MAKER, PRED, FIELDS, OUT, A, B, C, D, E, COUNT };
  VS_ROOTS(vm, r, COUNT);
  vs_pos pos = x->now.pos;
  if (vs_list_length(*form) < 4)
    return vs_expand_fail(x, pos, *form, "define-record-type is written %s, not",
                          vs_form_shape(VS_FORM_define_record_type));
  vs_value l = vs_cdr(*form);
  r[NAME] = vs_is_pair(vs_car(l)) ? vs_car(vs_car(l)) : vs_car(l);
  r[MAKER] = vs_car(vs_cdr(l));
  r[PRED] = vs_car(vs_cdr(vs_cdr(l)));
  r[FIELDS] = vs_cdr(vs_cdr(vs_cdr(l)));
  r[OUT] = VS_NIL;
  vs_value maker = vs_is_pair(r[MAKER]) ? vs_car(r[MAKER]) : r[MAKER];
  if (!vs_is_identifier(r[NAME]) || (!vs_is_identifier(maker) && maker != VS_FALSE && maker != VS_TRUE) ||
      (!vs_is_identifier(r[PRED]) && r[PRED] != VS_FALSE))
    return vs_expand_fail(x, pos, *form, "define-record-type is written %s, not",
                          vs_form_shape(VS_FORM_define_record_type));
  for (l = r[FIELDS]; vs_is_pair(l); l = vs_cdr(l)) {
    vs_value f = vs_car(l);
    int64_t n = vs_is_identifier(f) ? 1 : vs_list_length(f);
    bool ok = n >= 1 && n <= 3;
    for (vs_value k = vs_is_pair(f) ? f : VS_NIL; ok && vs_is_pair(k); k = vs_cdr(k)) ok = vs_is_identifier(vs_car(k));
    if (!ok)
      return vs_expand_fail(x, vs_element_pos(l, false, pos), f,
                            "a field is (name accessor) or (name accessor modifier), not");
  }
  /* Adds the definition of the record type. */
  r[A] = VS_NIL;
  for (l = r[FIELDS]; vs_is_pair(l); l = vs_cdr(l)) {          /* collects the fields' names, newest first; they are
                                                                * reversed below */
    r[B] = l;
    if (!vs_cons(vm, vs_is_pair(vs_car(l)) ? vs_car(vs_car(l)) : vs_car(l), r[A], &r[A])) return false;
    l = r[B];
  }
  r[B] = VS_NIL;
  for (; vs_is_pair(r[A]); r[A] = vs_cdr(r[A])) if (!vs_cons(vm, vs_car(r[A]), r[B], &r[B])) return false;
  if (!quoted(vm, r[NAME], &r[C]) || !quoted(vm, r[B], &r[D])) return false;
  VS_ROOTS(vm, p, 5);
  p[0] = r[C]; p[1] = r[D];
  if (!make(vm, "%make-record-type", 2, p, &r[C]) || !define(vm, r[NAME], r[C], pos, &r[OUT])) return false;
  /* Adds the definition of the constructor. */
  if (r[MAKER] != VS_FALSE) {
    if (r[MAKER] == VS_TRUE)
      return vs_expand_fail(x, pos, VS_ABSENT, "define-record-type: the constructor needs a name: %s",
                            vs_form_shape(VS_FORM_define_record_type));
    r[C] = vs_is_pair(r[MAKER]) ? vs_cdr(r[MAKER]) : r[B];
    for (l = r[C]; vs_is_pair(l); l = vs_cdr(l))
      if (field_index(r[FIELDS], vs_car(l)) < 0)
        return vs_expand_fail(x, pos, vs_car(l), "the constructor of this record type sets a field it does not have:");
    r[D] = VS_NIL;
    for (size_t n = (size_t)vs_list_length(r[B]); n-- > 0;) {
      l = r[B];
      for (size_t i = 0; i < n; i++) l = vs_cdr(l);
      bool given = false;
      for (vs_value k = r[C]; vs_is_pair(k); k = vs_cdr(k)) given = given || vs_car(k) == vs_car(l);
      if (!vs_cons(vm, given ? vs_car(l) : VS_FALSE, r[D], &r[D])) return false;
    }
    if (!vs_cons(vm, r[NAME], r[D], &r[D]) || !vs_core_name(vm, "%record", &r[E]) || !vs_cons(vm, r[E], r[D], &r[D]))
      return false;
    p[0] = r[C]; p[1] = r[D];
    if (!make(vm, "lambda", 2, p, &r[D]) ||
        !define(vm, vs_is_pair(r[MAKER]) ? vs_car(r[MAKER]) : r[MAKER], r[D], pos, &r[OUT]))
      return false;
  }
  if (!vs_core_name(vm, "record", &r[E])) return false;
  if (r[PRED] != VS_FALSE) {
    p[0] = r[E]; p[1] = r[NAME];
    if (!make(vm, "%record?", 2, p, &r[D]) || !vs_cons(vm, r[E], VS_NIL, &r[C])) return false;
    p[0] = r[C]; p[1] = r[D];
    if (!make(vm, "lambda", 2, p, &r[D]) || !define(vm, r[PRED], r[D], pos, &r[OUT])) return false;
  }
  int64_t index = 0;
  for (r[A] = r[FIELDS]; vs_is_pair(r[A]); r[A] = vs_cdr(r[A]), index++) {
    vs_value f = vs_car(r[A]);
    if (!vs_is_pair(f) || !vs_is_pair(vs_cdr(f))) continue;
    r[B] = vs_cdr(f);
    for (int set = 0; vs_is_pair(r[B]); r[B] = vs_cdr(r[B]), set++) {
      if (!quoted(vm, vs_car(r[B]), &r[D]) || !vs_core_name(vm, "value", &r[C])) return false;
      p[0] = r[E]; p[1] = r[NAME]; p[2] = vs_fix(index); p[3] = set ? r[C] : r[D]; p[4] = r[D];
      if (!make(vm, set ? "%record-set!" : "%record-ref", set ? 5 : 4, p, &r[D])) return false;
      p[0] = r[E]; p[1] = r[C];
      if (!vs_make_form_list(vm, &r[C], set ? 2 : 1, p)) return false;
      p[0] = r[C]; p[1] = r[D];
      if (!make(vm, "lambda", 2, p, &r[D]) || !define(vm, vs_car(r[B]), r[D], pos, &r[OUT])) return false;
    }
  }
  r[A] = VS_NIL;
  for (; vs_is_pair(r[OUT]); r[OUT] = vs_cdr(r[OUT])) if (!vs_cons(vm, vs_car(r[OUT]), r[A], &r[A])) return false;
  return vs_core_name(vm, "begin", &r[B]) && vs_cons_at(vm, r[B], r[A], pos, form);
}

/* Rewrites (include "a" "b" ...) to a `begin` that contains the forms of all these files. */
static bool include(vs_expansion *x, vs_value *form, bool fold) {
  vs_scheme *vm = x->vm;
  vs_pos pos = x->now.pos;
  if (vs_list_length(*form) < 2)
    return vs_expand_fail(x, pos, *form, "include is written %s, not", vs_form_shape(VS_FORM_include));
  VS_ROOTS(vm, r, 4);      /* roots of the garbage collector: names, all forms newest first, forms of one file,
                            * result */
  r[0] = vs_cdr(*form);
  r[1] = VS_NIL;
  for (; vs_is_pair(r[0]); r[0] = vs_cdr(r[0])) {
    if (!vs_is_string(vs_car(r[0])))
      return vs_expand_fail(x, pos, vs_car(r[0]), "include needs the name of a file as a string, not");
    bool circle;
    if (!vs_source_include(vm, vs_car(r[0]), vs_pos_file(pos), fold, &r[2], &circle))
      return circle && vs_expand_fail(x, pos, vs_car(r[0]), "this file includes itself, without end, through");
    for (; vs_is_pair(r[2]); r[2] = vs_cdr(r[2]))
      if (!vs_cons_at(vm, vs_car(r[2]), r[1], vs_pair_pos(r[2]), &r[1])) return false;
  }
  r[3] = VS_NIL;
  for (; vs_is_pair(r[1]); r[1] = vs_cdr(r[1]))
    if (!vs_cons_at(vm, vs_car(r[1]), r[3], vs_pair_pos(r[1]), &r[3])) return false;
  return vs_core_name(vm, "begin", &r[2]) && vs_cons_at(vm, r[2], r[3], pos, form);
}
bool vs_form_include(vs_expansion *x, vs_value *form) { return include(x, form, false); }
bool vs_form_include_ci(vs_expansion *x, vs_value *form) { return include(x, form, true); }

/* Implements (syntax-error "message" form ...), by which a macro reports an error in its use. */
bool vs_form_syntax_error(vs_expansion *x, vs_value *form) {
  vs_scheme *vm = x->vm;
  vs_value l = vs_cdr(*form);
  if (vs_list_length(*form) < 2 || !vs_is_string(vs_car(l)))
    return vs_expand_fail(x, x->now.pos, *form, "syntax-error is written %s, not", vs_form_shape(VS_FORM_syntax_error));
  VS_ROOTS(vm, r, 1);
  r[0] = vs_cdr(l);
  vs_text t;
  vs_text_open(vm, &t, 300);
  bool ok = vs_text_string(&t, vs_car(l)) && vs_text_end(&t) && vs_strip(vm, r[0], &r[0]) &&
            vs_fail_at(vm, vm->sym.syntax, x->now.pos, r[0], "%s", t.at);
  vs_text_close(&t);
  return ok;
}

/* ---- cond-expand ---- */
static const char *const features[] = { "r7rs",       "full-unicode", "ratios",       "exact-closed",
                                        "ieee-float", "fl-fast-fl+*", "visualscheme", "syntax-rules", NULL };

static bool add_feature(vs_scheme *vm, vs_value *list, const char *name) {
  VS_ROOTS(vm, r, 1);
  return vs_intern_c(vm, name, &r[0]) && vs_cons(vm, r[0], *list, list);
}
static bool add_srfi(vs_scheme *vm, void *list, int number) {
  char name[32];
  snprintf(name, sizeof name, "srfi-%d", number);
  return add_feature(vm, list, name);
}

bool vs_features(vs_scheme *vm, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  if (!vs_library_each_srfi(vm, add_srfi, &r[0])) return false;
  for (size_t i = 0; features[i]; i++) if (!add_feature(vm, &r[0], features[i])) return false;
  *out = r[0];
  return true;
}

static bool is_other_number(vs_scheme *vm, void *number, int n) { return (void)vm, n != *(const int *)number; }

static bool is_word(vs_value v, const char *word) {
  return vs_is_identifier(v) && !strcmp(vs_as_symbol(vs_identifier_symbol(v))->name, word);
}

/* Returns 1 if the requirement q of a cond-expand clause is fulfilled, 0 if not, and -1 with the error set. The nesting
 * of requirements is limited. */
static int holds(vs_expansion *x, vs_value q, int depth) {
  if (depth > 50) return vs_expand_fail(x, x->now.pos, VS_ABSENT, "this requirement is nested too deeply") - 1;
  if (vs_is_identifier(q)) {
    if (is_word(q, "else")) return 1;
    for (size_t i = 0; features[i]; i++) if (is_word(q, features[i])) return 1;
    int number;
    return sscanf(vs_as_symbol(vs_identifier_symbol(q))->name, "srfi-%d", &number) == 1 &&
           !vs_library_each_srfi(x->vm, is_other_number, &number);
  }
  int64_t n = vs_list_length(q);
  if (n < 1)
    return vs_expand_fail(
               x, x->now.pos, q,
               "cond-expand: a requirement is a name, (and ...), (or ...), (not ...) or (library (name)), not") -
           1;
  vs_value head = vs_car(q);
  bool conjunction = is_word(head, "and");
  if (conjunction || is_word(head, "or")) {
    for (vs_value l = vs_cdr(q); vs_is_pair(l); l = vs_cdr(l)) {
      int h = holds(x, vs_car(l), depth + 1);
      if (h < 0 || h == !conjunction) return h;
    }
    return conjunction;
  }
  if (is_word(head, "not") && n == 2) { int h = holds(x, vs_car(vs_cdr(q)), depth + 1); return h < 0 ? h : !h; }
  if (is_word(head, "library") && n == 2)
    return vs_library_known(x->vm, vs_car(vs_cdr(q)), vs_pos_file(x->now.pos), x->now.env);
  return vs_expand_fail(
             x, x->now.pos, q,
             "cond-expand: a requirement is a name, (and ...), (or ...), (not ...) or (library (name)), not") -
         1;
}

/* Sets *forms to the forms of the first clause whose requirement is fulfilled, or to VS_NIL. If it fails, sets the
 * error and returns false. */
bool vs_cond_expand(vs_expansion *x, vs_value form, vs_value *forms) {
  *forms = VS_NIL;
  for (vs_value l = vs_cdr(form); vs_is_pair(l); l = vs_cdr(l)) {
    if (vs_list_length(vs_car(l)) < 1)
      return vs_expand_fail(x, vs_element_pos(l, false, x->now.pos), vs_car(l),
                            "a clause of cond-expand is (requirement form ...), not");
    int h = holds(x, vs_car(vs_car(l)), 0);
    if (h < 0) return false;
    if (h) { *forms = vs_cdr(vs_car(l)); return true; }
  }
  return true;
}

bool vs_form_cond_expand(vs_expansion *x, vs_value *form) {
  vs_scheme *vm = x->vm;
  VS_ROOTS(vm, r, 2);
  return vs_cond_expand(x, *form, &r[0]) && vs_core_name(vm, "begin", &r[1]) &&
         vs_cons_at(vm, r[1], r[0], x->now.pos, form);
}
