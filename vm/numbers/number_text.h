/* Declares the conversion between numbers and text, implemented in number_text.c. */
#ifndef VS_VM_NUMBERS_NUMBER_TEXT_H
#define VS_VM_NUMBERS_NUMBER_TEXT_H

#include "vm/numbers/number.h"

/* Sets *out to the number that the n bytes represent in `radix` (2 to 36), or to #f if they represent none. Prefixes
 * such as #x override the radix. Returns false when memory is out or the number is too large. */
bool vs_number_parse(vs_scheme *vm, const char *s, size_t n, int radix, vs_value *out);
/* Appends the shortest text that reads back as v, in radix 2 to 36. */
bool vs_number_print(vs_scheme *vm, vs_value v, int radix, vs_text *t);
/* Writes the shortest text in base 10 that reads back as d, ending in NUL, without allocation. Returns its length. */
size_t vs_double_text(double d, char out[VS_DOUBLE_TEXT]);

#endif
