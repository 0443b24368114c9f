/* Tests the reader and the expander from C: the place and wording of each error in a text, and whether a text is
 * complete. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "vm/library/port.h"
#include "vm/values/printer.h"
#include "vm/front/reader.h"
#include "vm/front/scan.h"
#include "vm/machine/program.h"
#include "vm/machine/open_vm.h"

static char *prelude;
static size_t prelude_size;

static vs_scheme *machine(void) {
  vs_config config = {0};
  vs_scheme *vm = vs_open_vm(&config);
  assert_non_null(vm);
  assert_true(vs_port_setup(vm) && vs_front_open(vm) && vs_library_load(vm, "prelude.scm", prelude, prelude_size));
  vs_library_done(vm);
  return vm;
}

static int load_prelude(void **state) {
  (void)state;
  FILE *f = fopen("prelude.scm", "rb");
  if (!f) return -1;
  prelude = malloc(1 << 20);
  prelude_size = prelude ? fread(prelude, 1, 1 << 20, f) : 0;
  fclose(f);
  return prelude_size ? 0 : -1;
}
static int drop_prelude(void **state) { (void)state; free(prelude); return 0; }

/* Writes the error with which a program ends, as "line:col message", then "; line:col message" for each further
 * error. */
static void run(vs_scheme *vm, const char *program, char *out, size_t room) {
  vs_value last;
  out[0] = 0;
  if (vs_program_text(vm, "p.vs", &(vs_passage){ program, strlen(program), 1 }, false, &last)) return;
  assert_true(vs_is(vm->condition, VS_T_CONDITION));
  vs_text t;
  vs_text_open(vm, &t, 0);
  assert_true(vs_print_condition(vm, vm->condition, &t) && vs_text_end(&t));
  vs_pos p = vs_as_condition(vm->condition)->place;
  size_t n = (size_t)snprintf(out, room, "%u:%u %s", vs_pos_line(p), vs_pos_col(p), t.at);
  for (vs_value l = vs_as_condition(vm->condition)->payload; vs_is_pair(l); l = vs_cdr(l)) {
    t.count = 0;
    p = vs_pos_of(vs_car(vs_car(l)));
    assert_true(vs_text_string(&t, vs_cdr(vs_car(l))) && vs_text_end(&t));
    n += (size_t)snprintf(out + n, room - n, "; %u:%u %s", vs_pos_line(p), vs_pos_col(p), t.at);
  }
  vs_text_close(&t);
}

