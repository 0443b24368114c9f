/* Converts numbers to and from text: doubles in every radix, exact numbers, and the syntax of R7RS.
 *
 * Doubles are written by Burger and Dybvig's free-format algorithm: the shortest digits that are read as the same
 * double, and among equally short ones the nearest. It uses integers of at most about 20 limbs on the C stack. Two
 * faster methods are tried first, for integers and for decimals of up to 15 digits. Reading uses Clinger's fast path: a
 * mantissa and a power of ten that are both exact doubles round only once. All other numbers are read as an exact
 * ratio, which is rounded to the nearest double. */
#include "vm/numbers/number_text.h"

#include <float.h>
#include <math.h>

#include "vm/numbers/integer.h"

#include "vm/numbers/number.h"

/* ---- the digits of a double ---- */

enum { BIG_LIMBS = 40, MAX_DIGITS = 1100 /* MAX_DIGITS: greatest number of digits of a double, reached in base 2 */ };
typedef struct { mp_limb_t at[BIG_LIMBS]; mp_size_t n; } big;       /* n: number of limbs in use, without leading
                                                                     * zeros */

static void big_set(big *b, uint64_t v) {
  b->at[0] = v;
  b->n = v != 0;
}

static void big_shift(big *b, unsigned bits) {
  mp_size_t limbs = (mp_size_t)(bits / 64);
  if (b->n == 0) return;
  if (limbs) {
    mpn_copyd(b->at + limbs, b->at, b->n);
    mpn_zero(b->at, limbs);
    b->n += limbs;
  }
  if (bits % 64) {
    mp_limb_t high = mpn_lshift(b->at, b->at, b->n, bits % 64);
    if (high) b->at[b->n++] = high;
  }
}

static void big_times(big *b, unsigned factor) {
  if (b->n == 0) return;
  mp_limb_t high = mpn_mul_1(b->at, b->at, b->n, factor);
  if (high) b->at[b->n++] = high;
}

static void big_power(big *b, unsigned radix, int k) {
  unsigned chunk = radix, in_chunk = 1;
  while (chunk <= UINT32_MAX / radix / 36) chunk *= radix, in_chunk++;
  for (; k >= (int)in_chunk; k -= (int)in_chunk) big_times(b, chunk);
  for (; k > 0; k--) big_times(b, radix);
}

static int big_compare(const big *a, const big *b) {
  if (a->n != b->n) return a->n > b->n ? 1 : -1;
  return a->n ? mpn_cmp(a->at, b->at, a->n) : 0;
}

/* Returns a number below 0, 0 or above 0 if a + b is less than, equal to or greater than c. */
static int big_compare_sum(const big *a, const big *b, const big *c) {
  big sum;
  const big *x = a->n >= b->n ? a : b, *y = a->n >= b->n ? b : a;
  sum.n = x->n;
  if (y->n) {
    mp_limb_t carry = mpn_add(sum.at, x->at, x->n, y->at, y->n);
    if (carry) sum.at[sum.n++] = carry;
  } else {
    mpn_copyi(sum.at, x->at, x->n);
  }
  return big_compare(&sum, c);
}

/* Divides a by b, by repeated subtraction, fewer than 37 times. a becomes the remainder. Returns the quotient. */
static unsigned big_divide(big *a, const big *b) {
  unsigned q = 0;
  while (big_compare(a, b) >= 0) {
    mpn_sub(a->at, a->at, a->n, b->at, b->n);
    while (a->n && a->at[a->n - 1] == 0) a->n--;
    q++;
  }
  return q;
}

/* Writes the digits D1, D2 ... (values, not characters) of d = 0.D1D2... * radix^*point. d is finite and above 0.
 * Returns the number of digits. */
