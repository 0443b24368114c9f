/* Runs the checks of a program: (check-expect expression value) and similar forms. They wait in a queue until the
 * program ends (vm/machine/check_queue.c). This file decides whether each check passes. A listener shows the result:
 * `vs test` prints a line for each check, other runs print failures as warnings.
 *
 * A check may draw and set variables, but the program's drawing remains unchanged. */
#include "session/checking.h"

#include <string.h>

#include "bind/objects.h"
#include "session/drawing/comparison.h"
#include "session/evaluation.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"
#include "session/stops.h"
#include "vm/front/environment.h"
#include "vm/library/string.h"
#include "vm/machine/check_queue.h"
#include "vm/machine/run.h"
#include "vm/values/gc.h"
#include "vm/values/heap.h"
#include "vm/values/printer.h"

/* SHOWN: greatest length in bytes of a value's text in a report */
enum { SHOWN = 1000, LINE = 200 /* LINE: greatest length in bytes of an expression's text in a report */ };

/* Indices in the array of values that the garbage collector visits during a check: the check, the results of its
 * procedures, the differences, and two intermediate values. */
enum { CHECK, ACTUAL, EXPECTED, TOLERANCE, FOUND, SHOWN_AS, WORK, ROOTS };

typedef struct {
  vs_session *session;
  vs_value *r;                         /* array of ROOTS values, which the garbage collector visits */
  vs_text expression, gives, expected; /* texts for the report: the expression, its value, and the expected value */
  bool passed, interrupted;
} trial;

/* ---- texts of the report ---- */

static bool put_cut(vs_scheme *vm, vs_value v, size_t most, vs_text *t) {
  vs_text shown;
  vs_text_open(vm, &shown, most);
  bool ok = vs_print(vm, v, VS_PRINT_WRITE, &shown);
  ok = ok && vs_text_put(t, shown.at ? shown.at : "", shown.count) && (!shown.cut || vs_text_puts(t, " ..."));
  vs_text_close(&shown);
  return ok;
}

/* Calls a procedure of the library that has no name in programs. Returns false if the call fails. */
static bool call_library(trial *c, const char *name, size_t n, const vs_value *argv, vs_value *out) {
  vs_scheme *vm = c->session->bind.vm;
  if (!vs_intern_c(vm, name, &c->r[WORK])) return false;
  c->r[WORK] = vs_environment_value(vm->at.core, c->r[WORK]);
  return vs_run(vm, c->r[WORK], n, argv, out);
}

/* Appends the text and the place of the error in vm->condition to t, and clears vm->condition. Sets c->interrupted if
 * the error is an interrupt. */
static bool put_failure(trial *c, vs_text *t) {
  vs_scheme *vm = c->session->bind.vm;
  vs_value *r = c->r;
  vs_span at = { 0 };
  char place[24];
  r[WORK] = vm->condition;
  vm->condition = VS_FALSE;
  if (vs_session_is_exit(r[WORK])) return vs_text_puts(t, "(exit), which ends the program");
  if (vs_is(r[WORK], VS_T_CONDITION)) {
    const vs_condition *condition = vs_as_condition(r[WORK]);
    c->interrupted = c->interrupted || condition->kind == vm->sym.interrupt;
    vs_session_condition_place(c->session, condition, &at);
    if (condition->kind == vm->sym.memory) vs_gc_major(vm); /* if memory ran out, frees the values that filled it */
  }
  bool ok = vs_text_puts(t, "an error: ") && vs_print_condition(vm, r[WORK], t);
  if (!at.file) return ok;
  snprintf(place, sizeof place, ":%u:%u)", (unsigned)at.line, (unsigned)at.column);
  return ok && vs_text_puts(t, " (") && vs_text_puts(t, at.file) && vs_text_puts(t, place);
}

/* ---- deciding whether a check passes ---- */

/* Calls a procedure of the check. Stores its value in r[root], and appends the value as text to `told`. If the call
 * fails, appends the text of the error instead, and returns false. */
static bool ask(trial *c, int word, int root, vs_text *told) {
  vs_scheme *vm = c->session->bind.vm;
  c->r[WORK] = vs_as_vector(c->r[CHECK])->at[word];
  if (!vs_run(vm, c->r[WORK], 0, NULL, &c->r[root])) return put_failure(c, told), false;
  bool shown = call_library(c, "%check-shown", 1, &c->r[root], &c->r[SHOWN_AS]);
  return put_cut(vm, c->r[shown ? SHOWN_AS : root], SHOWN, told);
}

