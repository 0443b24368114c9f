/* Owns the instructions of a procedure as text. */
#ifndef VS_VM_COMPILER_DUMP_H
#define VS_VM_COMPILER_DUMP_H

#include "vm/values/value.h"

/* The instructions of a code object as text, to each until it returns false. False: out of memory. */
bool vs_code_dump(vs_scheme *vm, vs_value code, bool (*each)(void *context, const char *line), void *context);

#endif
