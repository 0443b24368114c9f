/* Owns lists that a loop builds from the back: turned round in their place where nobody else has them. */
#ifndef VS_VM_VALUES_PAIRS_H
#define VS_VM_VALUES_PAIRS_H

#include "vm/values/gc.h"

/* The number of continuations made so far, as a value. */
static inline vs_value vs_captures(const vs_scheme *vm) { return VS_TAG_FIXNUM << 48 | vm->captures; }

/* The elements of *list, a proper list, in front of tail, turned round. *list and *out are in roots; *list is used up.
 * False: out of memory, or a limit is reached. */
bool vs_list_onto(vs_scheme *vm, vs_value *list, vs_value tail, vs_value *out);

/* The same in front of the empty list, for a list that its owner has built since there were `captures` continuations,
 * and nobody else has. Where there are no more of them now, nobody can come back to where it was half built, and it is
 * turned round in its place. */
bool vs_list_own_turned(vs_scheme *vm, vs_value *list, vs_value captures, vs_value *out);

/* Is v a proper list? 1 or 0 for short ones; -1: too long to tell at once (or circular). */
static inline int vs_is_short_list(vs_value v) {
  for (int i = 0; i < 32; i++, v = vs_cdr(v))
    if (!vs_is_pair(v)) return v == VS_NIL;
  return -1;
}

#endif
