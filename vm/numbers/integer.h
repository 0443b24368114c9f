/* Owns exact integers of any size: fixnums and bignums, with GMP's mpn_ functions on limbs in our own heap. The size of
 * a result is known before the work, so a limit is an error before memory is requested. Arguments are exact integers;
 * the caller has checked. */
#ifndef VS_VM_NUMBERS_INTEGER_H
#define VS_VM_NUMBERS_INTEGER_H

#include <gmp.h>

#include "vm/values/text.h"

enum { VS_INT_MAX_LIMBS = 1 << 21 };     /* 40 million decimal digits: one multiplication of that size takes about a
                                          * second */

/* Magnitude and sign of an integer, without allocation. Bignums move, so call vs_int_look again after every allocation.
 * Do not copy a view: it may point into itself. */
typedef struct vs_int_view { const mp_limb_t *at; mp_size_t n; bool negative; mp_limb_t small; } vs_int_view;
/* Gets the view of v, an exact integer. */
void vs_int_look(vs_value v, vs_int_view *w);

bool vs_int_from_int64(vs_scheme *vm, int64_t n, vs_value *out);
bool vs_int_from_uint64(vs_scheme *vm, uint64_t n, vs_value *out);
bool vs_int_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
/* truncates; b is not 0; either result may be NULL */
bool vs_int_divide(vs_scheme *vm, vs_value a, vs_value b, vs_value *quotient, vs_value *remainder);
bool vs_int_gcd(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_shift(vs_scheme *vm, vs_value a, int64_t left, vs_value *out);             /* to the right: rounds down */
bool vs_int_power(vs_scheme *vm, vs_value a, uint64_t n, vs_value *out);
bool vs_int_sqrt(vs_scheme *vm, vs_value a, vs_value *root, vs_value *rest);           /* a >= 0 */
bool vs_int_negate(vs_scheme *vm, vs_value a, vs_value *out);
bool vs_int_bitwise(vs_scheme *vm, char op /* & | ^ */, vs_value a, vs_value b, vs_value *out);
int vs_int_compare(vs_value a, vs_value b);
int vs_int_sign(vs_value a);
bool vs_int_is_odd(vs_value a);
uint64_t vs_int_bits(vs_value a);                                                /* of the magnitude; 0 for 0 */

/* Prints a in radix 2 to 36, in lower case. */
bool vs_int_print(vs_scheme *vm, vs_value a, int radix, vs_text *t);
/* The digits are values 0..radix-1, not characters. The radix is 2 to 36. */
bool vs_int_from_digits(vs_scheme *vm, const unsigned char *digits, size_t n, int radix, bool negative, vs_value *out);

/* correctly rounded; may be infinite */
double vs_int_double(vs_value a);
/* Computes num/den, both positive, correctly rounded. */
bool vs_int_ratio_double(vs_scheme *vm, vs_value num, vs_value den, double *out);
/* Sets *out to the integer that equals d, a finite integral double. */
bool vs_int_from_double(vs_scheme *vm, double d, vs_value *out);

#endif