static void test_messages(void **state) {
  (void)state;
  static const struct { const char *program, *message;
  } cases[] = {
    { "(define (f x)\n  (+ x 1)\n(define (g x)\n  x)\n",
      "1:1 this parenthesis is never closed; by the indentation a ) is missing at the end of line 2" },
    { "(display 1)\n(display 2))", "2:12 this ) closes nothing: one too many for the form of line 2" },
    { "(define (f)\n  (g))\n  (h))\n", "3:6 this ) closes nothing: the form of line 1 was already closed on line 2" },
    { "(list [1 2))", "1:11 the [ of line 1, column 7 is closed by ); ] belongs here" },
    { "(define x 1,5)", "1:11 a decimal point is a point: 1.5 instead of 1,5" },
    { "(display \xE2\x80\x9Chi\xE2\x80\x9D)",
      "1:10 \xE2\x80\x9C is a typographic quotation mark; write \"hi\"" },
    { "{1}",
      "1:1 { is not used here; parentheses are ( ) and [ ]; 1:3 } is not used here; parentheses are ( ) and [ ]" },
    { "#\\foo\n\"\\q\"\n(", "1:1 no character has the name #\\foo; 2:2 \\q means nothing in a string; a backslash is "
                            "written \\\\; 3:1 this parenthesis is never closed: a ) is missing" },
    { "(a\x01"
      "b\xFF)",
      "1:5 this is not a text in UTF-8 (byte FF at offset 4); the editor has saved it in an older encoding, as Latin-1: save "
      "it as UTF-8" },
    { "(define helper (phi) (+ phi 1))", "1:1 define: a procedure is written (define (helper phi) body ...), "
                                         "its name inside the parentheses of its parameters" },
    { "(define x 1 2)", "1:1 define: x gets 2 values; it is written (define x value)" },
    { "(let (x 1) x)", "1:6 put the bindings into parentheses of their own, even a single binding: (let ([x 1]) ...)" },
    { "(let ((x 1)))", "1:1 a body is missing: (let ((name value) ...) body ...)" },
    { "(let ((x 1) (x 2)) x)", "1:13 x is bound twice here" },
    { "(lambda (x x) 1)", "1:12 two parameters are called x; give one of them another name" },
    { "(define (f [n 10]) n)\n(f 5)",
      "1:12 a default follows a predicate, [name any? value] or [name positive? value], not (n 10)" },
    { "(define (f) (define x 1))",
      "1:1 this body ends with a definition; an expression must follow, whose value it has" },
    { "(if 1)", "1:1 if is written (if test then else), not (if 1)" },
    { "(cond (1 (define y 1)))",
      "1:7 this body ends with a definition; an expression must follow, whose value it has" },
    { "(case 1 ((1) (define y 1)))",
      "1:9 this body ends with a definition; an expression must follow, whose value it has" },
    { "(if 1 (define y 1) 2)", "1:7 define is not allowed here, only at top level or in the body of a procedure, let, "
                               "when, cond and the like; for a name inside an expression use let" },
    { "(cond (else 1) (2 3))", "1:7 else must be the last clause of cond" },
    { "(list else)", "1:7 else is syntax and has no value; it is written (cond ... (else value ...))" },
    { "(list . 5)", "1:1 a call is a list: remove the . in it: (list . 5)" },
    { "()", "1:1 () calls nothing; the empty list is written '()" },
    { "(displya 1)", "1:1 displya is not defined; did you mean display?" },
    { "(list\n 1\n (car 2))", "3:2 car: expected a pair, got 2" },
    { "(define-syntax m (syntax-rules () ((_ a ...) a)))\n(m 1)",
      "1:46 a matches a sequence: an ellipsis must follow it in the template" },
    { "(define-syntax m (syntax-rules () ((_ a) a)))\n(m)",
      "2:1 m: this does not have the right form; the pattern and the use: (m a) (m)" },
    { "(define-syntax m (syntax-rules () ((_ a) (car a))))\n(list (m 5))", "2:7 car: expected a pair, got 5" },
    { "(define-syntax m 5)", "1:1 a transformer is (syntax-rules ...) or (er-macro-transformer ...), not 5" },
    { "(import (no such))", "1:9 import: there is no library (no such); sqrt, sin, pi, xyz and the rest need no import" },
    { "(f #:a)", "1:4 a value is missing after #:a" },
    { "(define (f [n string?]) n)\n(f 5)", "2:1 f: n must be string?, got 5" },
  };
  vs_scheme *vm = machine();
  char out[1000];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    run(vm, cases[i].program, out, sizeof out);
    if (strcmp(out, cases[i].message))
      print_error("%s\n  gave   %s\n  wanted %s\n", cases[i].program, out, cases[i].message);
    assert_string_equal(out, cases[i].message);
  }
  vs_close_vm(vm);
}

