/* Implements the procedures of arithmetic: predicates, + - * /, comparison, integer division, parts of numbers,
 * rounding, bits, texts. */
#include <math.h>

#include "vm/machine/fail.h"
#include "vm/numbers/dual.h"
#include "vm/numbers/integer.h"
#include "vm/numbers/number_text.h"
#include "vm/values/string_chars.h"

/* ---- checking arguments ---- */

/* Returns true if a[i] is a number or a dual number (a number with a derivative), for which each procedure below also
 * defines its result. Otherwise returns false with the error set. */
static bool want_number(vs_scheme *vm, const vs_value *a, int i) {
  return vs_is_scalar(a[i]) || vs_fail_type(vm, i, "a number", a[i]);
}

static bool want_plain(vs_scheme *vm, const vs_value *a, int i) {
  return vs_is_number(a[i]) || vs_fail_type(vm, i, "a number", a[i]);
}

static bool is_integral(vs_value v) {
  return vs_is_exact_integer(v) || (vs_is_double(v) && isfinite(vs_double(v)) && vs_double(v) == floor(vs_double(v)));
}
static bool want_integer(vs_scheme *vm, const vs_value *a, int i) {
  return is_integral(a[i]) || vs_fail_type(vm, i, "an integer", a[i]);
}
static bool want_exact_integer(vs_scheme *vm, const vs_value *a, int i) {
  return vs_is_exact_integer(a[i]) || vs_fail_type(vm, i, "an exact integer", a[i]);
}

/* ---- predicates ---- */

#define PREDICATE(name, expression)                                        \
  static vs_status name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {       \
    (void)vm, (void)n;                                                     \
    vs_value v = vs_dual_base(a[0]);                                       \
    return *out = vs_bool(expression), VS_OK;                              \
  }
/* Predicates whose argument must be a number. */
#define NUMBER_PREDICATE(name, expression)                                 \
  static vs_status name(vs_scheme *vm, vs_value *a, int n, vs_value *out) {       \
    (void)n;                                                               \
    vs_value v = vs_dual_base(a[0]);                                       \
    return want_number(vm, a, 0) ? (*out = vs_bool(expression), VS_OK) : VS_ERROR; \
  }
static int sign_of(vs_value v) {          /* returns -1, 0 or 1; 0 for NaN */
  if (vs_is_double(v)) return (vs_double(v) > 0) - (vs_double(v) < 0);
  return vs_int_sign(vs_is_ratio(v) ? vs_as_ratio(v)->num : v);
}

PREDICATE(is_number, vs_is_number(v))
PREDICATE(is_rational, vs_is_exact(v) || (vs_is_double(v) && isfinite(vs_double(v))))
PREDICATE(is_integer, is_integral(v))
PREDICATE(is_exact_integer, vs_is_exact_integer(v))
PREDICATE(is_exact_rational, vs_is_exact(v))
PREDICATE(is_natural, vs_is_exact_integer(v) && vs_int_sign(v) >= 0)
PREDICATE(is_flonum, vs_is_double(v))
PREDICATE(is_fixnum, vs_is_fixnum(v))
NUMBER_PREDICATE(is_exact, vs_is_exact(v))
NUMBER_PREDICATE(is_inexact, vs_is_double(v))
NUMBER_PREDICATE(is_zero, v == vs_fix(0) || (vs_is_double(v) && vs_double(v) == 0))
NUMBER_PREDICATE(is_positive, sign_of(v) > 0)
NUMBER_PREDICATE(is_negative, sign_of(v) < 0)
NUMBER_PREDICATE(is_nan, vs_is_double(v) && vs_double(v) != vs_double(v))
NUMBER_PREDICATE(is_finite, !vs_is_double(v) || isfinite(vs_double(v)))
NUMBER_PREDICATE(is_infinite, vs_is_double(v) && isinf(vs_double(v)))

