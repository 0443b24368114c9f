/* Declares functions of string.c on strings and symbols. */
#ifndef VS_VM_LIBRARY_STRING_H
#define VS_VM_LIBRARY_STRING_H

#include "vm/values/value.h"

/* Sets character k, as vs_string_put does, after converting the string to four bytes for each character if that is
 * necessary. *s is a root. Returns false when memory is out. */
bool vs_string_set(vs_scheme *vm, vs_value *s, size_t k, uint32_t c);
/* Sets *out to a new string of the characters start..end of *s, a root. */
bool vs_string_slice(vs_scheme *vm, const vs_value *s, size_t start, size_t end, vs_value *out);
/* Returns a number below, equal to or above 0: compares by code points. */
int vs_string_compare(vs_value a, vs_value b);

#endif
