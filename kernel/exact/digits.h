/* Owns the twelve significant digits that numbers are written with. */
#ifndef VS_KERNEL_EXACT_DIGITS_H
#define VS_KERNEL_EXACT_DIGITS_H

#include <stdbool.h>
#include <stdint.h>

enum { VS_DIGITS = 12 };

/* The digits of size > 0 as one number of twelve, rounded to nearest, ties to even; and the power of ten of the first.
 * False: size is not in the range from about 10^-16 to 10^12 that this is exact in. */
bool vs_digits(double size, uint64_t *digits, int *first);

/* The double that is read where x was written with twelve digits. */
double vs_digits_rounded(double x);

#endif