static bool odd(vs_value v) { return vs_is_double(v) ? fmod(vs_double(v), 2) != 0 : vs_int_is_odd(v); }
static vs_status is_odd(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_integer(vm, a, 0) ? (*out = vs_bool(odd(a[0])), VS_OK) : VS_ERROR;
}
static vs_status is_even(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_integer(vm, a, 0) ? (*out = vs_bool(!odd(a[0])), VS_OK) : VS_ERROR;
}

/* ---- + - * / ---- */

static bool want_addable(vs_scheme *vm, vs_value v) {
  vs_value ignored;
  /* If the value is no number, vs_number_add sets the error and returns false. */
  return vs_is_number(v) || vs_is(v, VS_T_FLAT) || vs_is_dual(v) || vs_number_add(vm, v, vs_fix(0), &ignored);
}

static vs_status add(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n == 0) return *out = vs_fix(0), VS_OK;
  if (!want_addable(vm, a[0])) return VS_ERROR;
  *out = a[0];
  for (int i = 1; i < n; i++)
    if (!vs_number_add(vm, *out, a[i], out) || !vs_poll_turn(vm, (uint64_t)i, 16)) return VS_ERROR;
  return VS_OK;
}

static vs_status mul(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n == 0) return *out = vs_fix(1), VS_OK;
  if (!want_addable(vm, a[0])) return VS_ERROR;
  *out = a[0];
  for (int i = 1; i < n; i++)
    if (!vs_number_mul(vm, *out, a[i], out) || !vs_poll_turn(vm, (uint64_t)i, 16)) return VS_ERROR;
  return VS_OK;
}

static vs_status sub(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n == 1) {
    if (vs_flat_callable(vm, a, 1)) return vm->flat->call(vm, "-", a, 1, out);
    /* (- x) is not computed as 0 - x, since the result for 0.0 would be +0 instead of -0. */
    if (vs_is_double(a[0])) return *out = vs_flonum(-vs_double(a[0])), VS_OK;
    return vs_number_sub(vm, vs_fix(0), a[0], out);
  }
  *out = a[0];
  for (int i = 1; i < n; i++)
    if (!vs_number_sub(vm, *out, a[i], out) || !vs_poll_turn(vm, (uint64_t)i, 16)) return VS_ERROR;
  return VS_OK;
}

static vs_status divide(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n == 1) return vs_number_div(vm, vs_fix(1), a[0], out);
  *out = a[0];
  for (int i = 1; i < n; i++)
    if (!vs_number_div(vm, *out, a[i], out) || !vs_poll_turn(vm, (uint64_t)i, 16)) return VS_ERROR;
  return VS_OK;
}

static vs_status add_one(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_number_add(vm, a[0], vs_fix(1), out);
}
static vs_status sub_one(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_number_sub(vm, a[0], vs_fix(1), out);
}
static vs_status square(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_flat_callable(vm, a, 1)) return vm->flat->call(vm, "square", a, 1, out);
  return want_number(vm, a, 0) && vs_number_mul(vm, a[0], a[0], out);
}
static vs_status absolute(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_flat_callable(vm, a, 1)) return vm->flat->call(vm, "abs", a, 1, out);
  return want_number(vm, a, 0) && vs_number_abs(vm, a[0], out);
}
static vs_status sign(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!want_number(vm, a, 0)) return VS_ERROR;
  int s = sign_of(vs_dual_base(a[0]));
  if (vs_is_dual(a[0])) return *out = vs_fix(s), VS_OK;
  *out = vs_is_double(a[0]) ? (s ? vs_flonum(s) : a[0]) : vs_fix(s);
  return VS_OK;
}

/* ---- comparison; every argument is checked, even after a false result ---- */