/* Returns true if the text of the error contains the string. */
static bool says(vs_scheme *vm, vs_value condition, vs_value string) {
  vs_text all, part;
  vs_text_open(vm, &all, 0);
  vs_text_open(vm, &part, 0);
  bool ok = vs_print_condition(vm, condition, &all) && vs_text_end(&all) && vs_text_string(&part, string) &&
            vs_text_end(&part) && strstr(all.at, part.at) != NULL;
  vs_text_close(&all);
  vs_text_close(&part);
  return ok;
}

/* Returns true for an error in the program, false for a limit that was reached or a call of (exit). */
static bool is_failure(const vs_scheme *vm, vs_value condition) {
  if (vs_session_is_exit(condition)) return false;
  if (!vs_is(condition, VS_T_CONDITION)) return true; /* the program has raised an object of its own, as in (raise
                                                       * 'oops) */
  vs_value kind = vs_as_condition(condition)->kind;
  return kind != vm->sym.memory && kind != vm->sym.limit && kind != vm->sym.interrupt;
}

static void judge_error(trial *c) {
  vs_scheme *vm = c->session->bind.vm;
  bool any = vs_as_vector(c->r[CHECK])->at[VS_CHECK_EXPECTED] == VS_FALSE;
  vs_text_puts(&c->expected, any ? "an error" : "an error with ");
  bool known = any || ask(c, VS_CHECK_EXPECTED, EXPECTED, &c->expected);
  if (known && !any && !vs_is_string(c->r[EXPECTED])) {
    vs_text_puts(&c->expected, ", which is no string");
    known = false;
  }
  if (ask(c, VS_CHECK_ACTUAL, ACTUAL, &c->gives)) return;
  c->r[ACTUAL] = c->r[WORK];
  c->passed = known && is_failure(vm, c->r[ACTUAL]) && (any || says(vm, c->r[ACTUAL], c->r[EXPECTED]));
}

static void objects_of(vs_value pair, vs_ref objects[2]) {
  objects[0] = vs_bind_take_ref(vs_cdr(pair));
  objects[1] = vs_bind_take_ref(vs_car(pair));
}

/* Returns true if the parts of the objects agree, for each pair of objects in the list r[FOUND]. */
static bool objects_agree(trial *c) {
  bool same = true;
  for (vs_value l = c->r[FOUND]; same && vs_is_pair(l); l = vs_cdr(l)) {
    vs_ref objects[2];
    vs_error e = { 0 };
    objects_of(vs_car(l), objects);
    same = vs_session_compare_objects(c->session, objects, &same, NULL, &e) && same;
    c->interrupted = c->interrupted || e.kind == VS_ERROR_INTERRUPT;
  }
  return same;
}

static void judge_value(trial *c) {
  vs_value *r = c->r;
  bool within = vs_as_vector(r[CHECK])->at[VS_CHECK_TOLERANCE] != VS_FALSE;
  bool ok = ask(c, VS_CHECK_ACTUAL, ACTUAL, &c->gives);
  ok = !c->interrupted && ask(c, VS_CHECK_EXPECTED, EXPECTED, &c->expected) && ok;
  r[TOLERANCE] = VS_FALSE;
  if (within && !c->interrupted) ok = vs_text_puts(&c->expected, " within ") && ask(c, VS_CHECK_TOLERANCE, TOLERANCE,
      &c->expected) && ok;
  if (!ok) return;
  if (!call_library(c, "%check-differences", 3, &r[ACTUAL], &r[FOUND])) {
    vs_text_puts(&c->expected, ": ");
    put_failure(c, &c->expected);
    r[FOUND] = VS_FALSE;
  }
  c->passed = r[FOUND] != VS_FALSE && objects_agree(c);
}

/* Removes the oldest check from the queue and runs it. Drawing in a check does not change the program's drawing. */
static void judge(trial *c) {
  vs_session *s = c->session;
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, rest, 1);
  c->r[CHECK] = vs_checks_take(vm);
  rest[0] = vm->at.checks;
  vm->at.checks = VS_TRUE; /* the value #t marks that a check is running */
  bool handing = s->bind.handing, away = s->bind.away;
  s->bind.handing = s->bind.away = true;
  put_cut(vm, vs_as_vector(c->r[CHECK])->at[VS_CHECK_EXPRESSION], LINE, &c->expression);
  if (!strcmp(vs_as_symbol(vs_as_vector(c->r[CHECK])->at[VS_CHECK_FORM])->name, "check-error")) judge_error(c);
  else judge_value(c);
  s->bind.handing = handing, s->bind.away = away;
  vm->at.checks = rest[0];
}

