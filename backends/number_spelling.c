/* Implements the text of numbers in all formats: %.12g without trailing zeros, plus signs and leading zeros of the
 * exponent. The decimal sign is a point in every locale. kernel/exact/digits.h computes the digits; whole numbers below
 * 10^12 are written directly. Numbers above 10^12 and below 10^-16 are written by printf. */
#include "backends/number_spelling.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/writer.h"
#include "kernel/exact/digits.h"

enum { DIGITS = VS_DIGITS };

static const char pairs[] =
  "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
  "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";

/* Writes the last `count` decimal digits of k so that they end before `end`. */
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
  for (uint64_t power = 100000; k >= power; power *= 10) count++; /* k is below 10^12, so the loop ends */
  number_digits(to + count, k, count);
  return to + count;
}

static char *number_scaled(char *to, uint64_t k, int first) {
  char digits[DIGITS];
  int count = DIGITS;
  number_digits(digits + DIGITS, k, DIGITS);
  while (count > 1 && digits[count - 1] == '0') count--;
  if (first >= 0) { /* writes the remaining digits, of which there are fewer than 12 */
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

/* Writes x with the C library's printf, for numbers that are too large or too small for the fast method. */
static char *number_printed(char *to, double x) {
  char text[64];
  int length = snprintf(text, sizeof text, "%.12g", x);
  bool point = false;
  for (int i = 0; i < length; i++) {
    char c = text[i];
    if (c == 'e') { /* writes the exponent without plus sign and leading zeros */
      *to++ = c;
      i++;
      if (text[i] == '-') *to++ = '-';
      while (i + 1 < length && (text[i] == '-' || text[i] == '+' || text[i] == '0')) i++;
      i--;
    } else if ((c >= '0' && c <= '9') || c == '-') {
      *to++ = c;
    } else if (!point) {
      *to++ = '.'; /* replaces the locale's decimal sign, which may have several bytes */
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
  if (!vs_digits(size, &digits, &first)) return number_printed(to, x);
  if (x < 0) *to++ = '-';
  return number_scaled(to, digits, first);
}

size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]) {
  char *end = vs_number_write(out, x);
  *end = '\0';
  return (size_t)(end - out);
}
