/* Owns dual numbers: a value together with its slope, how fast it changes with the variable of one differentiation.

   A dual is v + s e with e * e = 0 (forward mode). `level` tells the differentiations under way apart: each has a
   number of its own, higher than those of the differentiations around it. Of two operands the one of the higher level
   is taken apart, and the other is a constant there: so derivatives of derivatives do not confuse their variables.
   `value` and `slope` are numbers, duals of lower levels, or flat records (a point's slope is a gvector).

   Arithmetic finds duals where it would otherwise fail: fixnums, doubles and the exact numbers never come here. */
#ifndef VS_VM_NUMBERS_DUAL_H
#define VS_VM_NUMBERS_DUAL_H

#include "vm/numbers/number.h"

enum { VS_DUAL_DEPTH = 24 }; /* so many duals may lie in one another: the work doubles with each */

static inline bool vs_is_dual(vs_value v) { return vs_is(v, VS_T_DUAL); }
static inline vs_value vs_dual_base(vs_value v) { /* the plain value: what comparisons look at */
  while (vs_is_dual(v)) v = vs_as_dual(v)->value;
  return v;
}
/* Is v a number of any kind, dual ones included? */
static inline bool vs_is_scalar(vs_value v) { return vs_is_number(vs_dual_base(v)); }
/* The highest level among n values; -1: none is a dual. */
int64_t vs_dual_level(const vs_value *at, size_t n);
/* v's two halves at this level: itself and the exact 0 where it does not vary there. */
vs_value vs_dual_value(vs_value v, int64_t level);
vs_value vs_dual_slope(vs_value v, int64_t level);

/* The value and the slope are of lower levels. */
bool vs_make_dual(vs_scheme *vm, int64_t level, vs_value value, vs_value slope,
                  vs_value *out); /* an error beyond VS_DUAL_DEPTH */
/* a + b and the like where one of them is a dual */
bool vs_dual_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out);
/* f(v) for v a number or a dual; `f` is one of the C functions of a real number that dual.c knows the derivatives of.
 */
bool vs_dual_function(vs_scheme *vm, double (*f)(double), vs_value v, vs_value *out);
bool vs_dual_atan(vs_scheme *vm, vs_value y, vs_value x, vs_value *out);
bool vs_dual_expt(vs_scheme *vm, vs_value base, vs_value power,
                  vs_value *out); /* by log and exp where the power varies */

#endif
