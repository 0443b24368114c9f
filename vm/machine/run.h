/* Declares the entry into the run loop. */
#ifndef VS_VM_MACHINE_RUN_H
#define VS_VM_MACHINE_RUN_H

#include "vm/machine/native.h"

/* Calls a procedure from outside the run loop, and runs until it returns. Returns false on an uncaught error;
 * vm->condition is then the raised object. Natives must not call it; they return VS_CALL. A continuation that an
 * earlier vs_run captured ends the current vs_run when it ends. */
bool vs_run(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv, vs_value *out);

#endif