static int double_digits(double d, unsigned radix, unsigned char *digits, int *point) {
  int e;
  uint64_t f = (uint64_t)ldexp(frexp(d, &e), DBL_MANT_DIG);
  VS_ASSERT(d > 0 && isfinite(d));
  e -= DBL_MANT_DIG;
  if (e < DBL_MIN_EXP - DBL_MANT_DIG) {                  /* a subnormal double has fewer significant bits */
    f >>= DBL_MIN_EXP - DBL_MANT_DIG - e;
    e = DBL_MIN_EXP - DBL_MANT_DIG;
  }
  bool even = !(f & 1), edge = f == UINT64_C(1) << (DBL_MANT_DIG - 1) && e > DBL_MIN_EXP - DBL_MANT_DIG;
  /* d = r / s. The midpoints between d and its neighbours are (r - low) / s and (r + high) / s. */
  big r, s, low, high;
  big_set(&r, f), big_set(&s, 1), big_set(&low, 1), big_set(&high, 1);
  unsigned extra = edge ? 2 : 1;
  big_shift(&r, extra + (e > 0 ? (unsigned)e : 0));
  big_shift(&s, extra + (e < 0 ? (unsigned)-e : 0));
  big_shift(&low, e > 0 ? (unsigned)e : 0);
  big_shift(&high, (edge ? 1 : 0) + (e > 0 ? (unsigned)e : 0));
  int k = (int)ceil(log(d) / log(radix) - 1e-10);
  if (k >= 0) {
    big_power(&s, radix, k);
  } else {
    big_power(&r, radix, -k), big_power(&low, radix, -k), big_power(&high, radix, -k);
  }
  int order = big_compare_sum(&r, &high, &s);
  if (even ? order >= 0 : order > 0) {
    k++;
  } else {
    big_times(&r, radix), big_times(&low, radix), big_times(&high, radix);
  }
  *point = k;
  for (int n = 0;;) {
    unsigned digit = big_divide(&r, &s);
    int below = big_compare(&r, &low), above = big_compare_sum(&r, &high, &s);
    bool can_stop = even ? below <= 0 : below < 0, can_raise = even ? above >= 0 : above > 0;
    if (can_stop || can_raise) {
      if (can_stop && can_raise) {
        int half = big_compare_sum(&r, &r, &s);
        can_raise = half > 0 || (half == 0 && (digit & 1));
      }
      digits[n++] = (unsigned char)(digit + can_raise);
      return n;
    }
    digits[n++] = (unsigned char)digit;
    big_times(&r, radix), big_times(&low, radix), big_times(&high, radix);
  }
}

/* Writes the digits of d in base 10, as double_digits does, with a fast path for short decimals. */
static int decimal_digits(double d, unsigned char *digits, int *point) {
  static const double ten[] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};
  VS_ASSERT(d > 0 && isfinite(d));
  if (d < 1e15 && d >= 1e-4) {
    for (int k = 0; k < 8; k++) {
      double scaled = d * ten[k];
      if (scaled >= 1e15) break;
      /* m / 10^k rounds to d, and m has at most 15 digits: the digits of m are the shortest text of d. */
      if (scaled != floor(scaled) || scaled / ten[k] != d) continue;
      unsigned char reversed[20] = {0};
      int n = 0, count = 0, skip = 0;
      for (uint64_t m = (uint64_t)scaled; m; m /= 10) reversed[n++] = (unsigned char)(m % 10);
      while (skip < n - 1 && reversed[skip] == 0) skip++;
      for (int i = n; i-- > skip;) digits[count++] = reversed[i];
      *point = n - k;
      return count;
    }
  }
  return double_digits(d, 10, digits, point);
}

