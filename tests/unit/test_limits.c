/* Tests that limits and interrupts end every long operation: builtins, reading, expanding, compiling. Each operation
 * ends soon after the interrupt, with an error that names the limit and has a place in the program. The interpreter
 * works afterwards. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "model/store/store.h"
#include "session/session.h"
#include "visualscheme.h"
#include "vm/values/debug.h"

/* Returns the processor time of the process in seconds, which other load on the machine does not change. */
static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* ask_at: time from which an interrupt is requested; 0: no interrupt. asked: time at which the interpreter first polled
 * after ask_at; in seconds */
typedef struct { double ask_at, asked; char said[300]; unsigned line; } watch;

static bool poll_watch(void *context) {
  watch *w = context;
  if (w->ask_at == 0 || now() < w->ask_at) return false;
  if (w->asked == 0) w->asked = now();
  return true;
}
static void tell(void *context, const vs_diagnostic *d) {
  watch *w = context;
  if (d->severity != VS_SEVERITY_ERROR) return;
  snprintf(w->said, sizeof w->said, "%s", d->message);
  w->line = d->at.line;
}
static bool drop(void *context, const char *text, size_t length) { return (void)context, (void)text, (void)length, true; }

static vs_scheme *open_with(watch *w, vs_options o) {
  *w = (watch){ 0 };
  o.host.context = w, o.host.poll = poll_watch, o.host.diagnose = tell, o.host.output = drop;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  return s;
}
static vs_outcome eval(vs_scheme *s, watch *w, const char *text) {
  w->said[0] = 0, w->line = 0;
  return vs_eval_text(s, "program", 1, text, strlen(text), 0);
}
static void goes_on(vs_scheme *s, watch *w, const char *after) {
  w->ask_at = w->asked = 0;
  if (eval(s, w, "(define after (+ 1 2))") != VS_OUTCOME_DONE) fail_msg("after %s: %s", after, w->said);
}

/* Programs that are repeated until they are interrupted. made: the text of the definitions; done: the text that is
 * repeated, which runs for some tens of milliseconds or more. */
