/* Declares functions of string.c on strings and symbols. */
#ifndef VS_VM_LIBRARY_STRING_H
#define VS_VM_LIBRARY_STRING_H

#include "vm/values/value.h"

/* Sets character k of *s, as vs_string_put does. If c needs more than one byte, first converts the string to four bytes
 * for each character. *s is a root of the garbage collector. Returns false when memory is out. */
bool vs_string_set(vs_scheme *vm, vs_value *s, size_t k, uint32_t c);
/* Sets *out to a new string of the characters start to end - 1 of *s, which is a root of the garbage collector. */
bool vs_string_slice(vs_scheme *vm, const vs_value *s, size_t start, size_t end, vs_value *out);
/* Compares two strings by code points. Returns a number below 0, 0, or above 0 if a is less than, equal to or greater
 * than b. */
int vs_string_compare(vs_value a, vs_value b);

#endif
