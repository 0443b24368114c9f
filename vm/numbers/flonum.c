/* Implements the procedures of SRFI 144 that need the C library or an operator of C: flonums, the numbers of 64 bits
 * with a point. Each takes only flonums. A result that is no real number is +nan.0, and never an error. */
#define _XOPEN_SOURCE 700 /* declares jn and yn */
#include <math.h>

#include "vm/machine/native.h"
#include "vm/numbers/integer.h"
#include "vm/numbers/number.h"

/* Returns true if the n arguments are flonums; otherwise sets the error. */
static bool want(vs_scheme *vm, const vs_value *a, int n) {
  VS_ASSERT(n >= 0);
  for (int i = 0; i < n; i++) if (!vs_is_double(a[i])) return vs_fail_type(vm, i, "a flonum such as 2.0", a[i]);
  return true;
}

/* ---- functions of one flonum, and of two ---- */

static double sign_of(double x) { return copysign(1, x); }
static double square(double x) { return x * x; }
static double difference(double x, double y) { return fabs(x - y); }
/* Returns x / y without its fraction. The quotient of x / y alone may round up to an integer. */
static double whole_quotient(double x, double y) {
  double rest = fmod(x, y);
  return isfinite(rest) && y != 0 ? nearbyint((x - rest) / y) : trunc(x / y);
}

#define OF_ONE(X) \
  X("flabs", fabs) X("flfloor", floor) X("flceiling", ceil) X("flround", nearbyint) X("fltruncate", trunc) \
  X("flsgn", sign_of) X("flsquare", square) X("flsqrt", sqrt) X("flcbrt", vs_cube_root) X("flexp", exp) \
  X("flexp2", exp2) X("flexp-1", expm1) X("fllog", log) X("fllog1+", log1p) X("fllog2", log2) X("fllog10", log10) \
  X("flsin", sin) X("flcos", cos) X("fltan", tan) X("flasin", asin) X("flacos", acos) X("flsinh", sinh) \
  X("flcosh", cosh) X("fltanh", tanh) X("flasinh", asinh) X("flacosh", acosh) X("flatanh", atanh) \
  X("flexponent", logb) X("flgamma", tgamma) X("flerf", erf) X("flerfc", erfc)
#define OF_TWO(X) \
  X("fladjacent", nextafter) X("flcopysign", copysign) X("flabsdiff", difference) X("flposdiff", fdim) \
  X("flhypot", hypot) X("flexpt", pow) X("flquotient", whole_quotient) X("flremainder", fmod)

#define DEFINE_OF_ONE(name, f) \
  static vs_status fl_##f(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    return want(vm, a, n) && (*out = vs_flonum(f(vs_double(a[0]))), true); \
  }
#define DEFINE_OF_TWO(name, f) \
  static vs_status fl_##f(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    return want(vm, a, n) && (*out = vs_flonum(f(vs_double(a[0]), vs_double(a[1]))), true); \
  }
OF_ONE(DEFINE_OF_ONE)
OF_TWO(DEFINE_OF_TWO)

/* ---- sums, products, comparisons ---- */

static double sum(double x, double y) { return x + y; }
static double product(double x, double y) { return x * y; }
static double minus(double x, double y) { return x - y; }
static double quotient(double x, double y) { return x / y; }

/* Computes f over the arguments, beginning with `first`. */
static vs_status fold(vs_scheme *vm, const vs_value *a, int n, double (*f)(double, double), double first,
                      vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  for (int i = 0; i < n; i++) first = f(first, vs_double(a[i]));
  return *out = vs_flonum(first), VS_OK;
}
static vs_status fl_sum(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return fold(vm, a, n, sum, -0.0, out); }
static vs_status fl_product(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return fold(vm, a, n, product, 1, out);
}
static vs_status fl_max(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return fold(vm, a, n, fmax, -INFINITY, out);
}
static vs_status fl_min(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return fold(vm, a, n, fmin, INFINITY, out);
}
static vs_status fl_minus(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  if (n == 1) return *out = vs_flonum(-vs_double(a[0])), VS_OK;
  return fold(vm, a + 1, n - 1, minus, vs_double(a[0]), out);
}
static vs_status fl_quotient(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  if (n == 1) return *out = vs_flonum(1 / vs_double(a[0])), VS_OK;
  return fold(vm, a + 1, n - 1, quotient, vs_double(a[0]), out);
}

#define COMPARISONS(X) X(equal, ==) X(less, <) X(greater, >) X(at_most, <=) X(at_least, >=)
#define DEFINE_COMPARISON(name, operator) \
  static vs_status fl_##name(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    bool holds = true; \
    if (!want(vm, a, n)) return VS_ERROR; \
    for (int i = 0; i + 1 < n; i++) holds = holds && vs_double(a[i]) operator vs_double(a[i + 1]); \
    return *out = vs_bool(holds), VS_OK; \
  }
COMPARISONS(DEFINE_COMPARISON)

static vs_status fl_fma(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && (*out = vs_flonum(fma(vs_double(a[0]), vs_double(a[1]), vs_double(a[2]))), true);
}
static vs_status fl_atan(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  *out = vs_flonum(n == 1 ? atan(vs_double(a[0])) : atan2(vs_double(a[0]), vs_double(a[1])));
  return VS_OK;
}

/* ---- parts of flonums ---- */