static vs_status compare(vs_scheme *vm, vs_relation relation, const vs_value *a, int n, vs_value *out) {
  bool all = true, one;
  if (n == 1 && !vs_number_test(vm, relation, a[0], a[0], &one)) return VS_ERROR;
  for (int i = 0; i + 1 < n; i++) {
    if (!vs_number_test(vm, relation, a[i], a[i + 1], &one) || !vs_poll_turn(vm, (uint64_t)i, 8)) return VS_ERROR;
    all = all && one;
  }
  *out = vs_bool(all);
  return VS_OK;
}
static vs_status less(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return compare(vm, VS_LT, a, n, out); }
static vs_status at_most(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return compare(vm, VS_LE, a, n, out); }
static vs_status equal(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return compare(vm, VS_EQ, a, n, out); }
static vs_status at_least(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return compare(vm, VS_GE, a, n, out); }
static vs_status greater(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return compare(vm, VS_GT, a, n, out); }

/* Returns the maximum or minimum. It is inexact if any argument is inexact, and NaN if any argument is NaN. */
static vs_status extreme(vs_scheme *vm, vs_relation better, vs_value *a, int n, vs_value *out) {
  bool inexact = false, take;
  int best = 0;
  for (int i = 0; i < n; i++) {
    if (!want_number(vm, a, i)) return VS_ERROR;
    inexact = inexact || vs_is_double(a[i]);
    if (vs_is_double(a[i]) && vs_double(a[i]) != vs_double(a[i])) return *out = a[i], VS_OK;
    if (!vs_number_test(vm, better, a[i], a[best], &take) || !vs_poll_turn(vm, (uint64_t)i, 8)) return VS_ERROR;
    if (take) best = i;
  }
  double d = 0;
  if (!inexact || vs_is_dual(a[best])) return *out = a[best], VS_OK;
  return vs_number_double(vm, a[best], &d) ? (*out = vs_flonum(d), VS_OK) : VS_ERROR;
}
static vs_status max(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return extreme(vm, VS_GT, a, n, out); }
static vs_status min(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return extreme(vm, VS_LT, a, n, out); }

/* ---- integer division ---- */

static vs_status quotient(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_number_quotient(vm, a[0], a[1], out);
}
static vs_status remainder_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_number_remainder(vm, a[0], a[1], out);
}
static vs_status modulo(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return vs_number_modulo(vm, a[0], a[1], out);
}
/* Sets *out to the quotient rounded down, computed as (x - (x modulo y)) / y. */
static vs_status floor_quotient(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  return vs_number_modulo(vm, a[0], a[1], &r[0]) && vs_number_sub(vm, a[0], r[0], &r[0]) &&
         vs_number_quotient(vm, r[0], a[1], out);
}
static vs_status floor_both(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  return floor_quotient(vm, a, n, &r[0]) && vs_number_modulo(vm, a[0], a[1], &r[1]) ? vs_several(vm, r, 2, out)
                                                                                    : VS_ERROR;
}
static vs_status truncate_both(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 2);
  return vs_number_quotient(vm, a[0], a[1], &r[0]) && vs_number_remainder(vm, a[0], a[1], &r[1])
             ? vs_several(vm, r, 2, out)
             : VS_ERROR;
}

static bool gcd2(vs_scheme *vm, vs_value x, vs_value y, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = x, r[1] = y;
  bool inexact = vs_is_double(x) || vs_is_double(y);
  if (!vs_number_exact(vm, r[0], &r[0]) || !vs_number_exact(vm, r[1], &r[1]) || !vs_int_gcd(vm, r[0], r[1], &r[0]))
    return false;
  *out = inexact ? vs_flonum(vs_int_double(r[0])) : r[0];
  return true;
}

static vs_status gcd(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  *out = vs_fix(0);
  for (int i = 0; i < n; i++)
    if (!want_integer(vm, a, i) || !gcd2(vm, *out, a[i], out)) return VS_ERROR;
  return VS_OK;
}

