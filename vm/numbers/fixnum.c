/* Implements the procedures of SRFI 143 on fixnums, the exact integers of 48 bits. An argument or a result that is no
 * fixnum is an error. */
#include "vm/machine/native.h"
#include "vm/values/gc.h"

/* Returns true if the n arguments are fixnums; otherwise sets the error. */
static bool want(vs_scheme *vm, const vs_value *a, int n) {
  VS_ASSERT(n >= 0);
  for (int i = 0; i < n; i++)
    if (!vs_is_fixnum(a[i])) return vs_fail_type(vm, i, "a fixnum, an exact integer of 48 bits", a[i]);
  return true;
}

/* Sets *out to the fixnum n, or sets the error that n has too many bits. */
static vs_status give(vs_scheme *vm, int64_t n, vs_value *out) {
  if (!vs_fits_fixnum(n)) return vs_fail(vm, vm->sym.error, "the result %lld has more than 48 bits", (long long)n);
  return *out = vs_fix(n), VS_OK;
}

/* ---- arithmetic ---- */

static vs_status add(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, vs_fixnum(a[0]) + vs_fixnum(a[1]), out);
}
static vs_status subtract(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, vs_fixnum(a[0]) - vs_fixnum(a[1]), out);
}
static vs_status product(vs_scheme *vm, int64_t x, int64_t y, vs_value *out) {
  int64_t n;
  VS_ASSERT(vs_fits_fixnum(x) && vs_fits_fixnum(y));
  if (__builtin_mul_overflow(x, y, &n))
    return vs_fail(vm, vm->sym.error, "the product of %lld and %lld has more than 48 bits", (long long)x, (long long)y);
  return give(vm, n, out);
}
static vs_status multiply(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && product(vm, vs_fixnum(a[0]), vs_fixnum(a[1]), out);
}
static vs_status square(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && product(vm, vs_fixnum(a[0]), vs_fixnum(a[0]), out);
}
static vs_status negate(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, -vs_fixnum(a[0]), out);
}
static vs_status absolute(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, vs_fixnum(a[0]) < 0 ? -vs_fixnum(a[0]) : vs_fixnum(a[0]), out);
}
static bool want_division(vs_scheme *vm, const vs_value *a) {
  return want(vm, a, 2) && (a[1] != vs_fix(0) || vs_fail_type(vm, 1, "a fixnum other than 0", a[1]));
}
static vs_status divide(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, want_division(vm, a) && give(vm, vs_fixnum(a[0]) / vs_fixnum(a[1]), out);
}
static vs_status rest(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, want_division(vm, a) && give(vm, vs_fixnum(a[0]) % vs_fixnum(a[1]), out);
}
/* Sets *out to the greatest argument for sign 1, and to the least for sign -1. */
static vs_status extreme(vs_scheme *vm, const vs_value *a, int n, int sign, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  *out = a[0];
  for (int i = 1; i < n; i++) if (sign * vs_fixnum(a[i]) > sign * vs_fixnum(*out)) *out = a[i];
  return VS_OK;
}
static vs_status greatest(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return extreme(vm, a, n, 1, out); }
static vs_status least(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return extreme(vm, a, n, -1, out); }

/* ---- predicates ---- */

static vs_status is_fixnum(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(vs_is_fixnum(a[0])), VS_OK;
}
#define TESTS(X) X(is_zero, x == 0) X(is_positive, x > 0) X(is_negative, x < 0) X(is_odd, x & 1) X(is_even, !(x & 1))
#define DEFINE_TEST(name, condition) \
  static vs_status name(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    if (!want(vm, a, n)) return VS_ERROR; \
    int64_t x = vs_fixnum(a[0]); \
    return *out = vs_bool(condition), VS_OK; \
  }
TESTS(DEFINE_TEST)
#define COMPARISONS(X) X(equal, ==) X(less, <) X(greater, >) X(at_most, <=) X(at_least, >=)
#define DEFINE_COMPARISON(name, operator) \
  static vs_status name(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    bool holds = true; \
    if (!want(vm, a, n)) return VS_ERROR; \
    for (int i = 0; i + 1 < n; i++) holds = holds && vs_fixnum(a[i]) operator vs_fixnum(a[i + 1]); \
    return *out = vs_bool(holds), VS_OK; \
  }
COMPARISONS(DEFINE_COMPARISON)

/* ---- bits ---- */

