/* Declares numbers: fixnums, bignums, ratios, doubles. integer.h declares exact integers; number_text.c converts
 * numbers to text.
 *
 * Arithmetic accepts any two values. A value that is no number is the error `+: expected a number, got "x"`. A flat
 * record (point, vector) is passed to vs_flat_arith. `out` is written last, so that it may be the slot of an
 * argument. */
#ifndef VS_VM_NUMBERS_NUMBER_H
#define VS_VM_NUMBERS_NUMBER_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

static inline bool vs_is_bignum(vs_value v) { return vs_is(v, VS_T_BIGNUM); }
static inline bool vs_is_ratio(vs_value v) { return vs_is(v, VS_T_RATIO); }
static inline bool vs_is_exact_integer(vs_value v) { return vs_is_fixnum(v) || vs_is_bignum(v); }
static inline bool vs_is_exact(vs_value v) { return vs_is_exact_integer(v) || vs_is_ratio(v); }
static inline bool vs_is_number(vs_value v) { return vs_is_double(v) || vs_is_exact(v); }

/* ---- operations that instructions call if their operands are neither fixnums nor doubles ---- */
bool vs_number_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_div(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);    /* division of an exact number by an exact
                                                                              * 0 is an error */
/* Computes a+b, a-b, a*b or a/b, where at least one operand is a flat record (point, vector). Returns false with an
 * error that names the kinds of both operands. */
bool vs_flat_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* Relations of numbers. A comparison of an exact with an inexact number is exact; a comparison with NaN is false. */
typedef enum { VS_LT, VS_LE, VS_EQ, VS_GE, VS_GT } vs_relation;
bool vs_number_test(vs_scheme *vm, vs_relation relation, vs_value a, vs_value b, bool *out);
bool vs_number_quotient(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_remainder(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_modulo(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_abs(vs_scheme *vm, vs_value a, vs_value *out);
bool vs_number_sqrt(vs_scheme *vm, vs_value a, vs_value *out);               /* if a is exact and has an exact square
                                                                              * root, the result is this root */
bool vs_number_is_zero(vs_scheme *vm, vs_value a, bool *out);                /* other values are the error "zero?:
                                                                              * expected a number" */

/* ---- conversions ---- */
/* Sets *out to the double nearest to a number. Returns false when memory is out. */
bool vs_number_double(vs_scheme *vm, vs_value v, double *out);
/* Sets *out to the exact number that equals v. Infinities and NaN are errors. */
bool vs_number_exact(vs_scheme *vm, vs_value v, vs_value *out);
/* Sets *out to num / den in lowest terms. num and den are exact integers; den is not 0. */
bool vs_number_ratio(vs_scheme *vm, vs_value num, vs_value den, vs_value *out);
/* Sets *out to num / den, where num and den have no common divisor. */
bool vs_number_lowest(vs_scheme *vm, vs_value num, vs_value den, vs_value *out);

/* Returns true if two numbers are equal in type and value, as by eqv?. */
bool vs_number_eqv(vs_value a, vs_value b);
uint64_t vs_number_hash(vs_value v);                                  /* returns equal hashes for numbers that are
                                                                       * eqv? */

/* ---- numbers as texts ---- */
enum { VS_DOUBLE_TEXT = 32 };

/* Returns the cube root of x. A step of Newton's method corrects the last digit of cbrt, which may be wrong (even for
 * 27). */
double vs_cube_root(double x);

#endif
