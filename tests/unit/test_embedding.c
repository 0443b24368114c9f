/* Tests that memory may run out anywhere: the n-th allocation of a whole session is refused, for every n in turn. The
 * library does not crash, reports the failure to its caller, and frees all memory. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "visualscheme.h"
#include "vm/machine/vs.h"

typedef struct { long left; /* left: number of allocations until one is refused; negative if none is to be refused */ size_t live, blocks; int told; } budget;

static void *take(void *context, void *old, size_t old_size, size_t new_size) {
  budget *b = context;
  if (new_size > old_size && b->left >= 0 && b->left-- == 0) return NULL;
  if (new_size == 0) {
    if (old) b->blocks--;
    b->live -= old_size;
    free(old);
    return NULL;
  }
  void *p = realloc(old, new_size);
  assert_non_null(p);
  if (!old) b->blocks++;
  b->live += new_size - old_size;
  return p;
}

static void told(void *context, const vs_diagnostic *d) {
  budget *b = context;
  assert_non_null(d->message);
  b->told++;
}
static bool drop(void *context, const void *bytes, size_t count) {
  (void)context, (void)bytes, (void)count;
  return true;
}

static const char program[] =
  "(define-parameter n 3 #:min 1 #:max 9)\n"
  "(define (column p [r positive? 0.5]) (with-material 'concrete (make-cylinder p 3 r)))\n"
  "(draw (unite (map column (line-sequence (xyz 0 0 0) (xyz 9 0 0) n))))\n"
  "(draw (subtract (make-box (xyz 0 0 3) (xyz 9 1 4)) (make-sphere (xyz 4 0 3) 1)))\n"
  "(draw (do-sweep (make-circle (xyz 0 0 0) 1/4) (make-spline (list (xyz 0 0 0) (xyz 1 0 4) (xyz 9 0 5))) 0 0.5))\n"
  "(make-cylinder (xyz 0 0 0) (xyz 0 0 0) 1)\n";

/* runs a session that uses the whole interface; returns true if all of it succeeded */
static bool session(budget *b) {
  vs_options o = vs_options_default();
  o.alloc = take, o.alloc_context = b;
  o.host.context = b, o.host.diagnose = told;
  vs_scheme *s = vs_new(&o);
  bool ok = s != NULL;
  if (ok) ok = vs_parameter_set(s, "n", "4");
  if (ok) {
    vs_outcome outcome = vs_eval_text(s, "text", 1, program, sizeof program - 1, 0);
    assert_true(outcome == VS_OUTCOME_DONE || outcome == VS_OUTCOME_MACHINE);
    ok = outcome == VS_OUTCOME_DONE;
  }
  vs_summary summary;
  if (ok) ok = vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE;
  for (int twice = 0; ok && twice < 2; twice++) { /* writes the drawing twice, because writing it must not change it */
    vs_outcome outcome = vs_write_drawing_to(s, twice ? "tree" : "povray", NULL, drop, b);
    assert_true(outcome == VS_OUTCOME_DONE || outcome == VS_OUTCOME_MACHINE);
    ok = outcome == VS_OUTCOME_DONE;
  }
  vs_free(s);
  return ok;
}

static void test_refusals(void **state) {
  (void)state;
  long n = 0, step = 1;
  for (;; n += step) {
    budget b = { .left = n };
    bool ok = session(&b);
    assert_int_equal(b.live, 0);
    assert_int_equal(b.blocks, 0);
    if (b.left >= 0) { /* the session made fewer than n allocations, so none was refused and the test is complete */
      assert_true(ok);
      break;
    }
    if (n > 400) step = 7; /* after the first 400 allocations, only every seventh is tested, because later allocations
                            * are similar */
  }
  assert_true(n > 20);
}

static void test_limit(void **state) { /* the drawing counts towards the memory limit; after a program has reached the
                                        * limit, the interpreter still works */
  (void)state;
  budget b = { .left = -1 };
  vs_options o = vs_options_default();
  o.limit_memory = 24u << 20;
  o.host.context = &b, o.host.diagnose = told;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  static const char hungry[] = "(let loop ((n 0) (l '())) (loop (+ n 1) (cons (make-sphere (xyz 0 0 n) 1) l)))";
  static const char lists[] = "(let loop ((l '())) (loop (cons 1 l)))";
  assert_int_equal(vs_eval_text(s, "lists", 1, lists, sizeof lists - 1, 0), VS_OUTCOME_MACHINE);
  assert_int_equal(vs_eval_text(s, "after", 1, "(+ 1 2)", 7, 0), VS_OUTCOME_DONE);
  assert_int_equal(vs_eval_text(s, "objects", 1, hungry, sizeof hungry - 1, 0), VS_OUTCOME_MACHINE);
  assert_int_equal(vs_eval_text(s, "after", 1, "(make-sphere (xyz 0 0 0) 1)", 27, 0), VS_OUTCOME_DONE);
  vs_free(s);
}

