/* Implements powers, roots, logarithms and trigonometry. An argument outside a function's domain is an error; the
 * result is not NaN. If an exact argument has an exact result (sin 0, expt 2/3 100, sqrt 1/4), the result is exact. */
#include <math.h>
#include <stdio.h>

#include "vm/numbers/dual.h"
#include "vm/numbers/integer.h"

/* Computes the running procedure for arguments of which one is a record that acts as a number (an interval). A function
 * that the host has registered computes the result. */
static vs_status of_record(vs_scheme *vm, const vs_value *a, int n, vs_value *out) {
  return vm->flat->call(vm, vs_as_symbol(vm->native->name)->name, a, n, out);
}

/* Returns true if a[0] and a[1] are numbers, and at least one is a dual number (a number with a derivative). */
static bool dual_pair(const vs_value *a) {
  return (vs_is_dual(a[0]) || vs_is_dual(a[1])) && vs_is_scalar(a[0]) && vs_is_scalar(a[1]);
}

static bool want_double(vs_scheme *vm, const vs_value *a, int i, double *out) {
  return vs_is_number(a[i]) ? vs_number_double(vm, a[i], out) : vs_fail_type(vm, i, "a number", a[i]);
}

/* Applies the function f of doubles to an argument. If the argument is the exact integer `at`, the result is the exact
 * integer exact_value. */
static vs_status function(vs_scheme *vm, const vs_value *a, double (*f)(double), int64_t at, int64_t exact_value,
                          vs_value *out) {
  double x;
  if (a[0] == vs_fix(at)) return *out = vs_fix(exact_value), VS_OK;
  if (vs_is_dual(a[0])) return vs_dual_function(vm, f, a[0], out);
  if (vs_flat_callable(vm, a, 1)) return of_record(vm, a, 1, out);
  if (!want_double(vm, a, 0, &x)) return VS_ERROR;
  *out = vs_flonum(f(x));
  return VS_OK;
}
static vs_status exp_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, function(vm, a, exp, 0, 1, out);
}

/* Warns about an integer that is probably an angle in degrees (30, 45, 60, ... 360) where radians are expected. Does
 * not warn if the same call in the program had an integer from 1 to 6 before, as in a counting loop. */
static void suspect_degrees(vs_scheme *vm, const char *name, vs_value v) {
  if (!vs_is_fixnum(v) || !vm->config.suspect) return;
  int64_t x = vs_fixnum(v) < 0 ? -vs_fixnum(v) : vs_fixnum(v);
  if (x > 0 && x <= 6) vm->config.suspect(vm, "degrees", NULL);
  if (x < 30 || x > 360 || (x % 90 && x != 30 && x != 45 && x != 60 && x != 120 && x != 135 && x != 150)) return;
  char text[160];
  snprintf(text, sizeof text, "%s: %lld radians are %.1f turns; (degrees->radians %lld)?", name,
      (long long)vs_fixnum(v), (double)x / 6.283185307179586,
           (long long)vs_fixnum(v));
  vm->config.suspect(vm, "degrees", text);
}

static vs_status sin_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, suspect_degrees(vm, "sin", a[0]), function(vm, a, sin, 0, 0, out);
}
static vs_status cos_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, suspect_degrees(vm, "cos", a[0]), function(vm, a, cos, 0, 1, out);
}
static vs_status tan_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, suspect_degrees(vm, "tan", a[0]), function(vm, a, tan, 0, 0, out);
}
static vs_status sinh_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, function(vm, a, sinh, 0, 0, out);
}
static vs_status cosh_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, function(vm, a, cosh, 0, 1, out);
}
static vs_status tanh_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, function(vm, a, tanh, 0, 0, out);
}

/* Sets *root to the exact cube root of an exact integer. Sets it to VS_FALSE if there is none, or if it is no fixnum
 * (48 bits). */
