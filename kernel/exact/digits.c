/* Computes the twelve significant digits of numbers.
 *
 * A double is m * 2^e. With d = 11 - floor(log10 x), its twelve digits are the integer nearest to m * 5^d * 2^(e + d);
 * ties go to the even integer, as in printf. For d from 0 to 27 the product fits into 128 bits, and the power of two is
 * a shift. Therefore the result is exact. The inverse is a division by a power of ten, which is exact up to 10^22.
 * Therefore the quotient is the double nearest to the decimal number. */
#include "kernel/exact/digits.h"

#include "model/assert.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FIVES = 27, MOST_TENS = 22 };

bool vs_digits(double size, uint64_t *digits, int *first) {
  static const uint64_t five[MOST_FIVES + 1] = {
    1,
    5,
    25,
    125,
    625,
    3125,
    15625,
    78125,
    390625,
    1953125,
    9765625,
    48828125,
    244140625,
    1220703125,
    6103515625,
    30517578125,
    152587890625,
    762939453125,
    3814697265625,
    19073486328125,
    95367431640625,
    476837158203125,
    2384185791015625,
    11920928955078125,
    59604644775390625,
    298023223876953125,
    1490116119384765625,
    7450580596923828125,
  };
  uint64_t bits;
  VS_ASSERT(size > 0);
  memcpy(&bits, &size, sizeof bits);
  int exponent = (int)(bits >> 52) - 1075;
  uint64_t mantissa = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
  int power = ((exponent + 52) * 315653) >>
              20; /* floor of log10(2^e), where 2^e is the greatest power of two that is at most x; it is floor(log10 x)
                   * or one less */
  for (int tries = 0; tries < 2; tries++, power++) {
    int d = VS_DIGITS - 1 - power;
    if (d < 0 || d > MOST_FIVES) return false; /* the table has no power of five for this exponent, or x is subnormal */
    __extension__ unsigned __int128 product = (unsigned __int128)mantissa * five[d], one = 1;
    int shift = -(exponent + d);
    uint64_t k;
    if (shift <= 0) {
      k = (uint64_t)product << -shift; /* the scaled number is at most 10^13, so it fits into 64 bits */
    } else {
      k = (uint64_t)(product >> shift);
      __extension__ unsigned __int128 rest = product & ((one << shift) - 1), half = one << (shift - 1);
      k += rest > half || (rest == half && k & 1);
    }
    *digits = k;
    *first = power;
    if (k < UINT64_C(1000000000000)) return true;
  }
  return false;
}

double vs_digits_rounded(double x) {
  static const double ten[MOST_TENS + 1] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                             1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
  double size = fabs(x);
  uint64_t digits;
  int first;
  if (!(size > 0) || !isfinite(size) || (size < 1e12 && (double)(int64_t)size == size)) return x;
  if (vs_digits(size, &digits, &first) && VS_DIGITS - 1 - first <= MOST_TENS && first < VS_DIGITS)
    return copysign((double)digits / ten[VS_DIGITS - 1 - first], x);
  char text[40];
  snprintf(text, sizeof text, "%.11e", x);
  return strtod(text, NULL);
}
