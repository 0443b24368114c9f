/* Owns the run loop of programs that are stepped through, for vs_run. */
#ifndef VS_VM_STEPPING_STEP_LOOP_H
#define VS_VM_STEPPING_STEP_LOOP_H

#include "vm/machine/vs.h"

/* Does the same as vs_run_loop: runs the call in the window w until its activation returns. */
bool vs_step_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out);

#endif
