/* Tests the library's C procedures. Each row of the tables contains an expression of nested calls, and the text that it
 * prints, or its error. A small evaluator in this file replaces the compiler, so that these tests need only reader, C
 * procedures and printer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#include "vm/numbers/number_text.h"
#include "vm/values/printer.h"
#include "vm/front/reader.h"
#include "vm/machine/run.h"
#include "vm/machine/open_vm.h"
#include "vm/values/table.h"
#include "vm/values/equal.h"

#define VS_NATIVES(name) extern const vs_native_table vs_##name##_natives;
#include "vm/machine/natives.def"
#undef VS_NATIVES

static vs_value names, input;        /* names: table from name to procedure. input: datum that is being evaluated */

static bool define(vs_scheme *vm, void *table, vs_value symbol, vs_value procedure) { return vs_table_put(vm, *(vs_value *)table, symbol, procedure); }

/* Evaluates a form. The recursion is only as deep as the nesting of the rows in this file. */
static bool eval(vs_scheme *vm, vs_value form, vs_value *out) {
  if (vs_is_symbol(form)) return vs_table_get(vm, names, form, out);
  if (!vs_is_pair(form)) return *out = form, true;
  VS_ROOTS(vm, r, 12);
  r[0] = form;
  if (vs_car(form) == vm->sym.quote) return *out = vs_car(vs_cdr(form)), true;
  if (!vs_table_get(vm, names, vs_car(form), &r[1])) return false;
  if (!vs_is_procedure(r[1])) fail_msg("%s is not defined", vs_as_symbol(vs_car(r[0]))->name);
  size_t n = 0;
  for (r[0] = vs_cdr(form); vs_is_pair(r[0]); r[0] = vs_cdr(r[0]), n++)
    if (!eval(vm, vs_car(r[0]), &r[2 + n])) return false;
  return vs_run(vm, r[1], n, &r[2], out);
}

typedef struct { const char *expression, *result; } row;

static void check(vs_scheme *vm, const row *rows) {
  int wrong = 0;
  for (const row *p = rows; p->expression; p++) {
    VS_ROOTS(vm, r, 1);
    vs_text t;
    size_t used;
    vs_text_open(vm, &t, 0);
    bool ok = vs_read_datum(vm, p->expression, strlen(p->expression), &input, &used) && eval(vm, input, &r[0]);
    assert_true(ok ? vs_print(vm, r[0], VS_PRINT_WRITE, &t) : vs_text_puts(&t, "error: ") && vs_print_condition(vm, vm->condition, &t));
    assert_true(vs_text_end(&t));
    if (strcmp(t.at, p->result)) {
      print_error("%s\n  gives  %s\n  wanted %s\n", p->expression, t.at, p->result);
      wrong++;
    }
    vs_text_close(&t);
  }
  assert_int_equal(wrong, 0);
}

static void with_vm(void (*test)(vs_scheme *vm)) {
  vs_config config = {.memory_limit = 512u << 20};
  vs_scheme *vm = vs_open_vm(&config);
  assert_non_null(vm);
  struct vs_roots link = {NULL, vm, &names, 1}, link2 = {NULL, vm, &input, 1};
  vs_gc_link(&link);
  vs_gc_link(&link2);
  assert_true(vs_make_table(vm, VS_TABLE_EQ, &names));
#define VS_NATIVES(name) assert_true(vs_native_define(vm, &vs_##name##_natives, define, &names));
#include "vm/machine/natives.def"
#undef VS_NATIVES
  test(vm);
  vs_gc_unlink(&link2);
  vs_gc_unlink(&link);
  vs_close_vm(vm);
}

/* ---- the types of numbers ---- */

