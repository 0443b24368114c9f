/* Owns the interface of standard.c: the built-in libraries. */
#ifndef VS_VM_LIBRARY_STANDARD_H
#define VS_VM_LIBRARY_STANDARD_H

#include "vm/values/text.h"

/* "; (import (scheme write)) brings it" appended to t, where a built-in or shipped library has the name; syntax: of the
   shipped ones only where it is syntax, as match of (match) */
bool vs_library_advice(vs_scheme *vm, vs_value symbol, bool syntax, vs_text *t);
/* those of libraries.def and the whole */
bool vs_library_built_in(vs_scheme *vm, vs_value name, vs_value *env);
bool vs_library_is_built_in(vs_value name);
/* each(vm, context, n) for every (srfi n) there is, until it returns false */
bool vs_library_each_srfi(vs_scheme *vm, bool (*each)(vs_scheme *vm, void *context, int number), void *context);

#endif