static vs_status lcm(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  bool zero;
  *out = vs_fix(1);
  for (int i = 0; i < n; i++) {
    if (!want_integer(vm, a, i) || !vs_number_is_zero(vm, a[i], &zero)) return VS_ERROR;
    if (zero) {
      *out = a[i];
      for (int j = i + 1; j < n; j++)
        if (!want_integer(vm, a, j)) return VS_ERROR;
      return VS_OK;
    }
    if (!gcd2(vm, *out, a[i], &r[0]) || !vs_number_quotient(vm, a[i], r[0], &r[0]) ||
        !vs_number_mul(vm, *out, r[0], out) || !vs_number_abs(vm, *out, out))
      return VS_ERROR;
  }
  return VS_OK;
}

/* ---- parts of numbers, and rounding ---- */

static vs_status part(vs_scheme *vm, vs_value *a, bool denominator, vs_value *out) {
  if (!vs_is_exact(a[0]) && !(vs_is_double(a[0]) && isfinite(vs_double(a[0]))))
    return vs_fail_type(vm, 0, "a rational number", a[0]);
  VS_ROOTS(vm, r, 1);
  if (!vs_number_exact(vm, a[0], &r[0])) return VS_ERROR;
  r[0] = !vs_is_ratio(r[0]) ? (denominator ? vs_fix(1) : r[0])
         : denominator      ? vs_as_ratio(r[0])->den
                            : vs_as_ratio(r[0])->num;
  *out = vs_is_double(a[0]) ? vs_flonum(vs_int_double(r[0])) : r[0];
  return VS_OK;
}
static vs_status numerator(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return part(vm, a, false, out);
}
static vs_status denominator(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return part(vm, a, true, out);
}

typedef enum { TO_FLOOR, TO_CEILING, TO_ZERO, TO_NEAREST } rounding;

/* Rounds the ratio r[0] to an integer. r is an array of 4 roots of the garbage collector. */
static bool round_ratio(vs_scheme *vm, rounding how, vs_value *r, vs_value *out) {
  r[1] = vs_as_ratio(r[0])->num, r[2] = vs_as_ratio(r[0])->den;
  bool negative = vs_int_sign(r[1]) < 0;
  /* Rounds to nearest: floor((2 num + den) / (2 den)). If den = 2, the ratio is half-way between two integers: an odd
   * result is corrected to the even neighbour. */
  if (how == TO_NEAREST) {
    bool tie = r[2] == vs_fix(2);
    if (!vs_int_add(vm, r[1], r[1], &r[1]) || !vs_int_add(vm, r[1], r[2], &r[1]) ||
        !vs_int_add(vm, r[2], r[2], &r[2]) || !vs_int_divide(vm, r[1], r[2], &r[1], &r[3]) ||
        (vs_int_sign(r[3]) < 0 && !vs_int_sub(vm, r[1], vs_fix(1), &r[1])))
      return false;
    return tie && vs_int_is_odd(r[1]) ? vs_int_sub(vm, r[1], vs_fix(1), out) : (*out = r[1], true);
  }
  if (!vs_int_divide(vm, r[1], r[2], &r[1], NULL)) return false;
  if (how == TO_FLOOR && negative) return vs_int_sub(vm, r[1], vs_fix(1), out);
  if (how == TO_CEILING && !negative) return vs_int_add(vm, r[1], vs_fix(1), out);
  *out = r[1];
  return true;
}

