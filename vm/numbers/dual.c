/* Implements the arithmetic of dual numbers (dual.h), which carry a derivative. The rules use the general operations on
 * numbers, which also accept dual numbers, so that nested dual numbers are differentiated, too. Recursion is at most as
 * deep as dual numbers are nested, VS_DUAL_DEPTH. */
#include "vm/numbers/dual.h"

#include <math.h>

int64_t vs_dual_level(const vs_value *at, size_t n) {
  int64_t level = -1;
  for (size_t i = 0; i < n; i++)
    if (vs_is_dual(at[i]) && vs_fixnum(vs_as_dual(at[i])->level) > level) level = vs_fixnum(vs_as_dual(at[i])->level);
  return level;
}

static bool is_at(vs_value v, int64_t level) { return vs_is_dual(v) && vs_fixnum(vs_as_dual(v)->level) == level; }
vs_value vs_dual_value(vs_value v, int64_t level) { return is_at(v, level) ? vs_as_dual(v)->value : v; }
vs_value vs_dual_slope(vs_value v, int64_t level) { return is_at(v, level) ? vs_as_dual(v)->slope : vs_fix(0); }

bool vs_make_dual(vs_scheme *vm, int64_t level, vs_value value, vs_value slope, vs_value *out) {
  int depth = 1;
  VS_ASSERT(vs_dual_level(&value, 1) < level && vs_dual_level(&slope, 1) < level);
  for (vs_value v = value; vs_is_dual(v); v = vs_as_dual(v)->value) depth++;
  if (depth > VS_DUAL_DEPTH)
    return vs_fail(vm, vm->sym.range, "derivatives lie more than %d deep in one another", VS_DUAL_DEPTH);
  VS_ROOTS(vm, r, 2);
  r[0] = value, r[1] = slope;
  vs_dual *d = (vs_dual *)(void *)vs_gc_alloc(vm, VS_T_DUAL, VS_WORDS(vs_dual));
  if (!d) return false;
  d->level = vs_fix(level), d->value = r[0], d->slope = r[1];
  *out = vs_from_object(d);
  return true;
}

/* ---- + - * / ---- */

bool vs_dual_arith(vs_scheme *vm, vs_flat_op op, vs_value a, vs_value b, vs_value *out) {
  enum { AV, AS, BV, BS, V, S, ROOTS };
  VS_ROOTS(vm, r, ROOTS);
  int64_t la = vs_dual_level(&a, 1), lb = vs_dual_level(&b, 1), level = la > lb ? la : lb;
  bool va = la == level, vb = lb == level; /* va, vb: whether a and b depend on the variable of `level`, the higher
                                            * level of the two numbers */
  VS_ASSERT(la >= 0 || lb >= 0);
  r[AV] = vs_dual_value(a, level), r[AS] = vs_dual_slope(a, level);
  r[BV] = vs_dual_value(b, level), r[BS] = vs_dual_slope(b, level);
  bool ok = true;
  switch (op) {
  case VS_OP_ADD:
    ok = vs_number_add(vm, r[AV], r[BV], &r[V]);
    if (va && vb)
      ok = ok && vs_number_add(vm, r[AS], r[BS], &r[S]);
    else
      r[S] = va ? r[AS] : r[BS];
    break;
  case VS_OP_SUB:
    ok = vs_number_sub(vm, r[AV], r[BV], &r[V]);
    if (!vb)
      r[S] = r[AS];
    else
      ok = ok && vs_number_sub(vm, va ? r[AS] : vs_fix(0), r[BS], &r[S]);
    break;
  case VS_OP_MUL:
    ok = vs_number_mul(vm, r[AV], r[BV], &r[V]);
    if (ok && va) ok = vs_number_mul(vm, r[AS], r[BV], &r[S]);
    if (ok && vb) {
      ok = vs_number_mul(vm, r[AV], r[BS], &r[AS]);
      if (!va)
        r[S] = r[AS];
      else
        ok = ok && vs_number_add(vm, r[S], r[AS], &r[S]);
    }
    break;
  case VS_OP_DIV: /* the derivative of q = a / b: (a' - q b') / b */
    ok = vs_number_div(vm, r[AV], r[BV], &r[V]);
    if (ok && vb) {
      ok = vs_number_mul(vm, r[V], r[BS], &r[S]) && vs_number_sub(vm, va ? r[AS] : vs_fix(0), r[S], &r[AS]);
    }
    ok = ok && vs_number_div(vm, r[AS], r[BV], &r[S]);
    break;
  case VS_OP_COUNT: return vs_fail(vm, vm->sym.internal, "no such operator");
  }
  return ok && vs_make_dual(vm, level, r[V], r[S], out);
}

/* ---- functions of one number ---- */

/* Sets *d to the derivative f'(x), where y = f(x). All pointers are to roots of the garbage collector; scratch is for
 * temporary values. */
