/* Owns going on with a stopped program. */
#ifndef VS_VM_STEPPING_RESUME_H
#define VS_VM_STEPPING_RESUME_H

#include "vm/stepping/step.h"

/* Goes on with a stopped program: to its next stop (which one, `mode` says; SAME: as before), its end or an error,
   as vs_run does. `stop` is a condition that vs_is_stop knows. */
bool vs_step_resume(vs_scheme *vm, vs_value stop, vs_step_mode mode, vs_value *out);

#endif