static bool integer_cbrt(vs_scheme *vm, vs_value n, vs_value *root) {
  VS_ROOTS(vm, r, 2);
  VS_ASSERT(vs_is_exact_integer(n));
  r[0] = n;
  double d;
  if (!vs_number_double(vm, r[0], &d)) return false;
  *root = VS_FALSE;
  double c = round(cbrt(d));          /* for a root below 10^15, the error of cbrt is less than one half, so rounding
                                       * finds an integer root */
  if (!(fabs(c) <= 1e15)) return true;
  vs_value guess = vs_fix((int64_t)c);
  if (!vs_fits_fixnum((int64_t)c)) return true;
  bool same;
  if (!vs_number_mul(vm, guess, guess, &r[1]) || !vs_number_mul(vm, r[1], guess, &r[1]) ||
      !vs_number_test(vm, VS_EQ, r[0], r[1], &same))
    return false;
  if (same) *root = guess;
  return true;
}
static vs_status cbrt_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_is_number(a[0]) && vs_is_exact(a[0])) {
    vs_value num, den = vs_fix(1);
    bool ratio = vs_is_ratio(a[0]);
    if (!integer_cbrt(vm, ratio ? vs_as_ratio(a[0])->num : a[0], &num) ||
        (ratio && !integer_cbrt(vm, vs_as_ratio(a[0])->den, &den)))
      return VS_ERROR;
    if (num != VS_FALSE && den != VS_FALSE) return ratio ? vs_number_ratio(vm, num, den, out) : (*out = num, VS_OK);
  }
  if (vs_is_dual(a[0])) return vs_dual_function(vm, cbrt, a[0], out);
  return function(vm, a, vs_cube_root, 0, 0, out);
}

static vs_status arc(vs_scheme *vm, const vs_value *a, double (*f)(double), int64_t zero_at, vs_value *out) {
  double x;
  if (a[0] == vs_fix(zero_at)) return *out = vs_fix(0), VS_OK;
  if (vs_is_dual(a[0])) return vs_dual_function(vm, f, a[0], out);
  if (vs_flat_callable(vm, a, 1)) return of_record(vm, a, 1, out);
  if (!want_double(vm, a, 0, &x)) return VS_ERROR;
  if (fabs(x) > 1) return vs_fail_type(vm, 0, "a number from -1 to 1", a[0]);
  *out = vs_flonum(f(x));
  return VS_OK;
}
static vs_status asin_(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return (void)n, arc(vm, a, asin, 0, out); }
static vs_status acos_(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return (void)n, arc(vm, a, acos, 1, out); }

static vs_status atan_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n == 1) return function(vm, a, atan, 0, 0, out);
  double y, x;
  if (!vs_is_number(a[0]) && vs_flat_callable(vm, a, n)) return of_record(vm, a, n, out);
  if (dual_pair(a)) return vs_dual_atan(vm, a[0], a[1], out);
  if (!want_double(vm, a, 0, &y) || !want_double(vm, a, 1, &x)) return VS_ERROR;
  if (a[0] == vs_fix(0)) {
    if (a[1] == vs_fix(0)) return vs_fail_type(vm, 1, "not 0 when y is 0", a[1]);
    if (vs_is_exact(a[1]) && x > 0) return *out = vs_fix(0), VS_OK;
  }
  *out = vs_flonum(atan2(y, x));
  return VS_OK;
}

static vs_status hypot_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  double x, y;
  if (dual_pair(a))
    return vs_number_mul(vm, a[0], a[0], &a[0]) && vs_number_mul(vm, a[1], a[1], &a[1]) &&
           vs_number_add(vm, a[0], a[1], &a[0]) && vs_dual_function(vm, sqrt, a[0], out);
  if (!want_double(vm, a, 0, &x) || !want_double(vm, a, 1, &y)) return VS_ERROR;
  *out = vs_flonum(hypot(x, y));
  return VS_OK;
}

/* Computes the natural logarithm of a positive number, which may be exact and outside the range of doubles. */
static bool natural_log(vs_scheme *vm, const vs_value *a, int i, double *out) {
  double x;
  if (!want_double(vm, a, i, &x)) return false;
  if (x < 0 || a[i] == vs_fix(0)) return vs_fail_type(vm, i, "positive", a[i]);
  if (vs_is_double(a[i]) || (x != 0 && isfinite(x))) return *out = log(x), true;
  /* The exact number is outside the range of doubles: scales it by a power of two. */
  VS_ROOTS(vm, r, 2);
  r[0] = vs_is_ratio(a[i]) ? vs_as_ratio(a[i])->num : a[i];
  r[1] = vs_is_ratio(a[i]) ? vs_as_ratio(a[i])->den : vs_fix(1);
  int64_t e = (int64_t)vs_int_bits(r[0]) - (int64_t)vs_int_bits(r[1]);
  if (!(e > 0 ? vs_int_shift(vm, r[1], e, &r[1]) : vs_int_shift(vm, r[0], -e, &r[0])) ||
      !vs_int_ratio_double(vm, r[0], r[1], &x))
    return false;
  *out = log(x) + (double)e * log(2.0);
  return true;
}

