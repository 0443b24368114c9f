/* Tests the core of the virtual machine: the garbage collector, compiler and run loop on texts, limits, and a failure
 * of each allocation. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <cmocka.h>

#include "vm/compiler/compile.h"
#include "vm/values/printer.h"
#include "vm/machine/run.h"
#include "vm/machine/program.h"
#include "vm/machine/open_vm.h"

static vs_scheme *open_with(vs_config config) {
  vs_scheme *vm = vs_open_vm(&config);
  assert_non_null(vm);
  assert_true(vs_front_open(vm));
  vs_library_done(vm);
  assert_true(vs_program_new(vm, &vm->at.program));
  return vm;
}

static vs_scheme *open_plain(void) { return open_with((vs_config){0}); }

/* evaluates a text; returns its value as written, or "error: " and the message */
static const char *run(vs_scheme *vm, const char *text) {
  static char out[4096];
  vs_value v = VS_FALSE;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_program_text(vm, "test", &(vs_passage){ text, strlen(text), 1 }, false, &v);
  if (!ok) vs_text_puts(&t, "error: ");
  assert_true((ok ? vs_print(vm, v, VS_PRINT_WRITE, &t) : vs_print_condition(vm, vm->condition, &t)) &&
              vs_text_end(&t));
  snprintf(out, sizeof out, "%s", t.at);
  vs_text_close(&t);
  return out;
}

/* ---- the heap ---- */
static void objects_survive_and_move(void **state) {
  (void)state;
  vs_scheme *vm = open_plain();
  {
    VS_ROOTS(vm, r, 3);
    r[0] = VS_NIL;
    /* allocates more than the nursery (the heap of young objects) contains */
    for (int i = 0; i < 100000; i++) assert_true(vs_cons(vm, vs_fix(i), r[0], &r[0]));
    assert_true(vm->collections > 0);
    int64_t i = 100000;
    for (vs_value l = r[0]; l != VS_NIL; l = vs_cdr(l)) assert_int_equal(vs_fixnum(vs_car(l)), --i);
    assert_int_equal(i, 0);
    /* stores a young object in an old vector */
    assert_true(vs_make_vector(vm, 10, VS_FALSE, &r[1]));
    vs_gc_major(vm);
    vs_value pair;
    assert_true(vs_cons(vm, vs_fix(7), VS_NIL, &pair));
    vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[3], pair);
    vs_gc_minor(vm);
    assert_true(vs_is_pair(vs_as_vector(r[1])->at[3]));
    assert_int_equal(vs_fixnum(vs_car(vs_as_vector(r[1])->at[3])), 7);
    assert_true(vs_gc_check(vm));
    size_t before = vm->bytes;
    r[0] = VS_NIL;
    assert_true(vs_make_vector(vm, 1000000, VS_NIL, &r[2]));
    r[2] = VS_NIL;
    vs_gc_major(vm);
    assert_true(vm->bytes <= before + (2u << 20));      /* the large vector's memory is no longer in use */
    assert_true(vs_gc_check(vm));
  }
  vs_close_vm(vm);
}

static int released;
static void release(void *object) { (void)object; released++; }
static const vs_foreign_type thing = {.name = "a thing", .release = release};

static void foreign_objects_are_released_once(void **state) {
  (void)state;
  vs_scheme *vm = open_plain();
  released = 0;
  static char object;
  {
    VS_ROOTS(vm, r, 1);
    for (int i = 0; i < 1000; i++) assert_true(vs_make_foreign(vm, &thing, &object, 1 << 20, &r[0]));
    assert_true(released > 900);                        /* the objects were freed: the bytes that foreign objects report
                                                         * count as memory, and thus cause collections */
    int soon = released;
    vs_gc_major(vm);
    assert_int_equal(released, 999);
    assert_true(soon <= 999);
    assert_ptr_equal(vs_foreign_get(r[0], &thing), &object);
  }
  vs_close_vm(vm);
  assert_int_equal(released, 1000);
}

static size_t held, most;
static void *counting(void *user, void *p, size_t old_bytes, size_t bytes) {
  (void)user;
  held += bytes - old_bytes;
  if (held > most) most = held;
  if (!bytes) { free(p); return NULL; }
  return realloc(p, bytes);
}

static void all_memory_goes_through_the_callback(void **state) {
  (void)state;
  held = most = 0;
  vs_scheme *vm = open_with((vs_config){.memory = counting});
  assert_string_equal(run(vm, "(define (f n) (if (= n 0) '() (cons n (f (- n 1))))) (length (f 100000))"), "100000");
  vs_close_vm(vm);
  assert_int_equal(held, 0);
}

