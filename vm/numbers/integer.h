/* Declares exact integers of any size: fixnums and bignums. The limbs (64-bit digits) of a bignum are in the
 * interpreter's heap, and GMP's mpn_ functions compute them. The size of a result is known in advance, so that a result
 * beyond the limit is an error before memory is requested. The caller must have checked that arguments are exact
 * integers. */
#ifndef VS_VM_NUMBERS_INTEGER_H
#define VS_VM_NUMBERS_INTEGER_H

#include <gmp.h>

#include "vm/values/text.h"

enum { VS_INT_MAX_LIMBS = 1 << 21 };     /* greatest size of an integer in limbs of 64 bits: 40 million decimal digits,
                                          * whose multiplication takes about a second */

/* A view: magnitude and sign of an integer, found without allocation. Bignums move, so vs_int_look must be called again
 * after every allocation. A view must not be copied, since `at` may point to its member `small`. */
typedef struct vs_int_view { const mp_limb_t *at; mp_size_t n; bool negative; mp_limb_t small; } vs_int_view;
/* Sets *w to the view of v, an exact integer. */
void vs_int_look(vs_value v, vs_int_view *w);

bool vs_int_from_int64(vs_scheme *vm, int64_t n, vs_value *out);
bool vs_int_to_int64(vs_value a, int64_t *out); /* Returns false for an exact integer beyond 64 bits. */
bool vs_int_from_uint64(vs_scheme *vm, uint64_t n, vs_value *out);
bool vs_int_add(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_sub(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_mul(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
/* Divides a by b, rounding the quotient towards 0. b is not 0. quotient or remainder may be NULL. */
bool vs_int_divide(vs_scheme *vm, vs_value a, vs_value b, vs_value *quotient, vs_value *remainder);
bool vs_int_gcd(vs_scheme *vm, vs_value a, vs_value b, vs_value *out);
bool vs_int_shift(vs_scheme *vm, vs_value a, int64_t left, vs_value *out);             /* a negative `left` shifts to
                                                                                        * the right and rounds down */
bool vs_int_power(vs_scheme *vm, vs_value a, uint64_t n, vs_value *out);
bool vs_int_sqrt(vs_scheme *vm, vs_value a, vs_value *root, vs_value *rest);           /* root: the square root of a,
                                                                                        * rounded down; rest: a - root *
                                                                                        * root; a must be 0 or more */
bool vs_int_negate(vs_scheme *vm, vs_value a, vs_value *out);
bool vs_int_bitwise(vs_scheme *vm, char op /* the operation: '&', '|' or '^' */, vs_value a, vs_value b, vs_value *out);
int vs_int_compare(vs_value a, vs_value b);
int vs_int_sign(vs_value a);
bool vs_int_is_odd(vs_value a);
uint64_t vs_int_bits(vs_value a);                                                /* returns the number of bits of |a|; 0
                                                                                  * for 0 */

/* Appends the integer a to t in radix 2 to 36, with lower-case letters. */
bool vs_int_print(vs_scheme *vm, vs_value a, int radix, vs_text *t);
/* Sets *out to the integer with the n digits, the highest first. Digits are values 0..radix-1, not characters. The
 * radix is 2 to 36. */
bool vs_int_from_digits(vs_scheme *vm, const unsigned char *digits, size_t n, int radix, bool negative, vs_value *out);

/* Returns the double nearest to a, which may be infinite. */
double vs_int_double(vs_value a);
/* Sets *out to the double nearest to num/den. num and den are positive. */
bool vs_int_ratio_double(vs_scheme *vm, vs_value num, vs_value den, double *out);
/* Sets *out to the exact integer that equals d. d must be finite and a whole number. */
bool vs_int_from_double(vs_scheme *vm, double d, vs_value *out);

#endif
