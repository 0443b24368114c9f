/* Owns lists that a loop builds in reverse. Their pairs are reversed in place if no other code can refer to them. */
#ifndef VS_VM_VALUES_PAIRS_H
#define VS_VM_VALUES_PAIRS_H

#include "vm/values/gc.h"

/* Returns the number of continuations made, as a value. */
static inline vs_value vs_captures(const vs_scheme *vm) { return VS_TAG_FIXNUM << 48 | vm->captures; }

/* Sets *out to the elements of *list, a proper list, reversed, in front of tail. Both are in roots; *list is empty
 * afterwards. Returns false when memory is out or a limit is reached. */
bool vs_list_onto(vs_scheme *vm, vs_value *list, vs_value tail, vs_value *out);

/* Does the same in front of the empty list. The list belongs to the caller alone, who has built it since the number of
 * continuations was `captures`. If it is the same now, no continuation can return to the half-built list, so its pairs
 * are reversed in place. */
bool vs_list_own_turned(vs_scheme *vm, vs_value *list, vs_value captures, vs_value *out);

/* Returns 1 if v is a proper list, 0 if not; -1 if it is too long to find out quickly, or circular. */
static inline int vs_is_short_list(vs_value v) {
  for (int i = 0; i < 32; i++, v = vs_cdr(v))
    if (!vs_is_pair(v)) return v == VS_NIL;
  return -1;
}

#endif
