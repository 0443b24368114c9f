/* Declares the rounding of numbers to the twelve significant digits with which they are written. */
#ifndef VS_KERNEL_EXACT_DIGITS_H
#define VS_KERNEL_EXACT_DIGITS_H

#include <stdbool.h>
#include <stdint.h>

enum { VS_DIGITS = 12 };

/* Computes the twelve significant digits of `size` as one integer, rounded to nearest with ties to even. *first: the
 * power of ten of the first digit. size > 0. Returns false if size is outside of the range in which this is exact, from
 * about 10^-16 to 10^12. */
bool vs_digits(double size, uint64_t *digits, int *first);

/* Returns the double that results from writing x with twelve digits and reading it. */
double vs_digits_rounded(double x);

#endif