static bool slope_of(vs_scheme *vm, double (*f)(double), const vs_value *x, const vs_value *y, vs_value *scratch,
                     vs_value *d) {
  if (f == exp) return *d = *y, true;
  if (f == log) return vs_number_div(vm, vs_flonum(1), *x, d);
  if (f == sqrt) return vs_number_add(vm, *y, *y, d) && vs_number_div(vm, vs_flonum(1), *d, d);
  if (f == sin) return vs_dual_function(vm, cos, *x, d);
  if (f == cos) return vs_dual_function(vm, sin, *x, d) && vs_number_sub(vm, vs_fix(0), *d, d);
  if (f == tan) return vs_number_mul(vm, *y, *y, d) && vs_number_add(vm, *d, vs_fix(1), d);
  if (f == tanh) return vs_number_mul(vm, *y, *y, d) && vs_number_sub(vm, vs_fix(1), *d, d);
  if (f == sinh) return vs_dual_function(vm, cosh, *x, d);
  if (f == cosh) return vs_dual_function(vm, sinh, *x, d);
  if (f == cbrt) /* derivative of the cube root: y / 3x */
    return vs_number_mul(vm, *x, vs_flonum(3), scratch) && vs_number_div(vm, *y, *scratch, d);
  if (f == asin || f == acos) /* derivative of the arc sine: 1 / sqrt(1 - x x) */
    return vs_number_mul(vm, *x, *x, d) && vs_number_sub(vm, vs_fix(1), *d, d) && vs_dual_function(vm, sqrt, *d, d) &&
           vs_number_div(vm, vs_flonum(f == asin ? 1 : -1), *d, d);
  if (f == atan)
    return vs_number_mul(vm, *x, *x, d) && vs_number_add(vm, *d, vs_fix(1), d) &&
           vs_number_div(vm, vs_flonum(1), *d, d);
  return vs_fail(vm, vm->sym.internal, "no derivative is known");
}

bool vs_dual_function(vs_scheme *vm, double (*f)(double), vs_value v, vs_value *out) {
  if (!vs_is_dual(v)) {
    double x;
    if (!vs_is_number(v)) return vs_fail_type(vm, 0, "a number", v);
    if (!vs_number_double(vm, v, &x)) return false;
    bool outside = f == sqrt ? x < 0 : f == log ? x < 0 || v == vs_fix(0) : (f == asin || f == acos) && fabs(x) > 1;
    if (outside)
      return vs_fail_type(vm, 0,
                          f == log    ? "positive"
                          : f == sqrt ? "a number that is not negative"
                                      : "a number from -1 to 1",
                          v);
    return *out = vs_flonum(f(x)), true;
  }
  enum { X, XS, Y, D, SCRATCH, ROOTS };
  VS_ROOTS(vm, r, ROOTS);
  int64_t level = vs_fixnum(vs_as_dual(v)->level);
  r[X] = vs_as_dual(v)->value, r[XS] = vs_as_dual(v)->slope;
  return vs_dual_function(vm, f, r[X], &r[Y]) && slope_of(vm, f, &r[X], &r[Y], &r[SCRATCH], &r[D]) &&
         vs_number_mul(vm, r[XS], r[D], &r[D]) && vs_make_dual(vm, level, r[Y], r[D], out);
}

/* ---- functions of two numbers ---- */

bool vs_dual_atan(vs_scheme *vm, vs_value y, vs_value x, vs_value *out) {
  if (!vs_is_dual(y) && !vs_is_dual(x)) {
    double a, b;
    if (!vs_number_double(vm, y, &a) || !vs_number_double(vm, x, &b)) return false;
    return *out = vs_flonum(atan2(a, b)), true;
  }
  enum { YV, YS, XV, XS, V, S, T, ROOTS };
  VS_ROOTS(vm, r, ROOTS);
  const vs_value both[2] = { y, x };
  int64_t level = vs_dual_level(both, 2);
  r[YV] = vs_dual_value(y, level), r[YS] = vs_dual_slope(y, level);
  r[XV] = vs_dual_value(x, level), r[XS] = vs_dual_slope(x, level);
  /* Derivative of atan(y, x): (x y' - y x') / (x x + y y). */
  return vs_dual_atan(vm, r[YV], r[XV], &r[V]) && vs_number_mul(vm, r[XV], r[YS], &r[S]) &&
         vs_number_mul(vm, r[YV], r[XS], &r[T]) && vs_number_sub(vm, r[S], r[T], &r[S]) &&
         vs_number_mul(vm, r[XV], r[XV], &r[XS]) && vs_number_mul(vm, r[YV], r[YV], &r[YS]) &&
         vs_number_add(vm, r[XS], r[YS], &r[T]) && vs_number_div(vm, r[S], r[T], &r[S]) &&
         vs_make_dual(vm, level, r[V], r[S], out);
}

/* Computes a power with an integer exponent by multiplication. This is correct for negative bases and 0, and keeps
 * exact numbers exact. */
static bool whole_power(vs_scheme *vm, vs_value base, int64_t n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = base, r[1] = vs_fix(1);
  bool negative = n < 0;
  if (negative) n = -n;
  while (n) {
    if (n & 1 && !vs_number_mul(vm, r[1], r[0], &r[1])) return false;
    n >>= 1;
    if (n && !vs_number_mul(vm, r[0], r[0], &r[0])) return false;
  }
  if (negative) return vs_number_div(vm, vs_fix(1), r[1], out);
  return *out = r[1], true;
}

bool vs_dual_expt(vs_scheme *vm, vs_value base, vs_value power, vs_value *out) {
  if (!vs_is_dual(power)) {
    double n;
    if (!vs_is_number(power)) return vs_fail_type(vm, 1, "a number", power);
    if (!vs_number_double(vm, power, &n)) return false;
    if (n == floor(n) && fabs(n) <= 1 << 20) return whole_power(vm, base, (int64_t)n, out);
  }
  VS_ROOTS(vm, r, 2);
  r[0] = base, r[1] = power;
  return vs_dual_function(vm, log, r[0], &r[0]) && vs_number_mul(vm, r[0], r[1], &r[0]) &&
         vs_dual_function(vm, exp, r[0], out);
}