static bool round_number(vs_scheme *vm, rounding how, const vs_value *a, vs_value *out) {
  if (!want_number(vm, a, 0)) return false;
  if (vs_is_dual(a[0])) { /* the rounded value is constant between its jumps, so the derivative is 0 */
    vs_value base = vs_dual_base(a[0]);
    return round_number(vm, how, &base, out);
  }
  if (vs_is_double(a[0])) {
    double d = vs_double(a[0]);
    *out = vs_flonum(how == TO_FLOOR ? floor(d) : how == TO_CEILING ? ceil(d) : how == TO_ZERO ? trunc(d) : rint(d));
    return true;
  }
  if (!vs_is_ratio(a[0])) return *out = a[0], true;
  VS_ROOTS(vm, r, 4);
  r[0] = a[0];
  return round_ratio(vm, how, r, out);
}
static vs_status floor_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, round_number(vm, TO_FLOOR, a, out);
}
static vs_status ceiling(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, round_number(vm, TO_CEILING, a, out);
}
static vs_status truncate_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, round_number(vm, TO_ZERO, a, out);
}
static vs_status round_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, round_number(vm, TO_NEAREST, a, out);
}
static vs_status exact_floor(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return floor_(vm, a, n, out) && vs_number_exact(vm, *out, out);
}
static vs_status exact_ceiling(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return ceiling(vm, a, n, out) && vs_number_exact(vm, *out, out);
}
static vs_status exact_truncate(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return truncate_(vm, a, n, out) && vs_number_exact(vm, *out, out);
}
static vs_status exact_round(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return round_(vm, a, n, out) && vs_number_exact(vm, *out, out);
}

static vs_status exact(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_plain(vm, a, 0) && vs_number_exact(vm, a[0], out);
}
static vs_status inexact(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  double d;
  if (!want_number(vm, a, 0)) return VS_ERROR;
  if (vs_is_dual(a[0])) return vs_number_mul(vm, vs_flonum(1), a[0], out);
  if (!vs_number_double(vm, a[0], &d)) return VS_ERROR;
  *out = vs_flonum(d);
  return VS_OK;
}

/* ---- bit operations ---- */

static vs_status bitwise(vs_scheme *vm, char op, int64_t start, vs_value *a, int n, vs_value *out) {
  *out = vs_fix(start);
  for (int i = 0; i < n; i++)
    if (!want_exact_integer(vm, a, i) || !vs_int_bitwise(vm, op, *out, a[i], out)) return VS_ERROR;
  return VS_OK;
}
static vs_status bitwise_and(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return bitwise(vm, '&', -1, a, n, out);
}
static vs_status bitwise_or(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return bitwise(vm, '|', 0, a, n, out); }
static vs_status bitwise_xor(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return bitwise(vm, '^', 0, a, n, out);
}
static vs_status bitwise_not(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_exact_integer(vm, a, 0) && vs_int_sub(vm, vs_fix(-1), a[0], out);
}
static vs_status arithmetic_shift(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t left;
  return want_exact_integer(vm, a, 0) && vs_arg_index(vm, a, 1, -INT64_C(1000000000), INT64_C(1000000000), &left) &&
         vs_int_shift(vm, a[0], left, out);
}
static vs_status integer_length(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!want_exact_integer(vm, a, 0)) return VS_ERROR;
  VS_ROOTS(vm, r, 1);
  r[0] = a[0];
  if (vs_int_sign(a[0]) < 0 && !vs_int_sub(vm, vs_fix(-1), a[0], &r[0])) return VS_ERROR;
  return vs_int_from_uint64(vm, vs_int_bits(r[0]), out);
}

/* ---- numbers as texts ---- */