static const row numbers[] = {
    {"(+ 1 2)", "3"},
    {"(+)", "0"},
    {"(+ 140737488355327 1)", "140737488355328"},
    {"(- -140737488355328 1)", "-140737488355329"},
    {"(fixnum? (- 140737488355328 1))", "#t"},
    {"(fixnum? (+ 140737488355327 1))", "#f"},
    {"(- -140737488355328)", "140737488355328"},
    {"(quotient -140737488355328 -1)", "140737488355328"},
    {"(* 99999999999 99999999999)", "9999999999800000000001"},
    {"(* -99999999999999999999 99999999999999999999)", "-9999999999999999999800000000000000000001"},
    {"(quotient 9999999999999999999800000000000000000001 99999999999999999999)", "99999999999999999999"},
    {"(quotient -7 2)", "-3"},
    {"(remainder -7 2)", "-1"},
    {"(modulo -7 2)", "1"},
    {"(modulo 7 -2)", "-1"},
    {"(modulo -7.0 2)", "1.0"},
    {"(modulo -100000000000000000000 7)", "5"},
    {"(floor-quotient -7 2)", "-4"},
    {"(/ 7 2)", "7/2"},
    {"(/ 6 -4)", "-3/2"},
    {"(/ 6 3)", "2"},
    {"(/ 0.0 0)", "error: /: division by zero"},
    {"(/ 1 0)", "error: /: division by zero"},
    {"(/ 1 0.0)", "+inf.0"},
    {"(modulo 5 0)", "error: modulo: division by zero"},
    {"(+ 1/3 2/3)", "1"},
    {"(* 2/3 3/4)", "1/2"},
    {"(- 1/2 1/3 1/6)", "0"},
    {"(+ 1/2 0.5)", "1.0"},
    {"(- 0.0)", "-0.0"},
    {"(* 0 1.5)", "0"},
    {"(+ 1 \"x\")", "error: +: expected a number, got \"x\""},
    {"(< 1 'a)", "error: <: expected a number, got a"},
    {"(expt 2 100)", "1267650600228229401496703205376"},
    {"(expt 2/3 5)", "32/243"},
    {"(expt 2 -2)", "1/4"},
    {"(expt 2.0 3)", "8.0"},
    {"(expt 0 0)", "1"},
    {"(expt 0 -1)", "error: expt: 0 has no negative power"},
    {"(expt 4 1/2)", "2"},
    {"(expt 8/27 2/3)", "4/9"},
    {"(expt 2 0.5)", "1.4142135623730951"},
    {"(expt -8 1/3)", "error: expt: base must be not negative with a power that is no integer, got -8"},
    {"(exact->inexact (/ (expt 10 400) (+ (expt 10 399) 1)))", "10.0"},
    {"(exact->inexact (expt 10 400))", "+inf.0"},
    {"(exact->inexact 1/3)", "0.3333333333333333"},
    {"(exact->inexact (/ 1 (expt 10 320)))", "1e-320"},
    {"(exact->inexact 9007199254740993)", "9007199254740992.0"},
    {"(exact->inexact 9007199254740995)", "9007199254740996.0"},
    {"(exact 0.1)", "3602879701896397/36028797018963968"},
    {"(exact 1e20)", "100000000000000000000"},
    {"(= (exact 5e-324) (/ 1 (expt 2 1074)))", "#t"},
    {"(exact +nan.0)", "error: exact: expected a finite number, got +nan.0"},
    {"(= 1/3 0.3333333333333333)", "#f"},
    {"(< 9007199254740992.0 9007199254740993)", "#t"},
    {"(= 100000000000000000000 1e20)", "#t"},
    {"(< 1 2 3 2)", "#f"},
    {"(< 1 +nan.0)", "#f"},
    {"(> 1/2 1/3)", "#t"},
    {"(< -1/2 -100000000000000000000)", "#f"},
    {"(sqrt 16)", "4"},
    {"(sqrt 1/4)", "1/2"},
    {"(sqrt 2)", "1.4142135623730951"},
    {"(sqrt -4)", "error: sqrt: expected a number that is not negative, got -4"},
    {"(= (sqrt (expt 10 400)) (expt 10 200))", "#t"},
    {"(sqrt (* 2 (expt 10 400)))", "1.414213562373095e200"},
    {"(sqrt (/ 2 (expt 10 400)))", "1.414213562373095e-200"},
    {"(exact-integer-sqrt 17)", "4 1"},
    {"(asin 2)", "error: asin: x must be a number from -1 to 1, got 2"},
    {"(log -1)", "error: log: x must be positive, got -1"},
    {"(log (expt 10 1000))", "2302.5850929940457"},
    {"(log 8 2)", "3.0"},
    {"(exp 0)", "1"},
    {"(atan 1 -1)", "2.356194490192345"},
    {"(gcd 12 -18)", "6"},
    {"(gcd)", "0"},
    {"(gcd 123456789012345678901234567890 987654321098765432109876543210)", "9000000000900000000090"},
    {"(gcd (expt 2 200) (* 3 (expt 2 130)))", "1361129467683753853853498429727072845824"},
    {"(lcm 4 6)", "12"},
    {"(lcm 32.0 -36)", "288.0"},
    {"(numerator 6/4)", "3"},
    {"(denominator 0.5)", "2.0"},
    {"(floor -7/2)", "-4"},
    {"(ceiling -7/2)", "-3"},
    {"(round 7/2)", "4"},
    {"(round 5/2)", "2"},
    {"(round -5/2)", "-2"},
    {"(round -7/2)", "-4"},
    {"(round 8/3)", "3"},
    {"(round 2.5)", "2.0"},
    {"(truncate -1.5)", "-1.0"},
    {"(exact-round 2.6)", "3"},
    {"(max 1 2.0)", "2.0"},
    {"(max 3 2.0)", "3.0"},
    {"(min 1/2 1/3)", "1/3"},
    {"(abs -140737488355328)", "140737488355328"},
    {"(even? 100000000000000000000)", "#t"},
    {"(odd? 1.5)", "error: odd?: n must be an integer, got 1.5"},
    {"(bitwise-and -1 255)", "255"},
    {"(bitwise-and (- (expt 2 100)) (- (expt 2 101) 1))", "1267650600228229401496703205376"},
    {"(bitwise-xor -1 (expt 2 80))", "-1208925819614629174706177"},
    {"(bitwise-not 5)", "-6"},
    {"(arithmetic-shift 1 100)", "1267650600228229401496703205376"},
    {"(arithmetic-shift -5 -1)", "-3"},
    {"(arithmetic-shift (- (expt 2 100)) -100)", "-1"},
    {"(arithmetic-shift (- -1 (expt 2 100)) -100)", "-2"},
    {"(integer-length -8)", "3"},
    {"(expt 10 100000000)", "error: expt: the number would have more than 40 million digits"},
    {NULL, NULL},
};

