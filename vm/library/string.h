/* Owns the interface of string.c: strings and symbols. */
#ifndef VS_VM_LIBRARY_STRING_H
#define VS_VM_LIBRARY_STRING_H

#include "vm/values/value.h"

/* Does the same as vs_string_put, and first widens the string if need be; *s is a root. Returns false when memory is
 * out. k is in range. */
bool vs_string_set(vs_scheme *vm, vs_value *s, size_t k, uint32_t c);
/* Makes a new string of characters start..end of *s (a root), which are in the string. */
bool vs_string_slice(vs_scheme *vm, const vs_value *s, size_t start, size_t end, vs_value *out);
/* Returns a number below, equal to or above 0, by code points. */
int vs_string_compare(vs_value a, vs_value b);

#endif