static vs_status complement(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, ~vs_fixnum(a[0]), out);
}
#define COMBINATIONS(X) X(both_bits, &, -1) X(any_bits, |, 0) X(other_bits, ^, 0)
#define DEFINE_COMBINATION(name, operator, first) \
  static vs_status name(vs_scheme *vm, vs_value *a, int n, vs_value *out) { \
    int64_t bits = first; \
    if (!want(vm, a, n)) return VS_ERROR; \
    for (int i = 0; i < n; i++) bits = bits operator vs_fixnum(a[i]); \
    return give(vm, bits, out); \
  }
COMBINATIONS(DEFINE_COMBINATION)

/* Shifts to the left, or for a negative count to the right. */
static vs_status shifted(vs_scheme *vm, int64_t x, int64_t left, vs_value *out) {
  VS_ASSERT(left > -48 && left < 48);
  if (left <= 0) return give(vm, x >> -left, out);
  int64_t n;
  if (__builtin_mul_overflow(x, INT64_C(1) << left, &n))
    return vs_fail(vm, vm->sym.error, "the result has more than 48 bits");
  return give(vm, n, out);
}
static vs_status shift(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t left;
  return want(vm, a, n) && vs_arg_index(vm, a, 1, -47, 47, &left) && shifted(vm, vs_fixnum(a[0]), left, out);
}
static vs_status shift_left(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t left;
  return want(vm, a, n) && vs_arg_index(vm, a, 1, 0, 47, &left) && shifted(vm, vs_fixnum(a[0]), left, out);
}
static vs_status shift_right(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  int64_t right;
  return want(vm, a, n) && vs_arg_index(vm, a, 1, 0, 47, &right) && shifted(vm, vs_fixnum(a[0]), -right, out);
}
/* Returns x for x >= 0, and its complement otherwise: the bits that differ from the sign. */
static uint64_t unsigned_bits(int64_t x) { return (uint64_t)(x < 0 ? ~x : x); }
static vs_status bit_count(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return want(vm, a, n) && give(vm, __builtin_popcountll(unsigned_bits(vs_fixnum(a[0]))), out);
}
static vs_status length(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!want(vm, a, n)) return VS_ERROR;
  uint64_t bits = unsigned_bits(vs_fixnum(a[0]));
  return give(vm, bits ? 64 - __builtin_clzll(bits) : 0, out);
}

/* The names are visible only through the library that exports them: each begins with %. */
static const vs_native_def defs[] = {
    {"%fixnum?", "x", is_fixnum, 0, NULL},
    {"%fx+", "i j", add, 0, NULL},
    {"%fx-", "i j", subtract, 0, NULL},
    {"%fx*", "i j", multiply, 0, NULL},
    {"%fxneg", "i", negate, 0, NULL},
    {"%fxabs", "i", absolute, 0, NULL},
    {"%fxsquare", "i", square, 0, NULL},
    {"%fxquotient", "i j", divide, 0, NULL},
    {"%fxremainder", "i j", rest, 0, NULL},
    {"%fxmax", "i . fixnums", greatest, 0, NULL},
    {"%fxmin", "i . fixnums", least, 0, NULL},
    {"%fxzero?", "i", is_zero, 0, NULL},
    {"%fxpositive?", "i", is_positive, 0, NULL},
    {"%fxnegative?", "i", is_negative, 0, NULL},
    {"%fxodd?", "i", is_odd, 0, NULL},
    {"%fxeven?", "i", is_even, 0, NULL},
    {"%fx=?", ". fixnums", equal, 0, NULL},
    {"%fx<?", ". fixnums", less, 0, NULL},
    {"%fx>?", ". fixnums", greater, 0, NULL},
    {"%fx<=?", ". fixnums", at_most, 0, NULL},
    {"%fx>=?", ". fixnums", at_least, 0, NULL},
    {"%fxnot", "i", complement, 0, NULL},
    {"%fxand", ". fixnums", both_bits, 0, NULL},
    {"%fxior", ". fixnums", any_bits, 0, NULL},
    {"%fxxor", ". fixnums", other_bits, 0, NULL},
    {"%fxarithmetic-shift", "i count", shift, 0, NULL},
    {"%fxarithmetic-shift-left", "i count", shift_left, 0, NULL},
    {"%fxarithmetic-shift-right", "i count", shift_right, 0, NULL},
    {"%fxbit-count", "i", bit_count, 0, NULL},
    {"%fxlength", "i", length, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_fixnum_natives = {"fixnum", defs};
