/* Declares functions on lists that a loop builds in reverse. If no other code can refer to their pairs, they are
 * reversed in place. */
#ifndef VS_VM_VALUES_PAIRS_H
#define VS_VM_VALUES_PAIRS_H

#include "vm/values/gc.h"

/* Returns the number of continuations created so far, as a fixnum. */
static inline vs_value vs_captures(const vs_scheme *vm) { return VS_TAG_FIXNUM << 48 | vm->captures; }

/* Sets *out to the elements of *list, a proper list, in reverse order, followed by tail. *list and *out are roots of
 * the garbage collector; *list is () afterwards. Returns false when memory is out or a limit is reached. */
bool vs_list_onto(vs_scheme *vm, vs_value *list, vs_value tail, vs_value *out);

/* Sets *out to the reverse of *list, to which only the caller has a reference. captures: number of continuations when
 * the caller began to build the list. If the number has not changed, the pairs are reversed in place. */
bool vs_list_own_turned(vs_scheme *vm, vs_value *list, vs_value captures, vs_value *out);

/* Returns 1 if v is a proper list of fewer than 32 elements, and 0 if v has fewer than 32 pairs and ends in another
 * value. Returns -1 if v has 32 pairs or more, or is circular. */
static inline int vs_is_short_list(vs_value v) {
  for (int i = 0; i < 32; i++, v = vs_cdr(v))
    if (!vs_is_pair(v)) return v == VS_NIL;
  return -1;
}

#endif
