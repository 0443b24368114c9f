/* Reverses lists. */
#include "vm/values/pairs.h"

#include "vm/machine/native.h"

enum { POLL_STEP = 1024, POLL_COST = 4 * POLL_STEP /* POLL_STEP: number of pairs read or created between two polls for
                                                    * an interrupt */ };

bool vs_list_onto(vs_scheme *vm, vs_value *list, vs_value tail, vs_value *out) {
  *out = tail;
  for (uint64_t i = 1; vs_is_pair(*list); i++, *list = vs_cdr(*list))
    if (!vs_cons(vm, vs_car(*list), *out, out) || (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST))) return false;
  VS_ASSERT(*list == VS_NIL); /* if the rest is not (), the list was not a proper list */
  return true;
}

bool vs_list_own_turned(vs_scheme *vm, vs_value *list, vs_value captures, vs_value *out) {
  if (captures != vs_captures(vm)) return vs_list_onto(vm, list, VS_NIL, out);
  *out = VS_NIL;
  for (uint64_t i = 1; vs_is_pair(*list); i++) {
    vs_value l = *list;
    *list = vs_cdr(l);
    vs_gc_store(vm, vs_as_pair(l), &vs_as_pair(l)->cdr, *out);
    *out = l;
    if (i % POLL_STEP == 0 && !vs_poll(vm, POLL_COST)) return false;
  }
  return true;
}
