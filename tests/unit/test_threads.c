/* Owns the test that interpreters share nothing: several threads, each with its own, make at once what one makes alone, byte
 * for byte, while another thread interrupts one of them. `make tsan` runs it under the thread sanitizer. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "visualscheme.h"

enum { THREADS = 3, TURNS = 2 };

typedef struct {
  uint64_t sum;
  size_t bytes;
} print;
typedef struct {
  print of[32];
  vs_outcome outcome;
  size_t formats;
} result;

static const char model[] =
    "(define-parameter n 3 #:min 1 #:max 9)"
    "(define-syntax twice (syntax-rules () ((_ e) (begin e e))))"
    "(define h (make-hash)) (hash-set! h 'a (string->symbol (number->string n)))"
    "(define (tower i) (do-move (subtract (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1))"
    "  (make-cylinder (xyz 0 0 -2) 4 1/4)) (vxyz (* 3 i) 0 0)))"
    "(draw (unite (map tower (iota n))))"
    "(draw (with-material 'copper (make-torus (xyz 0 9 0) 2 1/2)))"
    "(draw (make-text (xyz 0 20 0) 1 \"aV\")) (draw (hull (make-sphere (xyz 0 30 0) 1) (make-box (xyz 3 30 0) 1 1 1)))"
    "(define-function (ball x y z) (- (+ (* x x) (* y y) (* z z)) 1))"
    "(draw (make-isosurface ball (xyz -2 -2 -2) (xyz 2 2 2)))"
    "(twice (display (volume (tower 0)))) (guard (e (#t (display e))) (car 5))";

static bool add(void *context, const void *bytes, size_t count) { /* FNV-1a */
  print *p = context;
  const unsigned char *b = bytes;
  for (size_t i = 0; i < count; i++) p->sum = (p->sum ^ b[i]) * 1099511628211u;
  p->bytes += count;
  return true;
}

static void *make(void *context) {
  result *r = context;
  vs_scheme *s = vs_new(NULL);
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  for (int turn = 0; s && turn < TURNS; turn++) {
    if (turn) vs_restart(s);
    memset(r->of, 0, sizeof r->of);
    r->outcome = vs_eval_text(s, "model", 1, model, sizeof model - 1, 0);
    r->formats = 0;
    for (size_t i = 0; i < count; i++)
      if (!formats[i].worker && vs_write_drawing_to(s, formats[i].name, NULL, add, &r->of[i]) == VS_OUTCOME_DONE)
        r->formats++;
  }
  vs_free(s);
  return NULL;
}

static void test_apart(void **state) {
  (void)state;
  pthread_t threads[THREADS];
  static result alone, together[THREADS];
  make(&alone);
  assert_int_equal(alone.outcome, VS_OUTCOME_DONE);
  assert_in_range(alone.formats, 8, 32);
  for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_create(&threads[i], NULL, make, &together[i]), 0);
  for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(threads[i], NULL), 0);
  for (int i = 0; i < THREADS; i++) assert_memory_equal(&together[i], &alone, sizeof alone);
}

static void *interrupt(void *s) {
  for (int i = 0; i < 1000; i++) vs_interrupt(s);
  return NULL;
}

static void test_interrupted(void **state) {
  (void)state;
  static const char endless[] = "(let loop () (loop))";
  pthread_t thread;
  vs_scheme *s = vs_new(NULL);
  assert_non_null(s);
  for (int i = 0; i < 5; i++) {
    assert_int_equal(pthread_create(&thread, NULL, interrupt, s), 0);
    assert_int_equal(vs_eval_text(s, "endless", 1, endless, sizeof endless - 1, 0), VS_OUTCOME_INTERRUPTED);
    assert_int_equal(pthread_join(thread, NULL), 0);
    vs_interrupt_clear(s);
  }
  vs_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_apart), cmocka_unit_test(test_interrupted) };
  return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
