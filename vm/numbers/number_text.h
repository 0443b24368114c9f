/* Owns the interface of number_text.c: the texts of numbers. */
#ifndef VS_VM_NUMBERS_NUMBER_TEXT_H
#define VS_VM_NUMBERS_NUMBER_TEXT_H

#include "vm/numbers/number.h"

/* Sets *out to the number of these bytes in `radix` (2 to 36; #x and the like override it), #f if they are no number.
 * Returns false when memory is out or the number is too large. */
bool vs_number_parse(vs_scheme *vm, const char *s, size_t n, int radix, vs_value *out);
/* Appends the shortest text that reads back as v, in radix 2 to 36. */
bool vs_number_print(vs_scheme *vm, vs_value v, int radix, vs_text *t);
/* Writes the same for one double in base 10, zero-terminated, without allocation. Returns the length. */
size_t vs_double_text(double d, char out[VS_DOUBLE_TEXT]);

#endif
