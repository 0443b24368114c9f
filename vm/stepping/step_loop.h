/* Declares the run loop for programs that are stepped through. */
#ifndef VS_VM_STEPPING_STEP_LOOP_H
#define VS_VM_STEPPING_STEP_LOOP_H

#include "vm/machine/vs.h"

/* Runs the call in the window w (procedure, free slot, arguments) until it returns, as vs_run_loop does, with a check
 * of each instruction. */
bool vs_step_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

#endif