static vs_status number_to_string(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t radix = 10;
  if (!want_plain(vm, a, 0) || (n > 1 && !vs_arg_index(vm, a, 1, 2, 36, &radix))) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_number_print(vm, a[0], (int)radix, &t) && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

static vs_status string_to_number(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t radix = 10;
  if (!vs_arg_type(vm, a, 0, VS_T_STRING) || (n > 1 && !vs_arg_index(vm, a, 1, 2, 36, &radix))) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_text_string(&t, a[0]) && vs_number_parse(vm, t.at ? t.at : "", t.count, (int)radix, out);
  vs_text_close(&t);
  return ok;
}

static const vs_native_def defs[] = {
    {"number? complex? real?", "x", is_number, 0, NULL},
    {"rational?", "x", is_rational, 0, NULL},
    {"integer?", "x", is_integer, 0, NULL},
    {"exact-integer?", "x", is_exact_integer, 0, NULL},
    {"exact-rational?", "x", is_exact_rational, 0, NULL},
    {"exact-nonnegative-integer? natural?", "x", is_natural, 0, NULL},
    {"flonum?", "x", is_flonum, 0, NULL},
    {"fixnum?", "x", is_fixnum, 0, NULL},
    {"exact?", "x", is_exact, 0, NULL},
    {"inexact?", "x", is_inexact, 0, NULL},
    {"zero?", "x", is_zero, 0, NULL},
    {"positive?", "x", is_positive, 0, NULL},
    {"negative?", "x", is_negative, 0, NULL},
    {"nan?", "x", is_nan, 0, NULL},
    {"finite?", "x", is_finite, 0, NULL},
    {"infinite?", "x", is_infinite, 0, NULL},
    {"odd?", "n", is_odd, 0, NULL},
    {"even?", "n", is_even, 0, NULL},
    {"+", ". numbers", add, 0, "the sum; also of points and gvectors"},
    {"*", ". numbers", mul, 0, "the product"},
    {"-", "x . numbers", sub, 0, "x less the others; of one argument its negative"},
    {"/", "x . numbers", divide, 0, "x divided by the others; of one argument its inverse"},
    {"1+ add1", "x", add_one, 0, NULL},
    {"-1+ 1- sub1", "x", sub_one, 0, NULL},
    {"square sqr", "x", square, 0, NULL},
    {"abs magnitude", "x", absolute, 0, NULL},
    {"sgn signum", "x", sign, 0, "-1, 0 or 1"},
    {"<", "x . numbers", less, 0, NULL},
    {"<=", "x . numbers", at_most, 0, NULL},
    {"=", "x . numbers", equal, 0, NULL},
    {">=", "x . numbers", at_least, 0, NULL},
    {">", "x . numbers", greater, 0, NULL},
    {"max", "x . numbers", max, 0, NULL},
    {"min", "x . numbers", min, 0, NULL},
    {"quotient truncate-quotient", "n m", quotient, 0, NULL},
    {"remainder truncate-remainder", "n m", remainder_, 0, NULL},
    {"modulo floor-remainder", "n m", modulo, 0, NULL},
    {"floor-quotient", "n m", floor_quotient, 0, NULL},
    {"floor/", "n m", floor_both, 0, "two values: floor-quotient and floor-remainder"},
    {"truncate/", "n m", truncate_both, 0, "two values: truncate-quotient and truncate-remainder"},
    {"gcd", ". integers", gcd, 0, NULL},
    {"lcm", ". integers", lcm, 0, NULL},
    {"numerator", "q", numerator, 0, NULL},
    {"denominator", "q", denominator, 0, NULL},
    {"floor", "x", floor_, 0, NULL},
    {"ceiling", "x", ceiling, 0, NULL},
    {"truncate", "x", truncate_, 0, NULL},
    {"round", "x", round_, 0, "to the nearest integer, halves to the even one"},
    {"exact-floor floor->exact", "x", exact_floor, 0, NULL},
    {"exact-ceiling ceiling->exact", "x", exact_ceiling, 0, NULL},
    {"exact-truncate truncate->exact", "x", exact_truncate, 0, NULL},
    {"exact-round round->exact", "x", exact_round, 0, NULL},
    {"exact inexact->exact", "x", exact, 0, NULL},
    {"inexact exact->inexact real->double-flonum", "x", inexact, 0, NULL},
    {"bitwise-and", ". integers", bitwise_and, 0, NULL},
    {"bitwise-or bitwise-ior", ". integers", bitwise_or, 0, NULL},
    {"bitwise-xor", ". integers", bitwise_xor, 0, NULL},
    {"bitwise-not", "n", bitwise_not, 0, NULL},
    {"arithmetic-shift", "n left", arithmetic_shift, 0, NULL},
    {"integer-length", "n", integer_length, 0, NULL},
    {"number->string", "number [radix]", number_to_string, 0, NULL},
    {"string->number", "string [radix]", string_to_number, 0, "the number that string spells, or #f"},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_arithmetic_natives = {"arithmetic", defs};
