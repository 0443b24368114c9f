/* Declares the equivalences eqv? and equal? (for any depth, and for cycles), and hashes that agree with them. */
#ifndef VS_VM_VALUES_EQUAL_H
#define VS_VM_VALUES_EQUAL_H

#include "vm/numbers/number.h"

static inline bool vs_eqv(vs_value a, vs_value b) {
  return a == b || (vs_is_object(a) && vs_is_object(b) && vs_number_eqv(a, b));
}
bool vs_equal(vs_scheme *vm, vs_value a, vs_value b, bool *out);      /* Sets *out to whether a and b are equal as by
                                                                       * equal?. Returns false when memory is out or a
                                                                       * limit is reached. */
/* Returns the hash of v for a table of this kind, VS_TABLE_EQ to VS_TABLE_STRING. Sets *moves to true if the hash
 * depends on the address of a young object, and is valid only until vm->collections changes. If moves is NULL, the hash
 * depends on no address, and is valid for ever. */
uint64_t vs_hash(vs_scheme *vm, vs_value v, uint32_t kind, bool *moves);

#endif
