/* Owns the interface of string.c: strings and symbols. */
#ifndef VS_VM_LIBRARY_STRING_H
#define VS_VM_LIBRARY_STRING_H

#include "vm/values/value.h"

/* the same, widening the string first if need be; *s is a root. False: out of memory. k is in range. */
bool vs_string_set(vs_scheme *vm, vs_value *s, size_t k, uint32_t c);
/* characters start..end of *s (a root) as a fresh string. start..end lies in the string. */
bool vs_string_slice(vs_scheme *vm, const vs_value *s, size_t start, size_t end, vs_value *out);
/* below, equal or above 0 by code points */
int vs_string_compare(vs_value a, vs_value b);

#endif
