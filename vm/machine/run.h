/* Owns the entry into the run loop, and the error that the host gets. */
#ifndef VS_VM_MACHINE_RUN_H
#define VS_VM_MACHINE_RUN_H

#include "vm/machine/native.h"

/* Calls a procedure from outside and runs until it returns. Returns false on an uncaught error; vm->condition is then
 * the raised object, a CONDITION or any other. Not for natives: they return VS_CALL. A program may enter a captured
 * continuation of an earlier vs_run: it then ends the current one. */
bool vs_run(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv, vs_value *out);

#endif
