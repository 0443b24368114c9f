/* Declares libraries: their names, define-library, import, require. */
#ifndef VS_VM_LIBRARY_LIBRARY_H
#define VS_VM_LIBRARY_LIBRARY_H

#include "vm/front/expand.h"

/* Sets *env to the environment of the library, or to VS_FALSE if there is none. (visualscheme) is the complete library
 * of the VM. The libraries of R7RS and SRFIs are parts of it, created when they are first used (standard.c). */
bool vs_library_find(vs_scheme *vm, vs_value name, vs_value *env);
/* Returns true if the library exists or a file that may define it exists, for an import in file number `from` and the
 * environment env. */
bool vs_library_known(vs_scheme *vm, vs_value name, uint32_t from, vs_value env);
bool vs_library_register(vs_scheme *vm, vs_value name, vs_value env);
/* Imports an import set, such as (prefix (srfi 1) list:), into env. If a library of the set does not exist, imports
 * nothing and sets *missing to the library's name; otherwise sets *missing to VS_ABSENT. */
bool vs_library_import_set(vs_scheme *vm, vs_value set, vs_value env, vs_pos pos, vs_value *missing);

bool vs_library_define(vs_expansion *x);
bool vs_library_import(vs_expansion *x);
bool vs_library_require(vs_expansion *x);

#endif
