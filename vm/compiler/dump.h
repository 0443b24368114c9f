/* Owns the instructions of a procedure as text. */
#ifndef VS_VM_COMPILER_DUMP_H
#define VS_VM_COMPILER_DUMP_H

#include "vm/values/value.h"

/* Passes each line of a code object's instructions to `each` until it returns false. Returns false when memory is
 * out. */
bool vs_code_dump(vs_scheme *vm, vs_value code, bool (*each)(void *context, const char *line), void *context);

#endif
