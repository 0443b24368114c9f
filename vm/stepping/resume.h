/* Declares the continuation of stopped programs. */
#ifndef VS_VM_STEPPING_RESUME_H
#define VS_VM_STEPPING_RESUME_H

#include "vm/stepping/step.h"

/* Continues a stopped program until its next stop, which `mode` determines (SAME: the mode of the previous step), its
 * end or an error. Returns as vs_run does. `stop` is a condition for which vs_is_stop is true. */
bool vs_step_resume(vs_scheme *vm, vs_value stop, vs_step_mode mode, vs_value *out);

#endif
