/* Owns the entry into the run loop, and what the host sees of an error. */
#ifndef VS_VM_MACHINE_RUN_H
#define VS_VM_MACHINE_RUN_H

#include "vm/machine/native.h"

/* Calls a procedure from outside and runs until it returns. false: uncaught error, vm->condition is what was raised (a
   CONDITION, or any object). Not for natives: they return VS_CALL. A captured continuation of an earlier vs_run may be
   entered: it then ends the current one. */
bool vs_run(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv, vs_value *out);

#endif
