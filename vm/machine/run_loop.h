/* Declares the run loop, for vs_run. */
#ifndef VS_VM_MACHINE_RUN_LOOP_H
#define VS_VM_MACHINE_RUN_LOOP_H

#include "vm/machine/vs.h"

/* Runs the call in the window w, at the start of the stack, until its activation returns. Returns false if
 * vm->condition was raised. */
bool vs_run_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

#endif
