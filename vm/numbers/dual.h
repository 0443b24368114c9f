/* Owns dual numbers: a value with its slope, the derivative by the variable of one differentiation.
 *
 * A dual is v + s e with e * e = 0 (forward mode). `level` distinguishes the differentiations that run: each has a
 * number of its own, higher than those of the enclosing ones. If two operands have different levels, the one of the
 * higher level is a dual, and the other counts as a constant. Therefore derivatives of derivatives do not confuse their
 * variables. `value` and `slope` are numbers, duals of lower levels, or flat records (a point's slope is a gvector).
 *
 * Arithmetic tests for duals only where it would otherwise fail: fixnums, doubles and exact numbers never come here. */
#ifndef VS_VM_NUMBERS_DUAL_H
#define VS_VM_NUMBERS_DUAL_H

#include "vm/numbers/number.h"

enum { VS_DUAL_DEPTH = 24 }; /* nesting limit of duals: each level doubles the work */

static inline bool vs_is_dual(vs_value v) { return vs_is(v, VS_T_DUAL); }
static inline vs_value vs_dual_base(vs_value v) { /* Returns the plain value, which comparisons use. */
  while (vs_is_dual(v)) v = vs_as_dual(v)->value;
  return v;
}
/* Returns true if v is a number of any kind, duals included. */
static inline bool vs_is_scalar(vs_value v) { return vs_is_number(vs_dual_base(v)); }
/* Returns the highest level among n values; -1 if none is a dual. */
int64_t vs_dual_level(const vs_value *at, size_t n);
/* Returns the value or the slope of v at this level. A v that does not vary there is its own value, and its slope is
 * the exact 0. */
vs_value vs_dual_value(vs_value v, int64_t level);
vs_value vs_dual_slope(vs_value v, int64_t level);

/* Makes a dual; the value and the slope are of lower levels. */
bool vs_make_dual(vs_scheme *vm, int64_t level, vs_value value, vs_value slope,
                  vs_value *out); /* an error beyond VS_DUAL_DEPTH */
/* Computes a + b and the like if one of them is a dual. */
bool vs_dual_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* Computes f(v) for a number or a dual; `f` is one of the C functions of a real number with a derivative in dual.c. */
bool vs_dual_function(vs_scheme *vm, double (*f)(double), vs_value v, vs_value *out);
bool vs_dual_atan(vs_scheme *vm, vs_value y, vs_value x, vs_value *out);
bool vs_dual_expt(vs_scheme *vm, vs_value base, vs_value power,
                  vs_value *out); /* by log and exp if the exponent varies */

#endif