/* ---- texts of numbers ---- */

static const row texts[] = {
    {"(number->string 0.1)", "\"0.1\""},
    {"(number->string 100.0)", "\"100.0\""},
    {"(number->string 123456789012345680000.0)", "\"123456789012345680000.0\""},
    {"(number->string 1e21)", "\"1e21\""},
    {"(number->string 1e22)", "\"1e22\""},
    {"(number->string 1e-7)", "\"1e-7\""},
    {"(number->string 0.000001)", "\"0.000001\""},
    {"(number->string 5e-324)", "\"5e-324\""},
    {"(number->string 1.7976931348623157e308)", "\"1.7976931348623157e308\""},
    {"(number->string 2.2250738585072014e-308)", "\"2.2250738585072014e-308\""},
    {"(number->string 2.2250738585072011e-308)", "\"2.225073858507201e-308\""},
    {"(number->string 9007199254740993.0)", "\"9007199254740992.0\""},
    {"(number->string 9.5367431640625e-7)", "\"9.5367431640625e-7\""},
    {"(number->string 5.684341886080802e-14)", "\"5.684341886080802e-14\""},
    {"(number->string 0.3)", "\"0.3\""},
    {"(number->string (+ 0.1 0.2))", "\"0.30000000000000004\""},
    {"(number->string 255 16)", "\"ff\""},
    {"(number->string -1/3 2)", "\"-1/11\""},
    {"(number->string 0.1 2)", "\"0.0001100110011001100110011001100110011001100110011001101\""},
    {"(string->number (number->string 0.1 2) 2)", "0.1"},
    {"(string->number (number->string 1e-300 3) 3)", "1e-300"},
    {"(string->number (number->string 1.7976931348623157e308 36) 36)", "1.7976931348623157e308"},
    {"(string->number \"1e400\")", "+inf.0"},
    {"(string->number \"1e-400\")", "0.0"},
    {"(string->number \"-1e-400\")", "-0.0"},
    {"(string->number \"2.4703282292062327e-324\")", "0.0"},
    {"(string->number \"2.4703282292062328e-324\")", "5e-324"},
    {"(string->number \"9007199254740993\")", "9007199254740993"},
    {"(string->number \"9007199254740993.0\")", "9007199254740992.0"},
    {"(string->number \"9007199254740993.00000000000000000000000000000000000000001\")", "9007199254740994.0"},
    {"(string->number \"0.500000000000000166533453693773481063544750213623046875\")", "0.5000000000000002"},
    {"(string->number \"1.7976931348623158e308\")", "1.7976931348623157e308"},
    {"(string->number \"1.7976931348623159e308\")", "+inf.0"},
    {"(string->number \"#xFF\")", "255"},
    {"(string->number \"#b-101/11\")", "-5/3"},
    {"(string->number \"#e1.5\")", "3/2"},
    {"(string->number \"#e1e3\")", "1000"},
    {"(string->number \"#i1/3\")", "0.3333333333333333"},
    {"(string->number \"#x#e10\")", "16"},
    {"(string->number \"15##\")", "#f"},
    {"(string->number \"1#.#\")", "#f"},
    {"(string->number \"+.5\")", "0.5"},
    {"(string->number \"-5.\")", "-5.0"},
    {"(string->number \"1/0\")", "#f"},
    {"(string->number \"1/2/3\")", "#f"},
    {"(string->number \"1.2.3\")", "#f"},
    {"(string->number \"2pi\")", "#f"},
    {"(string->number \"1+\")", "#f"},
    {"(string->number \"+\")", "#f"},
    {"(string->number \".\")", "#f"},
    {"(string->number \"e5\")", "#f"},
    {"(string->number \"1e\")", "#f"},
    {"(string->number \"\")", "#f"},
    {"(string->number \"#\")", "#f"},
    {"(string->number \"-inf.0\")", "-inf.0"},
    {"(string->number \"abc\" 16)", "2748"},
    {"(string->number \"99999999999999999999999999999\")", "99999999999999999999999999999"},
    {NULL, NULL},
};