static void test_whole(void **state) {
  (void)state;
  static const struct { const char *text; vs_text_state state; uint32_t depth;
  } cases[] = {
    { "", VS_TEXT_EMPTY, 0 },
    { "  ; only a comment\n#| and | this |# ", VS_TEXT_EMPTY, 0 },
    { "x", VS_TEXT_WHOLE, 0 },
    { "(a b) (c)", VS_TEXT_WHOLE, 0 },
    { "(a (b [c", VS_TEXT_OPEN, 3 },
    { "\"a (b", VS_TEXT_OPEN, 0 },
    { "(a \"\\\"\" #\\( ", VS_TEXT_OPEN, 1 },
    { "#| a #| b |#", VS_TEXT_OPEN, 0 },
    { "(a ]", VS_TEXT_BAD, 0 },
    { "a)", VS_TEXT_BAD, 0 },
    { "#;", VS_TEXT_OPEN, 0 },
    { "#;(a) b", VS_TEXT_WHOLE, 0 },
    { "#u8(1", VS_TEXT_OPEN, 1 },
    { "'(a)", VS_TEXT_WHOLE, 0 },
    { "|a (b", VS_TEXT_OPEN, 0 },
    { "(a ; )\n", VS_TEXT_OPEN, 1 },
  };
  vs_scheme *vm = machine();
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    vs_text_check c;
    assert_true(vs_read_whole(vm, cases[i].text, strlen(cases[i].text), &c));
    if (c.state != cases[i].state || c.depth != cases[i].depth)
      print_error("%s: state %d depth %u\n", cases[i].text, (int)c.state, c.depth);
    assert_int_equal(c.state, cases[i].state);
    assert_int_equal(c.depth, cases[i].depth);
  }
  vs_close_vm(vm);
}

/* Tests the recorded places of pairs and atoms, and nesting far deeper than the C stack allows. */
static void check_places(vs_scheme *vm) {
  VS_ROOTS(vm, r, 2);
  const char *text = "\n (a \xC3\xA4 (b\n  c))";
  uint32_t file;
  assert_true(vs_file_number(vm, "p.vs", 4, &file) &&
              vs_read_all(vm, &(vs_passage){ text, strlen(text), 1 }, file, false, &r[0]));
  vs_value form = vs_car(r[0]);
  assert_true(vs_pair_pos(form) == vs_pos_make(file, 2, 2));
  /* columns count characters, not bytes */
  assert_true(vs_pair_pos(vs_cdr(vs_cdr(form))) == vs_pos_make(file, 2, 7));
  assert_true(vs_pair_pos(vs_cdr(vs_car(vs_cdr(vs_cdr(form))))) == vs_pos_make(file, 3, 3));
  enum { DEPTH = 300000 };
  char *deep = malloc(2 * DEPTH + 16);
  assert_non_null(deep);
  memset(deep, '(', DEPTH);
  memset(deep + DEPTH, ')', DEPTH);
  assert_true(vs_read_all(vm, &(vs_passage){ deep, 2 * DEPTH, 1 }, file, false, &r[0]));
  size_t depth = 0;
  for (vs_value v = vs_car(r[0]); vs_is_pair(v); v = vs_car(v)) depth++;
  assert_int_equal(depth, DEPTH - 1);
  free(deep);
}

static void test_places(void **state) {
  (void)state;
  vs_scheme *vm = machine();
  check_places(vm);
  vs_close_vm(vm);
}

/* Refuses every allocation of reading and expanding in turn. The result must be an error, no memory may be lost, and
 * the interpreter must work afterwards. */
static void test_no_memory(void **state) {
  (void)state;
  const char *program = "(define-syntax m (syntax-rules () ((_ (a b ...) ...) (list (list a b ...) ...))))"
                        "(define (f [x any? 1] #:k [k (and integer? positive?) 2]) (let loop ((i x)) (if (< i 3) (loop "
                        "(+ i 1)) (m (i k) (1)))))"
                        "(define-record-type p (mk a) p? (a p-a set-p-a!)) (f 1 #:k 5) `(1 ,@(list 2 3) #(,(f)))";
  vs_scheme *vm = machine();
  vs_value last;
  for (size_t n = 1; n < 100000; n += n < 200 ? 1 : 7) {
    vs_gc_fail_after(vm, n);
    bool ok = vs_program_text(vm, "p.vs", &(vs_passage){ program, strlen(program), 1 }, false, &last);
    vs_gc_fail_after(vm, 0);
    if (ok) break;
  }
  assert_true(vs_program_text(vm, "p.vs", &(vs_passage){ program, strlen(program), 1 }, false, &last));
  vs_close_vm(vm);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_messages), cmocka_unit_test(test_whole),
                                      cmocka_unit_test(test_places), cmocka_unit_test(test_no_memory) };
  return cmocka_run_group_tests(tests, load_prelude, drop_prelude);
}