static vs_status log_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  double x, base;
  if (!vs_is_number(a[0]) && vs_flat_callable(vm, a, n)) return of_record(vm, a, n, out);
  if (vs_is_dual(a[0]) || (n > 1 && vs_is_dual(a[1]))) {
    if (n == 1) return vs_dual_function(vm, log, a[0], out);
    return vs_dual_function(vm, log, a[0], &a[0]) && vs_dual_function(vm, log, a[1], &a[1]) &&
           vs_number_div(vm, a[0], a[1], out);
  }
  if (n == 1) {
    if (a[0] == vs_fix(1)) return *out = vs_fix(0), VS_OK;
    if (!natural_log(vm, a, 0, &x)) return VS_ERROR;
    *out = vs_flonum(x);
    return VS_OK;
  }
  if (a[1] == vs_fix(1)) return vs_fail_type(vm, 1, "a base other than 1", a[1]);
  if (!natural_log(vm, a, 0, &x) || !natural_log(vm, a, 1, &base)) return VS_ERROR;
  double d, b;
  if (!vs_number_double(vm, a[0], &d) || !vs_number_double(vm, a[1], &b)) return VS_ERROR;
  bool finite = isfinite(d) && d > 0;
  *out = vs_flonum(finite && b == 2 ? log2(d) : finite && b == 10 ? log10(d) : x / base);
  return VS_OK;
}

static vs_status sqrt_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_flat_callable(vm, a, 1)) return of_record(vm, a, 1, out);
  return vs_is_scalar(a[0]) ? vs_number_sqrt(vm, a[0], out) : vs_fail_type(vm, 0, "a number", a[0]);
}

static vs_status exact_integer_sqrt(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_exact_integer(a[0]) || vs_int_sign(a[0]) < 0)
    return vs_fail_type(vm, 0, "an exact integer from 0 on", a[0]);
  VS_ROOTS(vm, r, 2);
  return vs_int_sqrt(vm, a[0], &r[0], &r[1]) ? vs_several(vm, r, 2, out) : VS_ERROR;
}

/* Computes an exact base to an exact integer power. */
static bool exact_power(vs_scheme *vm, vs_value base, vs_value exponent, vs_value *out) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(vs_is_exact(base) && vs_is_exact_integer(exponent));
  r[0] = base;
  bool negative = vs_int_sign(exponent) < 0;
  if (!vs_is_fixnum(exponent)) {                 /* the exponent exceeds 2^47: only for the bases 0, 1 and -1 does the
                                                  * power fit into memory */
    if (base == vs_fix(1)) return *out = base, true;
    if (base == vs_fix(-1)) return *out = vs_fix(vs_int_is_odd(exponent) ? -1 : 1), true;
    if (base == vs_fix(0) && !negative) return *out = base, true;
    return vs_fail(vm, vm->sym.range, "the power would be too large");
  }
  uint64_t n = (uint64_t)(negative ? -vs_fixnum(exponent) : vs_fixnum(exponent));
  bool ratio = vs_is_ratio(base);
  r[1] = ratio ? vs_as_ratio(base)->num : base;
  r[2] = ratio ? vs_as_ratio(base)->den : vs_fix(1);
  if (negative && r[1] == vs_fix(0)) return vs_fail(vm, vm->sym.divide, "0 has no negative power");
  if (!vs_int_power(vm, r[1], n, &r[1]) || !vs_int_power(vm, r[2], n, &r[2])) return false;
  return vs_number_lowest(vm, r[negative ? 2 : 1], r[negative ? 1 : 2], out);
}

/* Sets *out to the exact k-th root of an exact integer >= 0. Sets it to #f if there is no such root, or if doubles are
 * too inaccurate to find it. */
