/* Declares the conversion of compiled code to text. */
#ifndef VS_VM_COMPILER_DUMP_H
#define VS_VM_COMPILER_DUMP_H

#include "vm/values/value.h"

/* Calls `each` with the text of every instruction, until it returns false. Returns false when memory is out. */
bool vs_code_dump(vs_scheme *vm, vs_value code, bool (*each)(void *context, const char *line), void *context);

#endif
