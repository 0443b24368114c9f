/* Tests that the table of shapes (tests/cross/shapes.vs) calls every constructor in each form of its arguments, with
 * each optional argument and each keyword. The tests of tests/cross then compare the resulting objects in every format.
 *
 * The linker replaces vs_bind_call by a function of this file (--wrap), which records the form that the call has
 * chosen. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "bind/call/call.h"
#include "bind/call/contract.h"
#include "bind/call/procedure.h"
#include "bind/procedures.h"
#include "visualscheme.h"
#include "vm/machine/open_vm.h"

enum { ROWS = 1024 };
static const char shapes[] = "(define-syntax shape (syntax-rules () ((_ name object . options) object)))"
                             "(load \"tests/cross/shapes.vs\")";
/* others: constructors whose names do not begin with make- or do-. values: constructors whose results are not
 * objects. */
static const char others[] = " hull load-mesh unite intersect subtract cylinder-from-to scale rotate translate ";
static const char values[] = " make-axis make-plane make-matrix make-material ";

static const vs_bind_columns *real; /* the table of procedures of the interpreter under test */
static struct { bool form[VS_MAX_FORMS], argument[VS_MAX_FORMS][VS_MAX_ARGUMENTS], key[VS_MAX_KEYS]; } seen[ROWS];

static vs_status record(vs_args *f, vs_value *out) {
  ptrdiff_t row = f->procedure - real->procedures;
  seen[row].form[f->form] = true;
  for (int i = 0; i < f->count; i++) seen[row].argument[f->form][i] |= f->arg[i].given;
  for (int i = 0; f->procedure->key[i].mode != VS_ARG_END; i++) seen[row].key[i] |= f->key[i].given;
  return real->functions[row](f, out);
}

static bool differentiate(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out,
                          vs_status *status) {
  (void)procedure;
  return real->differentiate(vm, real->functions[vm->native->def - real->natives], a, n, out, status);
}

vs_status __real_vs_bind_call(vs_scheme *vm, const vs_bind_columns *table, vs_value *a, int n, vs_value *out);
vs_status __wrap_vs_bind_call(vs_scheme *vm, const vs_bind_columns *table, vs_value *a, int n, vs_value *out);
vs_status __wrap_vs_bind_call(vs_scheme *vm, const vs_bind_columns *table, vs_value *a, int n, vs_value *out) {
  static vs_procedure_fn *recorders[ROWS];
  if (!real)
    for (size_t i = 0; i < ROWS; i++) recorders[i] = record;
  real = table;
  vs_bind_columns recorded = *table;
  recorded.functions = recorders, recorded.differentiate = differentiate;
  return __real_vs_bind_call(vm, &recorded, a, n, out);
}

/* Returns true if one of the space-separated names belongs to a constructor of objects. */
static bool makes_objects(const char *names) {
  char word[64];
  for (const char *at = names; *at; at += strspn(at, " ")) {
    size_t n = strcspn(at, " ");
    snprintf(word, sizeof word, " %.*s ", (int)n, at);
    at += n;
    if (strstr(values, word) || (n > 6 && strstr(word, "-scope "))) return false;
    if (strncmp(word, " make-", 6) == 0 || strncmp(word, " do-", 4) == 0 || strstr(others, word)) return true;
  }
  return false;
}

static void hear(void *context, const vs_diagnostic *d) {
  (void)context;
  if (d->severity == VS_SEVERITY_ERROR) fprintf(stderr, "%s\n", d->message);
}

/* Prints the call in this form: "(make-box p q)". */
static void print_form(const char *names, const vs_form *form) {
  fprintf(stderr, "(%.*s", (int)strcspn(names, " "), names);
  for (const vs_bind_param *p = form->at; p->mode != VS_ARG_END; p++)
    fprintf(stderr, p->mode == VS_ARG_OPTIONAL ? " [%s]" : p->mode == VS_ARG_REST ? " %s ..." : " %s", p->name);
  fputs(")", stderr);
}

static int missing_of(size_t row) {
  const vs_procedure *p = &vs_bind_procedures[row];
  const char *names = vs_bind_defs[row].name;
  int missing = 0;
  for (int i = 0; i < VS_MAX_FORMS && p->form[i].used; i++) {
    if (!seen[row].form[i])
      missing++, fputs("no row of tests/cross/shapes.vs calls ", stderr), print_form(names, &p->form[i]),
          fputs("\n", stderr);
    for (int k = 0; seen[row].form[i] && p->form[i].at[k].mode != VS_ARG_END; k++)
      if (p->form[i].at[k].mode == VS_ARG_OPTIONAL && !seen[row].argument[i][k])
        missing++, fprintf(stderr, "no row of tests/cross/shapes.vs gives %s of ", p->form[i].at[k].name),
            print_form(names, &p->form[i]), fputs("\n", stderr);
  }
  for (int i = 0; p->key[i].mode != VS_ARG_END; i++)
    if (!seen[row].key[i])
      missing++, fprintf(stderr, "no row of tests/cross/shapes.vs gives #:%s of %s\n", p->key[i].name, names);
  return missing;
}

static void every_form_has_a_row(void **state) {
  (void)state;
  vs_options o = vs_options_default();
  int missing = 0, forms = 0;
  o.host = (vs_host){ .diagnose = hear };
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  assert_int_equal(vs_eval_text(s, "forms", 1, shapes, strlen(shapes), 0), VS_OUTCOME_DONE);
  for (size_t row = 0; vs_bind_defs[row].name; row++) {
    assert_true(row < ROWS);
    if (!makes_objects(vs_bind_defs[row].name)) continue;
    missing += missing_of(row);
    for (int i = 0; i < VS_MAX_FORMS && vs_bind_procedures[row].form[i].used; i++) forms++;
  }
  vs_free(s);
  if (getenv("TELL")) fprintf(stderr, "%d forms\n", forms);
  assert_true(forms > 50);
  assert_int_equal(missing, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(every_form_has_a_row) };
  cmocka_set_test_filter(getenv("TESTS"));
  return cmocka_run_group_tests_name("forms of constructors", tests, NULL, NULL);
}
