/* Declares dual numbers: a value with its slope, the derivative in the variable of one differentiation.
 *
 * A dual is v + s e with e * e = 0 (forward mode). Each running differentiation has its own `level`, higher than those
 * of the differentiations around it. If two operands have different levels, the one of the lower level counts as a
 * constant. Derivatives of derivatives therefore do not confuse their variables. `value` and `slope` are numbers, duals
 * of lower levels, or flat records (a point's slope is a gvector).
 *
 * Arithmetic tests for duals only where it would otherwise fail. The arithmetic of fixnums, doubles and exact numbers
 * is therefore not slower. */
#ifndef VS_VM_NUMBERS_DUAL_H
#define VS_VM_NUMBERS_DUAL_H

#include "vm/numbers/number.h"

enum { VS_DUAL_DEPTH = 24 }; /* greatest nesting of dual numbers, since each level doubles the work */

static inline bool vs_is_dual(vs_value v) { return vs_is(v, VS_T_DUAL); }
static inline vs_value vs_dual_base(vs_value v) { /* Returns v without its slopes: the value that comparisons use. */
  while (vs_is_dual(v)) v = vs_as_dual(v)->value;
  return v;
}
/* Returns true if v is a number of any kind, duals included. */
static inline bool vs_is_scalar(vs_value v) { return vs_is_number(vs_dual_base(v)); }
/* Returns the highest level among the n values; -1 if none of them is a dual number. */
int64_t vs_dual_level(const vs_value *at, size_t n);
/* Returns the value of v without its derivative in the variable of this level. If v does not depend on the variable,
 * returns v. */
vs_value vs_dual_value(vs_value v, int64_t level);
/* Returns the derivative of v in the variable of this level, or the exact 0 if v does not depend on the variable. */
vs_value vs_dual_slope(vs_value v, int64_t level);

/* Sets *out to a dual number. The levels of value and slope must be lower than `level`. */
bool vs_make_dual(vs_scheme *vm, int64_t level, vs_value value, vs_value slope,
                  vs_value *out); /* nesting more than VS_DUAL_DEPTH dual numbers is an error */
/* Computes a + b, a - b, a * b or a / b, where at least one operand is a dual. */
bool vs_dual_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* Computes f(v) for a number or dual; f must be one of the functions whose derivatives dual.c contains. */
bool vs_dual_function(vs_scheme *vm, double (*f)(double), vs_value v, vs_value *out);
bool vs_dual_atan(vs_scheme *vm, vs_value y, vs_value x, vs_value *out);
bool vs_dual_expt(vs_scheme *vm, vs_value base, vs_value power,
                  vs_value *out); /* if the exponent is a dual, the power is computed by log and exp */

#endif
