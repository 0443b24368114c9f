/* Declares the rounding of numbers to the twelve significant digits with which they are written. */
#ifndef VS_KERNEL_EXACT_DIGITS_H
#define VS_KERNEL_EXACT_DIGITS_H

#include <stdbool.h>
#include <stdint.h>

enum { VS_DIGITS = 12 };

/* Computes the twelve significant digits of `size`, which is above 0, as one integer, rounded to nearest with ties to
 * even. *first: the power of ten of the first digit. Returns false outside of the range from about 10^-16 to 10^12,
 * where this is not exact. */
bool vs_digits(double size, uint64_t *digits, int *first);

/* Returns the double that results from writing x with twelve digits and reading it. */
double vs_digits_rounded(double x);

#endif