/* ---- programs that are stopped ---- */

static const char stepped[] =
  "(define (area w h) (* w h))\n"
  "(define (wall n) (let* ([a (area n 2)] [b (+ a 1)]) (break) (list a b n)))\n"
  "(define (deep n) (if (= n 0) (begin (break) 0) (+ 1 (deep (- n 1)))))\n";

static vs_outcome run(vs_scheme *s, const char *text, unsigned flags) { return vs_eval_text(s, "t", 1, text,
    strlen(text), flags); }

static void shown(void *context, const char *text, size_t length) {
  char *last = context;
  if (length > 99) length = 99;
  memcpy(last, text, length);
  last[length] = 0;
}

static void test_stops(void **state) {
  (void)state;
  enum { STOP = VS_EVAL_STOP | VS_EVAL_PRINT | VS_EVAL_WITHIN };
  char last[100] = "";
  vs_options o = vs_options_default();
  o.keep_calls = true, o.host.context = last, o.host.value = shown;
  vs_scheme *s = vs_new(&o);
  vs_stop_info stop;
  vs_call_info call;
  assert_false(vs_stop_get(s, &stop));
  assert_int_equal(vs_resume(s, VS_RESUME_CONTINUE), VS_OUTCOME_USAGE);
  assert_int_equal(run(s, stepped, 0), VS_OUTCOME_DONE);
  assert_int_equal(run(s, "(wall 3)", STOP & ~VS_EVAL_STOP), VS_OUTCOME_DONE); /* without VS_EVAL_STOP, the procedure
                                                                                * (break) only warns */
  assert_string_equal(last, "(6 7 3)");
  assert_int_equal(run(s, "(wall 4)", STOP), VS_OUTCOME_STOPPED);
  assert_true(vs_stop_get(s, &stop));
  assert_int_equal(stop.kind, VS_STOPPED_BREAK);
  assert_string_equal(stop.procedure, "wall");
  assert_int_equal(stop.at.line, 2);
  assert_true(vs_call_get(s, 0, &call));
  assert_string_equal(call.variables, "n = 4, a = 8, b = 9");
  /* expressions that are evaluated while the program is stopped can use its variables, even after a garbage collection;
   * a program may stop again while another stop is active */
  assert_int_equal(run(s, "(list b a)", STOP), VS_OUTCOME_DONE);
  assert_string_equal(last, "(9 8)");
  assert_int_equal(run(s, "(deep 100000)", STOP), VS_OUTCOME_STOPPED);
  assert_int_equal(vs_stop_depth(s), 2);
  assert_int_equal(run(s,
      "(let loop ([i 0] [l '()]) (if (< i 2000000) (loop (+ i 1) (cons i l)) (+ n (length l))))", STOP),
      VS_OUTCOME_DONE);
  assert_string_equal(last, "2000000");
  assert_int_equal(run(s, "(car 5)", STOP), VS_OUTCOME_MODEL); /* an error in an expression that is evaluated at a stop
                                                                * does not end the stop */
  assert_int_equal(vs_stop_depth(s), 2);
  /* steps out of one of 100,000 nested calls: the next stop is in the caller of that call */
  assert_int_equal(vs_resume(s, VS_RESUME_OUT), VS_OUTCOME_STOPPED);
  assert_true(vs_stop_get(s, &stop));
  assert_int_equal(stop.kind, VS_STOPPED_VALUE);
  assert_string_equal(stop.text, "0");
  assert_int_equal(vs_resume(s, VS_RESUME_SAME), VS_OUTCOME_STOPPED);
  assert_true(vs_stop_get(s, &stop));
  assert_int_equal(stop.kind, VS_STOPPED_CALL);
  assert_string_equal(stop.text, "(+ 1 0)");
  assert_int_equal(vs_resume(s, VS_RESUME_CONTINUE), VS_OUTCOME_DONE);
  assert_string_equal(last, "100000");
  assert_int_equal(vs_stop_depth(s), 1);
  assert_int_equal(vs_resume(s, VS_RESUME_CONTINUE), VS_OUTCOME_DONE);
  assert_string_equal(last, "(8 9 4)");
  /* a restart removes all stops, including a stop that the host abandoned */
  assert_int_equal(run(s, "(wall 5)", STOP), VS_OUTCOME_STOPPED);
  vs_stop_drop(s);
  assert_int_equal(vs_stop_depth(s), 0);
  assert_int_equal(run(s, "(wall 5)", STOP | VS_EVAL_STEP), VS_OUTCOME_STOPPED);
  assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
  assert_int_equal(vs_stop_depth(s), 0);
  vs_free(s);
}