/* ---- programs ---- */
struct example { const char *text, *value; };
static const struct example examples[] = {
  { "(define (fib n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2))))) (fib 20)", "6765" },
  { "(let loop ((i 0) (s 0)) (if (= i 1000) s (loop (+ i 1) (+ s i))))", "499500" },
  { "(let outer ((i 0) (s 0)) (if (= i 10) s (let inner ((j 0) (s s)) (if (= j 10) (outer (+ i 1) s) (inner (+ j 1) (+ "
    "s 1))))))",
    "100" },
  { "(define fs '()) (do ((i 0 (+ i 1))) ((= i 3)) (set! fs (cons (lambda () (set! i (+ i 10)) i) fs))) (list ((car "
    "fs)) ((cadr fs)) ((car fs)))",
    "(12 11 22)" },
  { "(let loop ((a 1) (b 2) (n 3)) (if (= n 0) (list a b) (loop b a (- n 1))))", "(2 1)" },
  { "(define (f a) (define (ev n) (if (= n 0) a (od (- n 1)))) (define (od n) (if (= n 0) #f (ev (- n 1)))) (ev 10)) "
    "(f 'yes)",
    "yes" },
  { "(letrec ((a (lambda () b)) (b 2)) (a))", "2" },
  { "(letrec ((a b) (b 2)) a)", "error: b is used before it has a value" },
  { "(define (f) (g)) (define (g) (car 5)) (f)", "error: car: expected a pair, got 5" },
  { "((lambda (x #:k [y any? 2]) (list x y)) 1)", "(1 2)" },
  { "(define (f x #:k [y any? 2] . r) (list x y r)) (f 1 2 #:k 3)", "(1 3 (2))" },
  { "(define (f x) x) (f 1 2)", "error: f needs 1 argument (x), got 2" },
  { "(define (f x) x) (f #:y 2)", "error: f has no keyword #:y" },
  { "(define (f x) x) (f 1 #:y 2)", "error: f has no keyword #:y" },
  { "(define (f x #:turn t #:size [s any? 1]) x) (f 1 #:sise 2)",
    "error: f has no keyword #:sise; it has #:turn #:size" },
  { "(5 5)", "error: a number cannot be called (a list is written (list 1 2 3), a point (xyz 1 2 3), a gvector (vxyz 1 "
             "2 3)): 5" },
  { "(define k #f) (define n 0) (define l '()) (let ((v (call/cc (lambda (c) (set! k c) 0)))) (set! l (cons v l)) "
    "(set! n (+ n 1)) (if (< n 3) (k n) l))",
    "(2 1 0)" },
  { "(define (deep n) (if (= n 0) 0 (+ 1 (deep (- n 1))))) (deep 1000000)", "1000000" },
  { "(define (deep n) (if (= n 0) (call/cc (lambda (k) k)) (let ((v (deep (- n 1)))) v))) (define k (deep 30000)) (if "
    "(procedure? k) (k 5) k)",
    "5" },
  { "(with-exception-handler (lambda (e) 10) (lambda () (+ 1 (raise-continuable 'c))))", "11" },
  { "(raise 'boom)", "error: an object was raised and has no handler: boom" },
  { "(define x 1) (define (get) (+ x 1)) (get) (define (+ a b) (list a b)) (get)", "(1 1)" },
  { "(define (f x) (if (null? x) 'empty (car x))) (f '(1)) (define (null? x) #t) (f '(1))", "empty" },
  { "(define (f x) (if (< x 5) 'less 'more)) (f 1) (define < >) (f 1)", "more" },
  { "(define (f a b c) (+ a b c)) (f 1 2 3) (define (+ . l) l) (f 1 2 3)", "(1 2 3)" },
  { "(define (f [n number?]) n) (f 'x)", "error: f: n must be number?, got x" },
  { "(define (odd-one? x) (car x)) (define (f [n odd-one?]) n) (f 3)", "error: f: n must be odd-one?, got 3" },
  { "(define p (make-parameter 1 (lambda (x) (* x 2)))) (p)", "2" },
  { "(let ((path '())) (dynamic-wind (lambda () (set! path (cons 'in path))) (lambda () 0) (lambda () (set! path (cons "
    "'out path)))) path)",
    "(out in)" },
  { "(call-with-values (lambda () (values 1 2 3)) list)", "(1 2 3)" },
  { "(apply + (iota 100000))", "4999950000" },
  { "(define (count . l) (length l)) (apply count (iota 100000))", "100000" },
};

static void programs(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
    vs_scheme *vm = open_plain();
    assert_string_equal(run(vm, examples[i].text), examples[i].value);
    vs_close_vm(vm);
  }
}