/* ---- the printer, equality, tables, format ---- */

static const row objects[] = {
    {"(%map-each abs '(1 -2 3))", "(1 2 3)"},
    {"(%map-each abs '())", "()"},
    {"(list (%each? abs '(1)) (%each? 'abs '(1)) (%each? abs '(1 . 2)))", "(#t #f #f)"},
    {"(equal? (%do-each abs '(1 -2)) (%do-each abs '()))", "#t"},
    {"(list 1 \"a\\nb\" #\\a #\\space 'x '|a b| '|1| '1+ '|| (string->symbol \"A\"))", "(1 \"a\\nb\" #\\a #\\space x |a b| |1| 1+ || A)"},
    {"''a", "'a"},
    {"'(1 quote a b)", "(1 quote a b)"},
    {"'(1 . (2 . (3 . 4)))", "(1 2 3 . 4)"},
    {"(vector 1 '() #t #f)", "#(1 () #t #f)"},
    {"(bytevector 1 255)", "#u8(1 255)"},
    {"(void)", "#<void>"},
    {"(list car)", "(#<procedure car>)"},
    {"(box 1)", "#&1"},
    {"(hash 'a 1 \"b\" 2)", "#hash((a . 1) (\"b\" . 2))"},
    {"(%record (%make-record-type 'point '(x y)) 1 2)", "#<point x=1 y=2>"},
    {"(equal? '(1 #(2 \"x\") 3.0) '(1 #(2 \"x\") 3.0))", "#t"},
    {"(equal? '(1 2) '(1 2 3))", "#f"},
    {"(equal? 1 1.0)", "#f"},
    {"(eqv? (expt 2 100) (expt 2 100))", "#t"},
    {"(eqv? 0.0 -0.0)", "#f"},
    {"(eqv? +nan.0 +nan.0)", "#t"},
    {"(hash->list (make-hash '((a . 1) (b . 2) (a . 3))))", "((a . 3) (b . 2))"},
    {"(%hash-get (hash '(1 2) 'x) '(1 2) #f)", "x"},
    {"(%hash-get (hash 1/2 'x (expt 2 70) 'y) (expt 2 70) #f)", "y"},
    {"(hash-set! 5 1 2)", "error: hash-set!: table must be a hash table, got 5"},
    {"(format \"~a and ~s~n~%~~ ~x\" \"a\" \"b\" 255)", "\"a and \\\"b\\\"\\n\\n~ ff\""},
    {"(format \"~a\")", "error: format: the format has more directives than there are values (0)"},
    {"(format \"a\" 1)", "error: format: the format uses 0 of the 1 values"},
    {"(error \"no good:\" 1 \"x\")", "error: no good: 1 \"x\""},
    {"(error 'tower \"~a floors\" 3)", "error: tower: 3 floors"},
    {"(string-ref \"abc\" 3)", "error: string-ref: index must be from 0 to 2, got 3"},
    {"(read-line (open-input-string \"ab\\ncd\"))", "\"ab\""},
    {"(read (open-input-string \" (a . b) c\"))", "(a . b)"},
    {"(read-char (open-input-string \"\"))", "#<eof>"},
    {"(read-u8 (open-input-bytevector (bytevector 7 8)))", "7"},
    {"(read-bytevector 5 (open-input-bytevector (bytevector 7 8)))", "#u8(7 8)"},
    {"(open-input-file \"x\")", "error: open-input-file: cannot open x: not available here"},
    {"(random 1)", "0"},
    {"(random 0)", "error: random: n must be positive, got 0"},
    {NULL, NULL},
};

