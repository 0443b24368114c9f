/* Reads the optional arguments [start end] of string, vector and bytevector procedures. */
#ifndef VS_VM_LIBRARY_RANGE_H
#define VS_VM_LIBRARY_RANGE_H

#include "vm/machine/native.h"

/* Sets *start and *end to the arguments a[arg] and a[arg + 1]; an absent argument is 0 for *start, `length` for *end.
 * Checks that 0 <= *start <= *end <= length. Returns false with the error set. */
static inline bool vs_arg_range(vs_scheme *vm, const vs_value *a, int n, int arg, int64_t length, int64_t *start,
                                int64_t *end) {
  VS_ASSERT(length >= 0);
  *start = 0;
  *end = length;
  return (n <= arg + 1 || vs_arg_index(vm, a, arg + 1, 0, length, end)) &&
         (n <= arg || vs_arg_index(vm, a, arg, 0, *end, start));
}

#endif
