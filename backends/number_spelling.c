/* Owns the one spelling of numbers: what %.12g says, without its trailing zeros, plus signs and exponents' zeros; a point whatever the locale.
 *
 * A double is m * 2^e. With d = 11 - floor(log10 x) its twelve digits are the integer nearest to m * 5^d * 2^(e + d), ties to even as printf
 * has them: for d from 0 to 27 the product fits 128 bits and the rest is a shift, so this is exact. Whole numbers below 10^12 are their own
 * digits. The others, above 10^12 and below 10^-16, go through printf. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/writer.h"

enum { DIGITS = 12, MOST_FIVES = 27 };

static const char pairs[] =
  "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
  "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";

/* The last `count` digits of k end before `end`. */
static void number_digits(char *end, uint64_t k, int count) {
  for (; count > 1; count -= 2, k /= 100) memcpy(end -= 2, pairs + 2 * (k % 100), 2);
  if (count > 0) end[-1] = (char)('0' + k % 10);
}

static char *number_whole(char *to, uint64_t k) {
  int count = 5;
  if (k < 10) {
    *to++ = (char)('0' + k);
    return to;
  }
  if (k < 10000) {
    count = k < 100 ? 2 : k < 1000 ? 3 : 4;
    unsigned low = (unsigned)k % 100, high = (unsigned)k / 100;
    if (count > 2) memcpy(to, count == 3 ? pairs + 2 * high + 1 : pairs + 2 * high, 2);
    memcpy(to + count - 2, pairs + 2 * low, 2);
    return to + count;
  }
  for (uint64_t power = 100000; k >= power; power *= 10) count++; /* k < 10^12 */
  number_digits(to + count, k, count);
  return to + count;
}

/* The twelve digits of size > 0, which is no whole number, and the power of ten of the first. False: not in this range. */
static bool number_round(double size, uint64_t *digits, int *first) {
  static const uint64_t five[MOST_FIVES + 1] = {
    1, 5, 25, 125, 625, 3125, 15625, 78125, 390625, 1953125, 9765625, 48828125, 244140625, 1220703125, 6103515625, 30517578125, 152587890625,
    762939453125, 3814697265625, 19073486328125, 95367431640625, 476837158203125, 2384185791015625, 11920928955078125, 59604644775390625,
    298023223876953125, 1490116119384765625, 7450580596923828125,
  };
  uint64_t bits;
  memcpy(&bits, &size, sizeof bits);
  int exponent = (int)(bits >> 52) - 1075;
  uint64_t mantissa = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
  int power = ((exponent + 52) * 315653) >> 20; /* floor of log10 of the power of two below: right, or one less than it should be */
  for (int tries = 0; tries < 2; tries++, power++) {
    int d = DIGITS - 1 - power;
    if (d < 0 || d > MOST_FIVES) return false; /* what is below the normal numbers too */
    __extension__ unsigned __int128 product = (unsigned __int128)mantissa * five[d], one = 1;
    int shift = -(exponent + d);
    uint64_t k;
    if (shift <= 0) {
      k = (uint64_t)product << -shift; /* at most 10^13 */
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

static char *number_scaled(char *to, uint64_t k, int first) {
  char digits[DIGITS];
  int count = DIGITS;
  number_digits(digits + DIGITS, k, DIGITS);
  while (count > 1 && digits[count - 1] == '0') count--;
  if (first >= 0) { /* below 12 */
    memcpy(to, digits, DIGITS);
    if (count <= first + 1) return to + first + 1;
    to += first + 1;
    *to++ = '.';
    memcpy(to, digits + first + 1, (size_t)(DIGITS - first - 1));
    return to + count - first - 1;
  }
  if (first >= -4) {
    memcpy(to, "0.000", 5);
    to += 1 - first;
    memcpy(to, digits, DIGITS);
    return to + count;
  }
  *to++ = digits[0];
  if (count > 1) {
    *to++ = '.';
    memcpy(to, digits + 1, DIGITS - 1);
    to += count - 1;
  }
  *to++ = 'e';
  *to++ = '-';
  return number_whole(to, (uint64_t)-first);
}

/* By the C library. */
static char *number_printed(char *to, double x) {
  char text[64];
  int length = snprintf(text, sizeof text, "%.12g", x);
  bool point = false;
  for (int i = 0; i < length; i++) {
    char c = text[i];
    if (c == 'e') { /* the exponent without plus sign and leading zeros */
      *to++ = c;
      i++;
      if (text[i] == '-') *to++ = '-';
      while (i + 1 < length && (text[i] == '-' || text[i] == '+' || text[i] == '0')) i++;
      i--;
    } else if ((c >= '0' && c <= '9') || c == '-') {
      *to++ = c;
    } else if (!point) {
      *to++ = '.'; /* whatever the locale's sign is, however many bytes */
      point = true;
    }
  }
  return to;
}

char *vs_number_write(char *to, double x) {
  double size = fabs(x);
  uint64_t digits;
  int first;
  if (!(size > 0) || !isfinite(size)) {
    *to++ = '0';
    return to;
  }
  if (size < 1e12 && (double)(int64_t)size == size) {
    if (x < 0) *to++ = '-';
    return number_whole(to, (uint64_t)size);
  }
  if (!number_round(size, &digits, &first)) return number_printed(to, x);
  if (x < 0) *to++ = '-';
  return number_scaled(to, digits, first);
}

size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]) {
  char *end = vs_number_write(out, x);
  *end = '\0';
  return (size_t)(end - out);
}
