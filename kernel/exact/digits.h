/* Declares the twelve significant digits in which numbers are written. */
#ifndef VS_KERNEL_EXACT_DIGITS_H
#define VS_KERNEL_EXACT_DIGITS_H

#include <stdbool.h>
#include <stdint.h>

enum { VS_DIGITS = 12 };

/* Computes the digits of size > 0 as one number of twelve, rounded to nearest, ties to even; *first is the power of ten
 * of the first digit. Returns false if size is outside the range in which this is exact, from about 10^-16 to 10^12. */
bool vs_digits(double size, uint64_t *digits, int *first);

/* Returns the double that a reader gets if x is written with twelve digits. */
double vs_digits_rounded(double x);

#endif
