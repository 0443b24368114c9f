/* Declares the built-in libraries, implemented in standard.c. */
#ifndef VS_VM_LIBRARY_STANDARD_H
#define VS_VM_LIBRARY_STANDARD_H

#include "vm/values/text.h"

/* Appends "; (import (scheme write)) brings it" to t if a library that vs contains exports the name. syntax: a library
 * counts only if it defines the name as syntax, as (match) does for match. */
bool vs_library_advice(vs_scheme *vm, vs_value symbol, bool syntax, vs_text *t);
/* vs_library_built_in sets *env to the environment of a library of libraries.def, or of the complete library. */
bool vs_library_built_in(vs_scheme *vm, vs_value name, vs_value *env);
bool vs_library_is_built_in(vs_value name);
/* Calls each(vm, context, n) for every (srfi n) that exists, until it returns false. */
bool vs_library_each_srfi(vs_scheme *vm, bool (*each)(vs_scheme *vm, void *context, int number), void *context);

#endif