static const struct { const char *made, *done; } busy[] = {
  { "(define x (expt 3 100000))", "(expt x 20)" },
  { "(define x (expt 7/3 50000))", "(expt x 10)" },
  { "(define x (expt 3 600000))", "(* x x)" },
  { "(define x (expt 3 400000))", "(quotient (* x x) (+ x 1))" },
  { "(define x (expt 3 400000))", "(number->string x)" },
  { "(define x (expt 3 400000))", "(number->string x 16)" },
  { "(define s (make-string 300000 #\\7))", "(string->number s)" },
  { "(define s (make-string 50000 #\\7))", "(string->number (string-append \"#e\" s \".\" s))" },
  { "(define a (expt 3 100000)) (define b (expt 7 60000))", "(gcd (* a 12) (* b 9))" },
  { "(define a (expt 3 60000)) (define b (expt 7 40000))", "(exact->inexact (/ a b))" },
  { "(define a (expt 3 200000))", "(exact-integer-sqrt a)" },
  { "(define l (make-list 200000 1/3))", "(apply + l)" },
  { "(define l (iota 4000 1000000))", "(apply * l)" },
  { "(define l (iota 300000))", "(apply max l)" },
  { "(define l (iota 300000))", "(apply < l)" },
  { "(define l (map (lambda (i) (modulo (* i 7919) 100003)) (iota 100000)))", "(sort l <)" },
  { "(define l (iota 300000))", "(append l l)" },
  { "(define l (iota 300000))", "(reverse l)" },
  { "(define l (iota 300000))", "(list-copy l)" },
  { "(define l (iota 300000))", "(list->vector l)" },
  { "(define l (iota 300000))", "(member \"a\" l)" },
  { "(define l (iota 300000))", "(equal? l (list-copy l))" },
  { "(define l (let loop ((i 0) (l '())) (if (= i 200000) l (loop (+ i 1) (list l)))))", "(equal? l (list (car l)))" },
  { "(define l (make-list 300000 #\\a))", "(list->string l)" },
  { "(define s (make-string 3000000 #\\a))", "(string-append s s s)" },
  { "(define s (make-string 1000000 #\\a))", "(string->list s)" },
  { "(define s (make-string 1000000 #\\a))", "(string-upcase s)" },
  { "(define s (make-string 300000 #\\a))", "(string-ci=? s (string-copy s))" },
  { "(define s (make-string 300000 #\\a))", "(string-search s (string-append (make-string 150000 #\\a) \"b\"))" },
  { "(define s (make-string 300000 #\\a))", "(string-replace s \"a\" \"bc\")" },
  { "(define s (apply string-append (make-list 50000 \"ab,\")))", "(string-split s \",\")" },
  { "(define s (make-string 3000000 #\\a))", "(string->utf8 s)" },
  { "(define s (make-string 1000000 #\\x3BB))", "(string-join (list s s) s)" },
  { "", "(make-vector 3000000 0)" },
  { "", "(make-string 30000000 #\\a)" },
  { "", "(make-bytevector 30000000 1)" },
  { "", "(make-list 300000 1)" },
  { "", "(iota 300000)" },
  { "(define v (make-vector 1000000 0))", "(vector-fill! v 1)" },
  { "(define v (make-vector 1000000 0))", "(vector-append v v)" },
  { "(define v (make-vector 300000 0))", "(vector->list v)" },
  { "(define v (make-vector 300000 0))", "(equal? v (vector-copy v))" },
  { "(define l (iota 50000))", "(let ((h (make-hash))) (for-each (lambda (i) (hash-set! h i i)) l))" },
  { "(define l (iota 20000))", "(let ((h (make-hash))) (for-each (lambda (i) (hash-set! h (list i \"a\") i)) l))" },
  { "(define h (make-hash)) (for-each (lambda (i) (hash-set! h i i)) (iota 50000))", "(hash->list h)" },
  { "(define s (string-append \"(\" (apply string-append (make-list 50000 \"(a 1.5) \")) \")\"))", "(read (open-input-string s))" },
  { "(define s (make-string 300000 #\\space))", "(read (open-input-string s))" },
  { "(define s (make-string 1000000 #\\a))", "(read-line (open-input-string s))" },
  { "(define v (make-vector 50000 1.2345678e100))", "(write v (open-output-string))" },
  { "(define s (make-string 1000000 #\\a))", "(write s (open-output-string))" },
  { "(define l (let loop ((i 0) (l '())) (if (= i 100000) l (loop (+ i 1) (list l)))))", "(write l (open-output-string))" },
  { "(define s (make-string 1000000 #\\a))", "(format \"~a ~s\" s s)" },
  { "(define e (interaction-environment)) (define x (cons 'list (map (lambda (i) (list '+ i 1)) (iota 20000))))", "(eval x e)" },
  { "(define e (interaction-environment)) (define x (cons 'cond (map (lambda (i) (list (list 'eqv? 'e i) i)) (iota 20000))))", "(eval x e)" },
  { "(define e (interaction-environment)) (define x (list 'quasiquote (map (lambda (i) (list i ',e)) (iota 20000))))", "(eval x e)" },
  { "(define e (interaction-environment)) (define-syntax m (syntax-rules () ((_ a ...) (list (list a) ...)))) (define x (cons 'm (iota 20000)))", "(eval x e)" },
  { "(define e (interaction-environment)) (define x (let loop ((i 0) (x 1)) (if (= i 20000) x (loop (+ i 1) (list 'let (list (list 'a x)) 'a)))))", "(eval x e)" },
  { "(define l (map (lambda (i) (xyz i 0 0)) (iota 50000)))", "(make-line l)" },
  { "(define l (map (lambda (i) (make-sphere (xyz i 0 0) 1)) (iota 20000)))", "(unite l)" },
};
enum { BUSY = sizeof busy / sizeof *busy };

