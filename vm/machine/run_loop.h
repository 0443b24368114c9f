/* Declares the run loop, for vs_run. */
#ifndef VS_VM_MACHINE_RUN_LOOP_H
#define VS_VM_MACHINE_RUN_LOOP_H

#include "vm/machine/vs.h"

/* Runs the call in the window w (procedure, free slot, n arguments), at the start of the stack, until it returns.
 * Returns false if an error was raised: vm->condition. */
bool vs_run_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

#endif
