/* Declares the built-in libraries, implemented in standard.c. */
#ifndef VS_VM_LIBRARY_STANDARD_H
#define VS_VM_LIBRARY_STANDARD_H

#include "vm/values/text.h"

/* Appends a text such as "; (import (scheme write)) brings it" to t if a library inside the program vs exports the
 * name. syntax: only libraries that define the name as syntax count, as (match) defines match. */
bool vs_library_advice(vs_scheme *vm, vs_value symbol, bool syntax, vs_text *t);
/* Sets *out to the name under which the library `name` is found: (srfi 133) for (scheme vector) of R7RS-large,
 * otherwise the name itself. Returns false when memory is out. */
bool vs_library_own_name(vs_scheme *vm, vs_value name, vs_value *out);
/* Sets *env to the environment of the library `name` if it is in libraries.def or is the complete library. */
bool vs_library_built_in(vs_scheme *vm, vs_value name, vs_value *env);
bool vs_library_is_built_in(vs_value name);
/* Calls each(vm, context, n) for every library (srfi n), until `each` returns false. */
bool vs_library_each_srfi(vs_scheme *vm, bool (*each)(vs_scheme *vm, void *context, int number), void *context);

#endif