/* Repeats the work until it is interrupted. Returns the seconds from the interrupt to the end. */
static double time_to_end(vs_scheme *s, watch *w, const char *made, const char *done) {
  char text[400];
  if (eval(s, w, made) != VS_OUTCOME_DONE) fail_msg("%s: %s", made, w->said);
  snprintf(text, sizeof text, "(let loop ()\n  %s\n  (loop))", done);
  double ask_at = now() + 0.02;
  w->ask_at = ask_at;
  vs_outcome outcome = eval(s, w, text);
  double took = now() - ask_at;
  if (outcome != VS_OUTCOME_INTERRUPTED) fail_msg("%s: ended with %d: %s", done, (int)outcome, w->said);
  if (w->line == 0) fail_msg("%s: interrupted, but not said where", done);
  goes_on(s, w, done);
  return took;
}

/* By design each operation ends within 50 ms of an interrupt. The test allows half a second, because sanitizers and
 * garbage collections take time. On a virtual machine, the measured time may include time in which the process did not
 * run. Therefore the best of eight runs is compared. */
static void test_interrupts(void **state) {
  (void)state;
  watch w;
  vs_scheme *s = open_with(&w, vs_options_default());
  const double most = VS_DEBUG_STRESS ? 20 : 0.5;
  double worst = 0;
  const char *slowest = "";
  for (size_t i = 0; i < BUSY; i++) {
    double took = time_to_end(s, &w, busy[i].made, busy[i].done);
    for (int again = 0; took > most && again < 7; again++) took = fmin(took, time_to_end(s, &w, busy[i].made, busy[i].done));
    if (took > worst) worst = took, slowest = busy[i].done;
    if (took > most) fail_msg("%s: ended %.0f ms after it was asked to", busy[i].done, took * 1e3);
  }
  print_message("slowest to end: %.0f ms, %s\n", worst * 1e3, slowest);
  vs_free(s);
}

/* Runs the programs of test_interrupts under a time limit, which may be reached while the definitions are still being
 * evaluated. */
static void test_time(void **state) {
  (void)state;
  watch w;
  vs_scheme *s = open_with(&w, (vs_options){ .limit_time = 0.05 });
  for (size_t i = 0; i < BUSY; i++) {
    char text[700];
    snprintf(text, sizeof text, "%s\n(let loop ()\n  %s\n  (loop))", busy[i].made, busy[i].done);
    vs_outcome outcome = eval(s, &w, text);
    if (outcome != VS_OUTCOME_MACHINE || !strstr(w.said, "seconds, the limit") || w.line == 0)
      fail_msg("%s: ended with %d at line %u: %s", busy[i].done, (int)outcome, w.line, w.said);
    goes_on(s, &w, busy[i].done);
  }
  vs_free(s);
}

static void test_steps_and_output(void **state) {
  (void)state;
  static const char *const steps[] = { "(let loop () (loop))", "(define (f n) (+ 1 (f n))) (f 1)", "(for-each (lambda (i) (sort (iota 100) <)) (iota 1000000))",
                                       "(map (lambda (i) i) (iota 200000))", "(call/cc (lambda (k) (let loop () (call/cc (lambda (q) q)) (loop))))" };
  watch w;
  vs_scheme *s = open_with(&w, (vs_options){ .limit_steps = 50000 });
  for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
    if (eval(s, &w, steps[i]) != VS_OUTCOME_MACHINE || !strstr(w.said, "50000 steps, the limit") || w.line != 1) fail_msg("%s: line %u: %s", steps[i], w.line, w.said);
    goes_on(s, &w, steps[i]);
  }
  vs_free(s);
  static const char *const output[] = { "(let loop () (display \"abc\") (loop))", "(display (make-string 100000 #\\a))", "(write (iota 100000))",
                                        "(let loop () (newline) (loop))", "(printf \"~a\" (make-string 100000 #\\a))", "(write-string (make-string 100000 #\\a))" };
  s = open_with(&w, (vs_options){ .limit_output = 10000 });
  for (size_t i = 0; i < sizeof output / sizeof *output; i++) {
    if (eval(s, &w, output[i]) != VS_OUTCOME_MACHINE || !strstr(w.said, "the limit") || w.line != 1) fail_msg("%s: line %u: %s", output[i], w.line, w.said);
    goes_on(s, &w, output[i]);
  }
  vs_free(s);
}