static void tell_parts(trial *c, const vs_check_listener *to) {
  vs_part_listener listener = { to->part, to->context };
  for (vs_value l = c->r[FOUND]; to->part && vs_is_pair(l); l = vs_cdr(l)) {
    vs_ref objects[2];
    vs_error e = { 0 };
    bool same;
    objects_of(vs_car(l), objects);
    if (!vs_session_compare_objects(c->session, objects, &same, &listener, &e)) return;
  }
}

/* Runs the oldest check and reports it to the listener. If the check is interrupted, returns false without a report. */
static bool next_check(vs_session *s, const vs_check_listener *to) {
  vs_scheme *vm = s->bind.vm;
  VS_ROOTS(vm, r, ROOTS);
  trial c = { .session = s, .r = r };
  vs_text_open(vm, &c.expression, 0);
  vs_text_open(vm, &c.gives, 0);
  vs_text_open(vm, &c.expected, 0);
  judge(&c);
  vs_vector *v = vs_as_vector(r[CHECK]);
  vs_checked result = { .passed = c.passed, .form = vs_as_symbol(v->at[VS_CHECK_FORM])->name };
  vs_session_span(s, vs_pos_of(v->at[VS_CHECK_PLACE]), &result.at);
  result.expression = vs_text_end(&c.expression) ? c.expression.at : "";
  result.gives = vs_text_end(&c.gives) ? c.gives.at : "";
  result.expected = vs_text_end(&c.expected) ? c.expected.at : "";
  if (!c.interrupted) to->told(to->context, &result);
  if (!c.interrupted && !c.passed) tell_parts(&c, to);
  vs_text_close(&c.expression);
  vs_text_close(&c.gives);
  vs_text_close(&c.expected);
  vm->condition = VS_FALSE;
  return !c.interrupted;
}

/* ---- running all checks ---- */

static void begin(vs_session *s) {
  vs_tally_enter(&s->tally, VS_WORK_RUN);
  vs_session_arm(s, VS_EVAL_PASS);
  s->phase = "checking", s->told_progress = vs_session_clock(s);
}

static vs_outcome end(vs_session *s, bool ok) {
  vs_session_release_objects(s);
  s->phase = NULL;
  vs_tally_enter(&s->tally, VS_WORK_NONE);
  if (ok) return VS_OUTCOME_DONE;
  vs_session_report_at(s, VS_SEVERITY_ERROR, VS_OUTCOME_INTERRUPTED, (vs_span){ 0 }, "interrupted");
  return VS_OUTCOME_INTERRUPTED;
}

static void warn(void *session, const vs_checked *c) {
  vs_session *s = session;
  if (c->passed) return;
  vs_text t;
  vs_text_open(s->bind.vm, &t, 0);
  bool ok = vs_text_puts(&t, c->form) && vs_text_puts(&t, ": ") && vs_text_puts(&t, c->expression) &&
            vs_text_puts(&t, " gives ") && vs_text_puts(&t, c->gives) && vs_text_puts(&t, ", expected ") &&
            vs_text_puts(&t, c->expected) && vs_text_end(&t);
  vs_session_report_at(s, VS_SEVERITY_WARNING, VS_OUTCOME_DONE, c->at, ok ? t.at : "a check failed");
  vs_text_close(&t);
}

vs_outcome vs_session_check(vs_session *s, unsigned flags) {
  vs_scheme *vm = s->bind.vm;
  if (flags & VS_EVAL_CHECK_LATER || !vs_checks_wait(vm)) return VS_OUTCOME_DONE;
  bool ok = true;
  if (!(flags & VS_EVAL_PASS)) {
    begin(s);
    while (ok && vs_checks_wait(vm)) ok = next_check(s, &(vs_check_listener){ .context = s, .told = warn });
    end(s, ok);
  }
  vm->at.checks = VS_NIL;
  return ok ? VS_OUTCOME_DONE : VS_OUTCOME_INTERRUPTED;
}

bool vs_check_waits(const vs_scheme *vm) { return vs_checks_wait(vm); }

vs_outcome vs_check_next(vs_scheme *vm, const vs_check_listener *listener) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_check_next")) return VS_OUTCOME_USAGE;
  if (!vs_checks_wait(vm)) return VS_OUTCOME_DONE;
  vm->steps = vm->written = 0; /* checks begin with new counts for the limits of steps and output */
  vm->started = vs_session_clock(s);
  begin(s);
  return end(s, next_check(s, listener));
}

const char *vs_check_redefined(vs_scheme *vm) { return vs_checks_redefined(vm); }
