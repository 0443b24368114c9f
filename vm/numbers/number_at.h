/* Owns the reading of numbers that stand in a program. */
#ifndef VS_VM_NUMBERS_NUMBER_AT_H
#define VS_VM_NUMBERS_NUMBER_AT_H

#include "vm/numbers/number_text.h"

/* vs_number_parse in radix 10; a number that is too large is refused at its place. */
bool vs_number_parse_at(vs_scheme *vm, const char *s, size_t n, vs_pos place, vs_value *out);

#endif