static void test_memory(void **state) {
  (void)state;
  static const char *const hungry[] = {
    "(let loop ((l '())) (loop (cons 1 l)))", "(make-vector 100000000 0)", "(make-string 100000000 #\\a)", "(make-bytevector 100000000 0)",
    "(make-list 100000000 0)", "(iota 100000000)", "(let loop ((s \"a\")) (loop (string-append s s)))", "(let loop ((x 3)) (loop (* x x)))", "(expt 3 100000000)",
    "(let ((h (make-hash))) (let loop ((i 0)) (hash-set! h i i) (loop (+ i 1))))", "(let loop ((v #(1))) (loop (vector-append v v)))",
    "(let ((p (open-output-string))) (let loop () (write 123456789 p) (loop)))", "(read (open-input-string (apply string-append (make-list 40000 (make-string 100 #\\()))))",
    "(let loop ((l '(1))) (loop (append l l)))", "(let loop ((n 0) (l '())) (loop (+ n 1) (cons (make-sphere (xyz 0 0 n) 1) l)))",
    "(let loop ((o (make-sphere origin 1)) (n 0)) (loop (unite o (make-sphere (xyz n 0 0) 1)) (+ n 1)))",
    "(let loop ((k #f) (n 0)) (loop (cons (call/cc (lambda (c) c)) k) (+ n 1)))", "(list->string (make-list 3000000 #\\a))", "(string->list (make-string 3000000 #\\a))",
    "(eval (cons 'list (iota 2000000)) (interaction-environment))", "(let loop ((s 'a)) (loop (symbol-append s s)))", "(let loop ((v '())) (loop (cons (xyz 1 2 3) v)))",
  };
  watch w;
  vs_scheme *s = open_with(&w, (vs_options){ .limit_memory = 24u << 20 });
  for (size_t i = 0; i < sizeof hungry / sizeof *hungry; i++) {
    vs_outcome outcome = eval(s, &w, hungry[i]);
    /* a program may also end before its time limit, with the error that a number has too many digits */
    bool digits = outcome == VS_OUTCOME_MODEL && strstr(w.said, "million digits");
    if ((outcome != VS_OUTCOME_MACHINE || !strstr(w.said, "memory")) && !digits) fail_msg("%s: ended with %d: %s", hungry[i], (int)outcome, w.said);
    if (w.line != 1) fail_msg("%s: no place: %s", hungry[i], w.said);
    goes_on(s, &w, hungry[i]);
  }
  /* Endless recursion reaches a separate limit, half of the memory limit. The error names the procedure. */
  assert_int_equal(eval(s, &w, "(define (f) (+ 1 (f))) (f)"), VS_OUTCOME_MODEL);
  assert_non_null(strstr(w.said, "f calls itself here"));
  goes_on(s, &w, "(f)");
  vs_free(s);
}

/* ---- outputs ---- */

/* Drawings that take much time in the language, the passes and the writers, or in the mesh kernel. %u is the number of
 * parts. The variable `turn` has a different value in each run, so that no cached result is used. */
static const struct { const char *made; unsigned parts, many; } drawn[] = {
  { "(erase-all) (draw (unite (map (lambda (i) (make-box (xyz (* 2 i) 0 0) 1 1 (+ 1 (* i 1e-6) turn))) (iota %u))))", 5000,
    200000 },
  { "(erase-all) (draw (unite (map (lambda (i) (make-sphere (xyz (* .7 (remainder i 9)) (* .7 (quotient i 9)) (* .01 "
    "i)) (+ .6 turn))) (iota %u))))",
    20, 400 },
  { "(erase-all) (draw (subtract (make-box (xyz 0 0 0) 60 60 1) (unite (map (lambda (i) (make-cylinder (xyz (- "
    "(remainder i 20) 10) (- (quotient i 20) 10) -2) 4 (+ .3 turn))) (iota %u)))))",
    20, 400 },
};
enum { DRAWN = sizeof drawn / sizeof *drawn };

static bool swallow(void *context, const void *data, size_t size) { return (void)context, (void)data, (void)size, true; }