static vs_status is_flonum(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_is_double(a[0])), VS_OK;
}
static vs_status sign_bit(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && (*out = vs_fix(signbit(vs_double(a[0])) != 0), true);
}
static vs_status is_normal(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && (*out = vs_bool(isnormal(vs_double(a[0]))), true);
}
static vs_status is_subnormal(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && (*out = vs_bool(fpclassify(vs_double(a[0])) == FP_SUBNORMAL), true);
}
/* Returns x 2^n. Beyond 5000 the result is 0 or infinite. */
static vs_status make_flonum(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, 1)) return VS_ERROR;
  (void)n;
  if (!vs_is_exact_integer(a[1])) return vs_fail_type(vm, 1, "an exact integer", a[1]);
  int64_t power = vs_is_fixnum(a[1]) ? vs_fixnum(a[1]) : vs_int_sign(a[1]) * INT64_C(5000);
  power = power > 5000 ? 5000 : power < -5000 ? -5000 : power;
  *out = vs_flonum(ldexp(vs_double(a[0]), (int)power));
  return VS_OK;
}
static vs_status integer_exponent(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && (*out = vs_fix(ilogb(vs_double(a[0]))), true);
}
static vs_status integer_fraction(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  double whole, fraction;
  if (!want(vm, a, n)) return VS_ERROR;
  fraction = modf(vs_double(a[0]), &whole);
  vs_value both[2] = {vs_flonum(whole), vs_flonum(fraction)};
  return vs_several(vm, both, 2, out);
}
static vs_status fraction_exponent(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int power = 0;
  if (!want(vm, a, n)) return VS_ERROR;
  double fraction = frexp(vs_double(a[0]), &power);
  vs_value both[2] = {vs_flonum(fraction), vs_fix(isfinite(fraction) ? power : 0)};
  return vs_several(vm, both, 2, out);
}
static vs_status rounded_remainder(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int low = 0;
  if (!want(vm, a, n)) return VS_ERROR;
  double rest = remquo(vs_double(a[0]), vs_double(a[1]), &low);
  vs_value both[2] = {vs_flonum(rest), vs_fix(isnan(rest) ? 0 : low)};
  return vs_several(vm, both, 2, out);
}

/* ---- special functions ---- */

/* Returns log |gamma(x)| and the sign of gamma(x), which alternates between the negative integers. */
static vs_status log_gamma(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  double x = vs_double(a[0]);
  bool negative = x < 0 ? fmod(floor(x), 2) != 0 : x == 0 && signbit(x);
  vs_value both[2] = {vs_flonum(lgamma(x)), vs_flonum(negative ? -1 : 1)};
  return vs_several(vm, both, 2, out);
}
static vs_status bessel(vs_scheme *vm, vs_value *a, double (*f)(int, double), vs_value *out) {
  int64_t order;
  if (!vs_arg_index(vm, a, 0, -1000000, 1000000, &order)) return VS_ERROR;
  if (!vs_is_double(a[1])) return vs_fail_type(vm, 1, "a flonum such as 2.0", a[1]);
  return *out = vs_flonum(f((int)order, vs_double(a[1]))), VS_OK;
}
static vs_status first_bessel(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, bessel(vm, a, jn, out);
}
static vs_status second_bessel(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, bessel(vm, a, yn, out);
}

/* The names are visible only through the library that exports them: each begins with %. */
static const vs_native_def defs[] = {
#define ROW_OF_ONE(name, f) {"%" name, "x", fl_##f, 0, NULL},
#define ROW_OF_TWO(name, f) {"%" name, "x y", fl_##f, 0, NULL},
    OF_ONE(ROW_OF_ONE) OF_TWO(ROW_OF_TWO)
    {"%flonum?", "x", is_flonum, 0, NULL},
    {"%fl+", ". numbers", fl_sum, 0, NULL},
    {"%fl*", ". numbers", fl_product, 0, NULL},
    {"%fl-", "x . numbers", fl_minus, 0, NULL},
    {"%fl/", "x . numbers", fl_quotient, 0, NULL},
    {"%flmax", ". numbers", fl_max, 0, NULL},
    {"%flmin", ". numbers", fl_min, 0, NULL},
    {"%fl=?", "x y . numbers", fl_equal, 0, NULL},
    {"%fl<?", "x y . numbers", fl_less, 0, NULL},
    {"%fl>?", "x y . numbers", fl_greater, 0, NULL},
    {"%fl<=?", "x y . numbers", fl_at_most, 0, NULL},
    {"%fl>=?", "x y . numbers", fl_at_least, 0, NULL},
    {"%fl+*", "x y z", fl_fma, 0, NULL},
    {"%flatan", "y [x]", fl_atan, 0, NULL},
    {"%flsign-bit", "x", sign_bit, 0, NULL},
    {"%flnormalized?", "x", is_normal, 0, NULL},
    {"%fldenormalized?", "x", is_subnormal, 0, NULL},
    {"%make-flonum", "x power", make_flonum, 0, NULL},
    {"%flinteger-exponent", "x", integer_exponent, 0, NULL},
    {"%flinteger-fraction", "x", integer_fraction, 0, NULL},
    {"%flnormalized-fraction-exponent", "x", fraction_exponent, 0, NULL},
    {"%flremquo", "x y", rounded_remainder, 0, NULL},
    {"%flloggamma", "x", log_gamma, 0, NULL},
    {"%flfirst-bessel", "order x", first_bessel, 0, NULL},
    {"%flsecond-bessel", "order x", second_bessel, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_flonum_natives = {"flonum", defs};