static void run_numbers(vs_scheme *vm) { check(vm, numbers); }
static void run_texts(vs_scheme *vm) { check(vm, texts); }
static void run_objects(vs_scheme *vm) { check(vm, objects); }

static uint64_t next(uint64_t *s) {
  *s ^= *s << 13, *s ^= *s >> 7, *s ^= *s << 17;
  return *s;
}

/* Tests that random doubles are read back unchanged, and that a text with a digit less gives another double. */
static void round_trips(vs_scheme *vm) {
  uint64_t s = 88172645463325252u;
  for (int i = 0; i < 20000; i++) {
    uint64_t bits = next(&s);
    if (i % 4 == 0) bits &= ~((UINT64_C(1) << 52) - 1);            /* powers of two: the next double below is half as
                                                                    * far away as the next double above */
    double d, back;
    memcpy(&d, &bits, 8);
    if (d != d || d - d != 0) continue;
    char text[VS_DOUBLE_TEXT], shorter[64];
    size_t n = vs_double_text(d, text);
    VS_ROOTS(vm, r, 1);
    assert_true(vs_number_parse(vm, text, n, 10, &r[0]));
    back = vs_double(r[0]);
    if (memcmp(&back, &d, 8)) fail_msg("%s does not read back", text);
    int digits = 0;
    for (const char *p = text; *p && *p != 'e'; p++) digits += *p >= '0' && *p <= '9';
    if (strchr(text, 'e') && digits > 1) {
      snprintf(shorter, sizeof shorter, "%.*e", digits - 2, d);
      assert_true(vs_number_parse(vm, shorter, strlen(shorter), 10, &r[0]));
      back = vs_double(r[0]);
      if (!memcmp(&back, &d, 8)) fail_msg("%s is longer than %s", text, shorter);
    }
  }
}