/* Measures the drawing if format is NULL; otherwise writes it in this format. */
static vs_outcome put_out(vs_scheme *s, const vs_format_info *format) {
  vs_summary all;
  if (format == NULL) return vs_drawing_summary(s, &all);
  return vs_write_drawing_to(s, format->name, NULL, swallow, NULL);
}

/* The summary, and every format that needs no other program, end soon after an interrupt. The interrupt comes at a
 * tenth, a half and nine tenths of the time for the whole output. */
static void test_outputs(void **state) {
  (void)state;
  const char *longer = getenv("LONG");
  bool many = longer && *longer;
  const double most = VS_DEBUG_STRESS ? 20 : 0.5;
  const double part[] = { .1, .5, .9 };
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  watch w;
  vs_scheme *s = open_with(&w, vs_options_default());
  double worst = 0, turns = 0;
  const char *slowest = "";
  for (size_t i = 0; i < DRAWN; i++) {
    char text[400];
    snprintf(text, sizeof text, drawn[i].made, many ? drawn[i].many : drawn[i].parts);
    for (size_t k = 0; k <= count; k++) {
      const vs_format_info *format = k < count ? &formats[k] : NULL;
      const char *name = format ? format->name : "the summary";
      if (format && format->worker) continue;
      double whole = 0;
      for (int j = -1; j < 3; j++) { /* the first turn measures the time without an interrupt */
        char again[60];
        snprintf(again, sizeof again, "(define turn %g)", 1e-6 * ++turns);
        if (eval(s, &w, again) != VS_OUTCOME_DONE || eval(s, &w, text) != VS_OUTCOME_DONE) fail_msg("%s: %s", text, w.said);
        double began = now();
        w.ask_at = j < 0 ? 0 : began + part[j] * whole, w.asked = 0;
        vs_outcome outcome = put_out(s, format);
        double ended = now(), took = ended - w.ask_at;
        if (j < 0) whole = ended - began;
        if (j < 0 && outcome != VS_OUTCOME_DONE && outcome != VS_OUTCOME_MODEL)
          fail_msg("%s of %s: %s", name, text, w.said);
        if (j >= 0 && outcome == VS_OUTCOME_DONE && took > most)
          fail_msg("%s of %s: does not notice an interrupt", name, text);
        if (j >= 0 && outcome == VS_OUTCOME_INTERRUPTED && took > worst) worst = took, slowest = name;
        if (j >= 0 && outcome == VS_OUTCOME_INTERRUPTED && took > most)
          fail_msg("%s of %s: ended %.0f ms after the interrupt", name, text, took * 1e3);
        goes_on(s, &w, name);
      }
      if (getenv("SHOW")) print_message("%zu %-14s %.3f s; slowest so far: %.0f ms, %s\n", i, name, whole, worst * 1e3, slowest);
    }
  }
  print_message("slowest output to end: %.0f ms, %s\n", worst * 1e3, slowest);
  vs_free(s);
}

/* An interrupted call leaves the model's memory to the system only if the host ends its process then, and never at
 * a limit. */
static void test_ends_after_interrupt(void **state) {
  (void)state;
  for (int ends = 0; ends < 2; ends++) {
    watch w;
    vs_scheme *s = open_with(&w, (vs_options){ .ends_after_interrupt = ends, .limit_steps = 1000000 });
    const vs_store *store = vs_session_of(s)->bind.store;
    assert_int_equal(eval(s, &w, "(draw (unite (for/list ([i 20000]) (make-sphere (xyz i 0 0) 1))))"), VS_OUTCOME_DONE);
    assert_int_equal(eval(s, &w, "(let loop () (loop))"), VS_OUTCOME_MACHINE);
    assert_false(vs_store_is_abandoned(store));
    w.ask_at = now(), w.asked = 0;
    assert_int_equal(vs_write_drawing_to(s, "tree", NULL, swallow, NULL), VS_OUTCOME_INTERRUPTED);
    assert_int_equal(vs_store_is_abandoned(store), ends);
    vs_free(s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_interrupts), cmocka_unit_test(test_time), cmocka_unit_test(test_steps_and_output), cmocka_unit_test(test_memory),
                                      cmocka_unit_test(test_outputs), cmocka_unit_test(test_ends_after_interrupt) };
  return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
