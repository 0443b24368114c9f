/* Owns the numeric tower: fixnums, bignums, ratios, doubles. (integer.h has the exact integers below it, number_text.c
 * the texts.)
 *
 * All arithmetic takes any two values. A value that is no number gives the error `+: expected a number, got "x"`; a
 * flat record (point, vector) is passed to vs_flat_arith. A result may replace an argument in its slot: `out` is
 * written last. */
#ifndef VS_VM_NUMBERS_NUMBER_H
#define VS_VM_NUMBERS_NUMBER_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

static inline bool vs_is_bignum(vs_value v) { return vs_is(v, VS_T_BIGNUM); }
static inline bool vs_is_ratio(vs_value v) { return vs_is(v, VS_T_RATIO); }
static inline bool vs_is_exact_integer(vs_value v) { return vs_is_fixnum(v) || vs_is_bignum(v); }
static inline bool vs_is_exact(vs_value v) { return vs_is_exact_integer(v) || vs_is_ratio(v); }
static inline bool vs_is_number(vs_value v) { return vs_is_double(v) || vs_is_exact(v); }

/* ---- for the run loop: the general case of inlined operators ---- */
bool vs_number_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_div(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);    /* exact by exact 0 is an error */
/* Computes a+b etc. if one of them is a flat record. Returns false with an error that names both kinds. */
bool vs_flat_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* exact between exact and inexact; false with NaN */
typedef enum { VS_LT, VS_LE, VS_EQ, VS_GE, VS_GT } vs_relation;
bool vs_number_test(vs_scheme *vm, vs_relation relation, vs_value a, vs_value b, bool *out);
bool vs_number_quotient(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_remainder(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_modulo(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_number_abs(vs_scheme *vm, vs_value a, vs_value *out);
bool vs_number_sqrt(vs_scheme *vm, vs_value a, vs_value *out);               /* exact if the root is exact */
bool vs_number_is_zero(vs_scheme *vm, vs_value a, bool *out);                /* or "zero?: expected a number" */

/* ---- conversions ---- */
/* v is a number; correctly rounded; returns false when memory is out */
bool vs_number_double(vs_scheme *vm, vs_value v, double *out);
/* v is a number; infinities and NaN are errors */
bool vs_number_exact(vs_scheme *vm, vs_value v, vs_value *out);
/* exact integers, den not 0; gives lowest terms */
bool vs_number_ratio(vs_scheme *vm, vs_value num, vs_value den, vs_value *out);
/* Does the same for two that have no common divisor. */
bool vs_number_lowest(vs_scheme *vm, vs_value num, vs_value den, vs_value *out);

/* Returns true if both are equal in type and value, as eqv? on two numbers. Never fails. */
bool vs_number_eqv(vs_value a, vs_value b);
uint64_t vs_number_hash(vs_value v);                                  /* agrees with eqv? */

/* ---- text ---- */
enum { VS_DOUBLE_TEXT = 32 };

#endif