/* Runs a session that steps through a program to its end. Returns false if an allocation was refused. */
static bool step_session(budget *b) {
  vs_options o = vs_options_default();
  o.alloc = take, o.alloc_context = b;
  o.keep_calls = true, o.host.context = b, o.host.diagnose = told;
  vs_scheme *s = vs_new(&o);
  bool ok = s && run(s, stepped, 0) == VS_OUTCOME_DONE;
  vs_outcome outcome = ok ? run(s, "(wall 3)", VS_EVAL_STOP | VS_EVAL_STEP) : VS_OUTCOME_MACHINE;
  size_t stops = 0;
  vs_stop_info stop;
  while (outcome == VS_OUTCOME_STOPPED && stops++ < 100) {
    assert_true(vs_stop_get(s, &stop));
    outcome = vs_resume(s, VS_RESUME_ENTER);
  }
  assert_true(outcome == VS_OUTCOME_DONE || outcome == VS_OUTCOME_MACHINE);
  assert_true(outcome != VS_OUTCOME_DONE || stops == 10);
  vs_free(s);
  return outcome == VS_OUTCOME_DONE;
}

static void test_stops_refused(void **state) {
  (void)state;
  for (long n = 0;; n++) {
    budget b = { .left = n };
    bool ok = step_session(&b);
    assert_int_equal(b.live, 0);
    assert_int_equal(b.blocks, 0);
    if (b.left < 0) continue;
    assert_true(ok);
    break;
  }
}

/* Tests a corrected fault. A restart subtracted the bytes of the old heap from those of the new heap. The count fell
 * below 0, so an empty heap seemed to exceed the limit. */
static void test_restarts_under_a_limit(void **state) {
  (void)state;
  budget b = { .left = -1 };
  vs_options o = vs_options_default();
  o.limit_memory = 64u << 20;
  o.host.context = &b, o.host.diagnose = told;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  size_t anew = 0;
  for (int i = 0; i < 20; i++) {
    assert_int_equal(run(s, "(define (f x) (if (< x 2) x (* x (f (- x 1))))) (f 20)", 0), VS_OUTCOME_DONE);
    assert_int_equal(run(s, "(lambda (x) (if))", 0), VS_OUTCOME_MODEL);
    assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
    /* Restarts twice, since only every other restart maps the image of the heap from its file. Mapped memory does not
     * count. */
    assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
    if (i == 0) anew = s->bytes;
    assert_int_equal(s->bytes, anew);
    assert_int_equal(run(s, "(define p (open-input-string \"a b\")) (read p)", 0), VS_OUTCOME_DONE);
    assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
    assert_int_equal(run(s, "(define p (open-output-string)) (write 'abc p) (if)", 0), VS_OUTCOME_MODEL);
    assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
    assert_int_equal(s->bytes, anew);
  }
  vs_free(s);
}

/* A host checks the syntax of a long text while no program runs. The time and memory limits of the last evaluation must
 * not apply. */
static void test_reading_after_a_limit(void **state) {
  (void)state;
  enum { LONG = 1 << 20 };
  budget b = { .left = -1 };
  vs_options o = vs_options_default();
  o.limit_steps = 100000;
  o.host.context = &b, o.host.diagnose = told;
  vs_scheme *s = vs_new(&o);
  char *text = malloc(LONG);
  assert_non_null(s);
  assert_non_null(text);
  memset(text, 'a', LONG);
  assert_int_equal(run(s, "(let loop () (loop))", 0), VS_OUTCOME_MACHINE);
  for (int i = 0; i < 3; i++) assert_int_equal(vs_read_check(s, text, LONG).state, VS_READ_COMPLETE);
  free(text);
  vs_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_restarts_under_a_limit),
      cmocka_unit_test(test_reading_after_a_limit), cmocka_unit_test(test_refusals), cmocka_unit_test(test_stops),
      cmocka_unit_test(test_stops_refused), cmocka_unit_test(test_limit) };
  return cmocka_run_group_tests_name("embedding", tests, NULL, NULL);
}