size_t vs_double_text(double d, char out[VS_DOUBLE_TEXT]) {
  char *p = out;
  if (d != d) return memcpy(out, "+nan.0", 7), 6;
  if (isinf(d)) return memcpy(out, d > 0 ? "+inf.0" : "-inf.0", 7), 6;
  if (signbit(d)) *p++ = '-';
  d = fabs(d);
  if (d == 0) {
    memcpy(p, "0.0", 4);
    return (size_t)(p - out) + 3;
  }
  unsigned char digits[VS_DOUBLE_TEXT] = {0};
  int point, n = decimal_digits(d, digits, &point);
  if (point > 21 || point < -5) {                       /* writes a double with an exponent: d.ddde+x */
    *p++ = (char)('0' + digits[0]);
    if (n > 1) *p++ = '.';
    for (int i = 1; i < n; i++) *p++ = (char)('0' + digits[i]);
    *p++ = 'e';
    int e = point - 1;
    if (e < 0) *p++ = '-', e = -e;
    if (e >= 100) *p++ = (char)('0' + e / 100);
    if (e >= 10) *p++ = (char)('0' + e / 10 % 10);
    *p++ = (char)('0' + e % 10);
  } else {
    if (point <= 0) *p++ = '0';
    for (int i = 0; i < point; i++) *p++ = (char)('0' + (i < n ? digits[i] : 0));
    *p++ = '.';
    for (int i = point; i < 0; i++) *p++ = '0';
    for (int i = point > 0 ? point : 0; i < n; i++) *p++ = (char)('0' + digits[i]);
    if (n <= point) *p++ = '0';
  }
  *p = 0;
  return (size_t)(p - out);
}