/* Tests that q * d + r = n with |r| < |d|, for integers of many sizes. */
static void division(vs_scheme *vm) {
  uint64_t s = 1234567;
  VS_ROOTS(vm, r, 5);
  for (int i = 0; i < 4000; i++) {
    for (int k = 0; k < 2; k++) {
      char digits[200];
      int n = 2 + (int)(next(&s) % (k ? 90 : 180));
      for (int j = 0; j < n; j++) digits[j] = (char)('0' + next(&s) % 10);
      digits[n - 1] = '7';
      if (next(&s) & 1) digits[0] = '-';
      assert_true(vs_number_parse(vm, digits, (size_t)n, 10, &r[k]));
    }
    bool equal, small;
    assert_true(vs_number_quotient(vm, r[0], r[1], &r[2]) && vs_number_remainder(vm, r[0], r[1], &r[3]));
    assert_true(vs_number_mul(vm, r[2], r[1], &r[4]) && vs_number_add(vm, r[4], r[3], &r[4]));
    assert_true(vs_number_test(vm, VS_EQ, r[4], r[0], &equal) && equal);
    assert_true(vs_number_abs(vm, r[3], &r[3]) && vs_number_abs(vm, r[1], &r[4]) && vs_number_test(vm, VS_LT, r[3], r[4], &small) && small);
  }
}

/* Compares a hash table with a plain array. Keys are hashed by address and removed at random; the garbage collector
 * moves objects, and the table grows. */
static void tables(vs_scheme *vm) {
  enum { KEYS = 500 };
  bool in[KEYS] = {false};
  uint64_t s = 99;
  VS_ROOTS(vm, r, 4);
  assert_true(vs_make_table(vm, VS_TABLE_EQV, &r[0]) && vs_make_vector(vm, KEYS, VS_FALSE, &r[1]));
  for (int i = 0; i < KEYS; i++) {
    assert_true(vs_cons(vm, vs_fix(i), VS_NIL, &r[2]));
    vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[i], r[2]);
  }
  for (int i = 0; i < 20000; i++) {
    size_t k = (size_t)(next(&s) % KEYS);
    if (i % 7 == 0) {                              /* replaces a key by a new object, which the collector will move */
      if (in[k]) assert_true(vs_table_remove(vm, r[0], vs_as_vector(r[1])->at[k]));
      in[k] = false;
      assert_true(vs_cons(vm, vs_fix((int64_t)k), VS_NIL, &r[2]));
      vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[k], r[2]);
    }
    if (next(&s) % 3) {
      assert_true(vs_table_put(vm, r[0], vs_as_vector(r[1])->at[k], vs_fix((int64_t)k)));
      in[k] = true;
    } else {
      assert_true(vs_table_remove(vm, r[0], vs_as_vector(r[1])->at[k]));
      in[k] = false;
    }
    if (i % 50 == 0) vs_gc_minor(vm);
    k = (size_t)(next(&s) % KEYS);
    assert_true(vs_table_get(vm, r[0], vs_as_vector(r[1])->at[k], &r[3]));
    assert_true(r[3] == (in[k] ? vs_fix((int64_t)k) : VS_VACANT));
  }
}

static void print_of(vs_scheme *vm, vs_value v, vs_print_mode mode, const char *wanted) {
  vs_text t;
  vs_text_open(vm, &t, 0);
  assert_true(vs_print(vm, v, mode, &t) && vs_text_end(&t));
  assert_string_equal(t.at, wanted);
  vs_text_close(&t);
}