/* Tests procedures with more variables, and calls with more arguments, than fit the operand of an instruction. */
static void wide_frames(void **state) {
  (void)state;
  vs_scheme *vm = open_plain();
  vs_text t;
  vs_text_open(vm, &t, 0);
  char piece[64];
  vs_text_puts(&t, "(define (f x) (let* (");
  for (int i = 0; i < 400; i++) {
    if (i == 0) vs_text_puts(&t, "(v0 x)");
    else { snprintf(piece, sizeof piece, "(v%d (+ v%d 1))", i, i - 1); vs_text_puts(&t, piece); }
  }
  vs_text_puts(&t, ") (let loop ((i 0) (s 0)) (if (< i 3) (loop (+ i 1) (+ s v399 v300)) (list s (if (null? v399) 1 "
                   "(lambda () v398)) (car (cons v397 v0))");
  vs_text_puts(&t, ")))))(define r (f 1)) (list (car r) ((cadr r)) (caddr r) (length (list");
  for (int i = 0; i < 400; i++) vs_text_puts(&t, " 1");
  vs_text_puts(&t, ")))");
  assert_true(vs_text_end(&t));
  assert_string_equal(run(vm, t.at), "(2103 399 398 400)");
  vs_text_close(&t);
  vs_close_vm(vm);
}

static void an_error_does_not_end_it(void **state) {
  (void)state;
  vs_scheme *vm = open_plain();
  assert_string_equal(run(vm, "(define x 5) (dynamic-wind (lambda () 0) (lambda () (with-exception-handler (lambda (e) "
                              "(car e)) (lambda () (car x)))) (lambda () 0))"),
                      "error: car: expected a pair, got #<error \"car: expected a pair, got\" (5)>");
  assert_string_equal(run(vm, "x"), "5");
  vs_close_vm(vm);
}

/* ---- limits ---- */
static bool always(void *user) { (void)user; return true; }

static void limits_stop_programs(void **state) {
  (void)state;
  vs_scheme *vm = open_with((vs_config){.step_limit = 100000});
  assert_string_equal(run(vm, "(let loop () (loop))"), "error: stopped after 100000 steps, the limit");
  vs_close_vm(vm);
  vm = open_with((vs_config){.step_limit = 100000});
  assert_string_equal(
      run(vm,
          "(call/cc (lambda (k) (with-exception-handler (lambda (e) (k 'caught)) (lambda () (let loop () (loop))))))"),
      "error: stopped after 100000 steps, the limit");
  vs_close_vm(vm);
  vm = open_with((vs_config){.memory_limit = 32u << 20});
  assert_string_equal(run(vm, "(let loop ((l '())) (loop (cons 1 l)))"), "error: out of memory");
  assert_string_equal(run(vm, "(define (deep) (+ 1 (deep))) (deep)"),
                      "error: deep calls itself here, 468 thousand calls deep; is there an `if` that stops it? "
                      "--limit-stack allows deeper calls");
  assert_string_equal(run(vm, "(make-vector 100000000 0)"), "error: out of memory");
  assert_string_equal(run(vm, "(+ 1 2)"), "3");
  vs_close_vm(vm);
  vm = open_with((vs_config){.interrupted = always});
  assert_string_equal(run(vm, "(define (f) (f)) (f)"), "error: interrupted");
  vs_close_vm(vm);
}

/* Refuses each allocation of a task in turn. Each time the result must be an error, and the interpreter must work
 * afterwards. */
static void each_allocation_fails(void **state) {
  (void)state;
  static const char task[] =
      "(define (deep n) (if (= n 0) 0 (+ 1 (deep (- n 1))))) (deep 9000)"
      "(define k #f) (define n 0) (let ((v (call/cc (lambda (c) (set! k c) 0)))) (set! n (+ n 1)) (if (< n 3) (k n) n))"
      "(define-syntax swap! (syntax-rules () ((_ a b) (let ((t a)) (set! a b) (set! b t))))) (define x 1) (define y 2) "
      "(swap! x y)"
      "(define (f a #:k [b any? 3] . r) (list a b r)) (f 1 2 #:k 5) (define (p? x) (car x)) (define (g [a p?]) a)"
      "(call/cc (lambda (k) (with-exception-handler (lambda (e) (k e)) (lambda () (g 1)))))"
      "(dynamic-wind (lambda () 0) (lambda () (expt 3 500)) (lambda () 0)) (apply list (iota 100))";
  vs_scheme *vm = open_plain();
  size_t failures = 0;
  for (size_t i = 1;; i += 1 + i / 40) {
    vs_value v;
    assert_true(vs_program_new(vm, &vm->at.program));
    vs_gc_fail_after(vm, i);
    bool ok = vs_program_text(vm, "test", &(vs_passage){ task, sizeof task - 1, 1 }, false, &v);
    bool reached = vm->fail_after == 0;
    vs_gc_fail_after(vm, 0);
    if (!reached) { assert_true(ok); break; }
    failures += !ok;
  }
  assert_true(failures > 50);
  assert_true(vs_gc_check(vm));
  assert_string_equal(run(vm, "(+ 1 2)"), "3");
  vs_close_vm(vm);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(objects_survive_and_move),
    cmocka_unit_test(foreign_objects_are_released_once),
    cmocka_unit_test(all_memory_goes_through_the_callback),
    cmocka_unit_test(programs),
    cmocka_unit_test(wide_frames),
    cmocka_unit_test(an_error_does_not_end_it),
    cmocka_unit_test(limits_stop_programs),
    cmocka_unit_test(each_allocation_fails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