static bool exact_root(vs_scheme *vm, vs_value x, int64_t k, vs_value *out) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(vs_is_exact_integer(x) && vs_int_sign(x) >= 0 && k > 0);
  r[0] = x;
  *out = VS_FALSE;
  double guess = pow(vs_int_double(x), 1.0 / (double)k);
  if (!(guess < 4e15)) return true;
  return vs_int_from_double(vm, rint(guess), &r[1]) && vs_int_power(vm, r[1], (uint64_t)k, &r[2]) &&
         (*out = vs_int_compare(r[2], r[0]) == 0 ? r[1] : VS_FALSE, true);
}

static vs_status expt(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  double x, y;
  if (!vs_is_number(a[0]) && vs_flat_callable(vm, a, n)) return of_record(vm, a, n, out);
  if (dual_pair(a)) return vs_dual_expt(vm, a[0], a[1], out);
  if (!want_double(vm, a, 0, &x) || !want_double(vm, a, 1, &y)) return VS_ERROR;
  if (vs_is_exact_integer(a[1])) {
    if (a[1] == vs_fix(0)) return *out = vs_is_exact(a[0]) ? vs_fix(1) : vs_flonum(1), VS_OK;
    if (vs_is_exact(a[0])) return exact_power(vm, a[0], a[1], out);
    *out = vs_flonum(pow(x, y));
    return VS_OK;
  }
  if (x < 0 && isfinite(y) && y != floor(y))
    return vs_fail_type(vm, 0, "not negative with a power that is no integer", a[0]);
  if (a[0] == vs_fix(0)) {
    if (y > 0) return *out = vs_is_exact(a[1]) ? vs_fix(0) : vs_flonum(0), VS_OK;
    if (y < 0) return vs_fail(vm, vm->sym.divide, "0 has no negative power");
  }
  if (vs_is_ratio(a[1]) && vs_is_exact(a[0]) && vs_is_fixnum(vs_as_ratio(a[1])->den) &&
      vs_fixnum(vs_as_ratio(a[1])->den) < 100) {
    VS_ROOTS(vm, r, 3);
    int64_t k = vs_fixnum(vs_as_ratio(a[1])->den);
    r[0] = vs_is_ratio(a[0]) ? vs_as_ratio(a[0])->num : a[0];
    r[1] = vs_is_ratio(a[0]) ? vs_as_ratio(a[0])->den : vs_fix(1);
    if (!exact_root(vm, r[0], k, &r[2])) return VS_ERROR;
    r[0] = r[2];
    if (!exact_root(vm, r[1], k, &r[2])) return VS_ERROR;
    r[1] = r[2];
    if (r[0] != VS_FALSE && r[1] != VS_FALSE)
      return vs_number_ratio(vm, r[0], r[1], &r[0]) && exact_power(vm, r[0], vs_as_ratio(a[1])->num, out);
  }
  /* the exact base is outside the range of doubles: uses logarithms */
  if (vs_is_exact(a[0]) && (isinf(x) || (x == 0 && a[0] != vs_fix(0))) && isfinite(y)) {
    double l;
    if (!natural_log(vm, a, 0, &l)) return VS_ERROR;
    *out = vs_flonum(exp(l * y));
    return VS_OK;
  }
  *out = vs_flonum(pow(x, y));
  return VS_OK;
}

static const vs_native_def defs[] = {
    {"exp", "x", exp_, 0, NULL},
    {"log", "x [base]", log_, 0, "the natural logarithm, or that to base"},
    {"sin", "angle", sin_, 0, "of an angle in radians"},
    {"cos", "angle", cos_, 0, "of an angle in radians"},
    {"tan", "angle", tan_, 0, "of an angle in radians"},
    {"asin", "x", asin_, 0, NULL},
    {"acos", "x", acos_, 0, NULL},
    {"atan", "y [x]", atan_, 0, "the angle whose tangent is y, or the direction of the point x, y"},
    {"sinh", "x", sinh_, 0, NULL},
    {"cosh", "x", cosh_, 0, NULL},
    {"tanh", "x", tanh_, 0, NULL},
    {"hypot", "x y", hypot_, 0, NULL},
    {"sqrt", "x", sqrt_, 0, "exact where the root is"},
    {"cube-root", "x", cbrt_, 0, NULL},
    {"exact-integer-sqrt", "n", exact_integer_sqrt, 0, "two values: the root's integer part and the remainder"},
    {"expt", "base power", expt, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_math_natives = {"math", defs};