static void cycles(vs_scheme *vm) {
  VS_ROOTS(vm, r, 4);
  bool same;
  /* two circular lists of different length, both equal to the endless list (1 1 1 ...) */
  for (int k = 0; k < 2; k++) {
    assert_true(vs_cons(vm, vs_fix(1), VS_NIL, &r[k]));
    r[2] = r[k];
    for (int i = 0; i <= k; i++) assert_true(vs_cons(vm, vs_fix(1), r[2], &r[2]));
    vs_gc_store(vm, vs_as_pair(r[k]), &vs_as_pair(r[k])->cdr, r[2]);
  }
  print_of(vm, r[0], VS_PRINT_WRITE, "#0=(1 1 . #0#)");
  print_of(vm, r[0], VS_PRINT_DISPLAY, "#0=(1 1 . #0#)");
  assert_true(vs_equal(vm, r[0], r[1], &same) && same);
  /* a list that contains another list twice but is not circular, so only write-shared prints labels */
  assert_true(vs_cons(vm, vs_fix(7), VS_NIL, &r[2]) && vs_cons(vm, r[2], VS_NIL, &r[3]) && vs_cons(vm, r[2], r[3], &r[3]));
  print_of(vm, r[3], VS_PRINT_WRITE, "((7) (7))");
  print_of(vm, r[3], VS_PRINT_SHARED, "(#0=(7) #0#)");
  /* a vector that contains itself */
  assert_true(vs_make_vector(vm, 2, vs_fix(3), &r[2]));
  vs_gc_store(vm, vs_as_vector(r[2]), &vs_as_vector(r[2])->at[1], r[2]);
  print_of(vm, r[2], VS_PRINT_WRITE, "#0=#(3 #0#)");
  /* makes pairs nested 60 deep, each containing the previous pair twice: as a tree it has 2^60 nodes */
  r[2] = r[3] = VS_NIL;
  for (int i = 0; i < 60; i++) assert_true(vs_cons(vm, r[3], r[3], &r[3]) && vs_cons(vm, r[2], r[2], &r[2]));
  assert_true(vs_equal(vm, r[2], r[3], &same) && same);
}

static void depth(vs_scheme *vm) {
  VS_ROOTS(vm, r, 2);
  bool same;
  r[0] = r[1] = VS_NIL;
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < 1000000; i++) assert_true(k ? vs_cons(vm, vs_fix(1), r[1], &r[1]) : vs_cons(vm, r[0], VS_NIL, &r[0]));
  for (int k = 0; k < 2; k++) {
    vs_text t;
    vs_text_open(vm, &t, 0);
    assert_true(vs_print(vm, r[k], VS_PRINT_WRITE, &t));
    assert_int_equal(t.count, k ? 2000001 : 2000002);
    vs_text_close(&t);
    assert_true(vs_equal(vm, r[k], r[k], &same) && same);
  }
}

/* Evaluates each row with its n-th allocation refused, for every n. The result must be an error or the usual result.
 * Afterwards all rows work again. */
static void starve(vs_scheme *vm, const row *rows) {
  for (const row *p = rows; p->expression; p++) {
    VS_ROOTS(vm, r, 1);
    size_t used;
    bool refused = true;
    for (size_t n = 1; refused && n < 400; n++) {
      assert_true(vs_read_datum(vm, p->expression, strlen(p->expression), &input, &used));
      vs_gc_fail_after(vm, n);
      bool ok = eval(vm, input, &r[0]);
      refused = vm->fail_after == 0;
      vs_gc_fail_after(vm, 0);
      if (refused && !ok) assert_true(vs_is(vm->condition, VS_T_CONDITION));
    }
  }
  check(vm, rows);
}
static void starved(vs_scheme *vm) {
  starve(vm, numbers);
  starve(vm, texts);
  starve(vm, objects);
}

static void test_starved(void **state) { (void)state, with_vm(starved); }
static void test_numbers(void **state) { (void)state, with_vm(run_numbers); }
static void test_texts(void **state) { (void)state, with_vm(run_texts); }
static void test_objects(void **state) { (void)state, with_vm(run_objects); }
static void test_round_trips(void **state) { (void)state, with_vm(round_trips); }
static void test_division(void **state) { (void)state, with_vm(division); }
static void test_tables(void **state) { (void)state, with_vm(tables); }
static void test_cycles(void **state) { (void)state, with_vm(cycles); }
static void test_depth(void **state) { (void)state, with_vm(depth); }

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_numbers), cmocka_unit_test(test_texts), cmocka_unit_test(test_objects), cmocka_unit_test(test_round_trips),
      cmocka_unit_test(test_division), cmocka_unit_test(test_tables), cmocka_unit_test(test_cycles), cmocka_unit_test(test_depth),
      cmocka_unit_test(test_starved),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
