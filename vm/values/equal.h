/* Owns equivalence: eqv?, equal? (cycles and any depth are safe) and the hashes that agree with them. */
#ifndef VS_VM_VALUES_EQUAL_H
#define VS_VM_VALUES_EQUAL_H

#include "vm/numbers/number.h"

static inline bool vs_eqv(vs_value a, vs_value b) {
  return a == b || (vs_is_object(a) && vs_is_object(b) && vs_number_eqv(a, b));
}
bool vs_equal(vs_scheme *vm, vs_value a, vs_value b, bool *out);      /* false: out of memory or a limit */
/* By VS_TABLE_ kind. Address hashes (EQ, EQV, and within EQUAL procedures, ports ...) hold for one vm->collections
   count while the object is young; *moves is set then. kind is one of VS_TABLE_EQ to VS_TABLE_STRING. */
uint64_t vs_hash(vs_scheme *vm, vs_value v, uint32_t kind, bool *moves);

#endif