static bool double_print(double d, int radix, vs_text *t) {
  if (radix == 10 || !isfinite(d) || d == 0) {
    char s[VS_DOUBLE_TEXT];
    return vs_text_put(t, s, vs_double_text(d, s));
  }
  /* A number in another radix is written without an exponent, whose letter e would be a digit. */
  static const char name[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  unsigned char digits[MAX_DIGITS];
  int point, n = double_digits(fabs(d), (unsigned)radix, digits, &point);
  bool ok = (d > 0 || vs_text_put(t, "-", 1)) && (point > 0 || vs_text_put(t, "0", 1));
  for (int i = 0; ok && i < point; i++) ok = vs_text_put(t, &name[i < n ? digits[i] : 0], 1);
  ok = ok && vs_text_put(t, ".", 1);
  for (int i = point; ok && i < 0; i++) ok = vs_text_put(t, "0", 1);
  for (int i = point > 0 ? point : 0; ok && i < n; i++) ok = vs_text_put(t, &name[digits[i]], 1);
  return ok && (n > point || vs_text_put(t, "0", 1));
}

bool vs_number_print(vs_scheme *vm, vs_value v, int radix, vs_text *t) {
  VS_ASSERT(radix >= 2 && radix <= 36);
  if (vs_is_double(v)) return double_print(vs_double(v), radix, t);
  if (!vs_is_ratio(v)) return vs_int_print(vm, v, radix, t);
  VS_ROOTS(vm, r, 1);
  r[0] = v;
  return vs_int_print(vm, vs_as_ratio(v)->num, radix, t) && vs_text_put(t, "/", 1) &&
         vs_int_print(vm, vs_as_ratio(r[0])->den, radix, t);
}

/* ---- reading numbers ---- */

static int digit_value(char c, int radix) {
  int v = c >= '0' && c <= '9'   ? c - '0'
          : c >= 'a' && c <= 'z' ? c - 'a' + 10
          : c >= 'A' && c <= 'Z' ? c - 'A' + 10
                                 : 99;
  return v < radix ? v : -1;
}

static bool is_letter(char c, char lower) { return c == lower || c == lower - 'a' + 'A'; }

typedef struct scan {
  vs_scheme *vm;
  const char *s, *end;
  int radix;
  char exactness;            /* exactness: 'e' after the prefix #e, 'i' after #i, or 0 */
  bool negative;
} scan;

static const char *scan_digits(const scan *in, const char *p) {
  while (p < in->end && digit_value(*p, in->radix) >= 0) p++;
  return p;
}

static bool integer_of(const scan *in, const char *from, const char *to, vs_value *out) {
  size_t n = (size_t)(to - from);
  if (n <= 12) {
    int64_t v = 0;
    for (; from < to; from++) v = v * in->radix + digit_value(*from, in->radix);
    return vs_int_from_int64(in->vm, v, out);
  }
  unsigned char *digits = vs_mem(in->vm, NULL, 0, n);
  if (!digits) return vs_fail_memory(in->vm);
  for (size_t i = 0; i < n; i++) digits[i] = (unsigned char)digit_value(from[i], in->radix);
  bool ok = vs_int_from_digits(in->vm, digits, n, in->radix, false, out);
  vs_mem(in->vm, digits, n, 0);
  return ok;
}

static bool finish_exact(const scan *in, vs_value v, vs_value *out) {
  VS_ROOTS(in->vm, r, 1);
  r[0] = v;
  if (in->exactness == 'i') {
    double d;
    if (!vs_number_double(in->vm, r[0], &d)) return false;
    *out = vs_flonum(in->negative ? -d : d);
    return true;
  }
  return in->negative ? vs_number_sub(in->vm, vs_fix(0), r[0], out) : (*out = r[0], true);
}

/* Sets *out to the number whose mantissa has the n digits (values, not characters), times radix^exponent. It is a
 * double, or an exact number after the prefix #e. */
static bool scaled_number(const scan *in, const unsigned char *digits, size_t n, int64_t exponent, vs_value *out) {
  vs_scheme *vm = in->vm;
  while (n && digits[0] == 0) digits++, n--;
  while (n && digits[n - 1] == 0) n--, exponent++;
  bool exact = in->exactness == 'e';
  if (n == 0) return *out = exact ? vs_fix(0) : vs_flonum(in->negative ? -0.0 : 0.0), true;
  if (!exact) {
    static const double ten[] = { 1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
    if (in->radix == 10 && n <= 15 && exponent >= -22 && exponent <= 22) {
      double d = 0;
      for (size_t i = 0; i < n; i++) d = d * 10 + digits[i];
      d = exponent < 0 ? d / ten[-exponent] : d * ten[exponent];
      return *out = vs_flonum(in->negative ? -d : d), true;
    }
    double log_value = ((double)n + (double)exponent) * log2(in->radix);
    if (log_value > 1100 || log_value < -1200)
      return *out = vs_flonum((in->negative ? -1 : 1) * (log_value > 0 ? HUGE_VAL : 0.0)), true;
  } else if (exponent > 1000000 || exponent < -1000000) {
    return vs_fail(vm, vm->sym.range, "the exponent of an exact number is too large");
  }
  /* After the first KEEP digits, the others affect the result only if they are not all 0. A single digit replaces
   * them. */
  enum { KEEP = 1200 };
  unsigned char kept[KEEP + 1];
  if (!exact && n > KEEP) {
    memcpy(kept, digits, KEEP);
    kept[KEEP] = 1;
    exponent += (int64_t)(n - KEEP - 1);
    n = KEEP + 1;
    digits = kept;
  }
  VS_ROOTS(vm, r, 2);
  if (!vs_int_from_digits(vm, digits, n, in->radix, false, &r[0]) ||
      !vs_int_power(vm, vs_fix(in->radix), (uint64_t)(exponent < 0 ? -exponent : exponent), &r[1]))
    return false;
  if (exact)
    return (exponent < 0 ? vs_number_ratio(vm, r[0], r[1], &r[0]) : vs_int_mul(vm, r[0], r[1], &r[0])) &&
           finish_exact(in, r[0], out);
  double d;
  if (exponent < 0) {
    if (!vs_int_ratio_double(vm, r[0], r[1], &d)) return false;
  } else {
    if (!vs_int_mul(vm, r[0], r[1], &r[0])) return false;
    d = vs_int_double(r[0]);
  }
  *out = vs_flonum(in->negative ? -d : d);
  return true;
}

static bool scan_decimal(const scan *in, const char *p, vs_value *out) {
  const char *whole = p, *point = NULL;
  size_t n = 0;
  for (; p < in->end; p++) {
    if (*p == '.' && !point) point = p;
    else if (digit_value(*p, in->radix) >= 0) n++;
    else break;
  }
  const char *digits_end = p;
  if (n == 0) return true;
  int64_t exponent = 0;
  if (p < in->end) {
    if (in->radix != 10 ||
        !(is_letter(*p, 'e') || is_letter(*p, 's') || is_letter(*p, 'f') || is_letter(*p, 'd') || is_letter(*p, 'l')))
      return true;
    p++;
    bool minus = p < in->end && *p == '-';
    if (p < in->end && (*p == '-' || *p == '+')) p++;
    if (p == in->end) return true;
    for (; p < in->end; p++) {
      if (*p < '0' || *p > '9') return true;
      if (exponent < INT64_C(1000000000000)) exponent = exponent * 10 + (*p - '0');
    }
    if (minus) exponent = -exponent;
  } else if (!point) {
    return true;                                  /* the text is no plain integer, which was tried before */
  }
  unsigned char small[64], *digits = n <= sizeof small ? small : vs_mem(in->vm, NULL, 0, n);
  if (!digits) return vs_fail_memory(in->vm);
  size_t i = 0;
  for (p = whole; p < digits_end; p++)
    if (*p != '.') digits[i++] = (unsigned char)digit_value(*p, in->radix);
  if (point) exponent -= digits_end - point - 1;
  bool ok = scaled_number(in, digits, n, exponent, out);
  if (digits != small) vs_mem(in->vm, digits, n, 0);
  return ok;
}

static bool equals(const char *p, const char *end, const char *lower) {
  size_t n = strlen(lower);
  if ((size_t)(end - p) != n) return false;
  for (size_t i = 0; i < n; i++)
    if ((p[i] | (p[i] >= 'A' && p[i] <= 'Z' ? 0x20 : 0)) != lower[i]) return false;
  return true;
}

bool vs_number_parse(vs_scheme *vm, const char *s, size_t n, int radix, vs_value *out) {
  VS_ASSERT(radix >= 2 && radix <= 36);
  /* accepts 3+0i as the number 3, since its imaginary part is an exact 0; there are no other complex numbers */
  if (n > 3 && is_letter(s[n - 1], 'i') && s[n - 2] == '0' && (s[n - 3] == '+' || s[n - 3] == '-') &&
      !is_letter(s[n - 4], 'e') && s[n - 4] != '#')
    n -= 3;
  scan in = {.vm = vm, .s = s, .end = s + n, .radix = radix};
  bool radix_given = false;
  *out = VS_FALSE;
  for (; in.end - s >= 2 && s[0] == '#'; s += 2) {
    char c = (char)(s[1] >= 'A' && s[1] <= 'Z' ? s[1] + 32 : s[1]);
    if ((c == 'e' || c == 'i') && !in.exactness) in.exactness = c;
    else if (!radix_given && (c == 'x' || c == 'd' || c == 'o' || c == 'b'))
      in.radix = c == 'x' ? 16 : c == 'd' ? 10 : c == 'o' ? 8 : 2, radix_given = true;
    else return true;
  }
  const char *p = s;
  if (p == in.end) return true;
  bool sign = *p == '+' || *p == '-';
  if (sign) in.negative = *p++ == '-';
  if (p == in.end) return true;
  if (sign && (equals(p, in.end, "inf.0") || equals(p, in.end, "nan.0"))) {
    bool inf = *p == 'i' || *p == 'I';
    if (in.exactness == 'e') return true;
    *out = vs_flonum(!inf ? NAN : in.negative ? -HUGE_VAL : HUGE_VAL);
    return true;
  }
  const char *stop = scan_digits(&in, p);
  VS_ROOTS(vm, r, 2);
  if (stop == in.end && stop > p) return integer_of(&in, p, stop, &r[0]) && finish_exact(&in, r[0], out);
  if (stop > p && stop < in.end && *stop == '/') {
    const char *den = stop + 1, *den_end = scan_digits(&in, den);
    if (den_end == den || den_end != in.end) return true;
    if (!integer_of(&in, p, stop, &r[0]) || !integer_of(&in, den, den_end, &r[1])) return false;
    if (r[1] == vs_fix(0)) return true;
    return vs_number_ratio(vm, r[0], r[1], &r[0]) && finish_exact(&in, r[0], out);
  }
  return scan_decimal(&in, p, out);
}
