/* Owns libraries: their names, define-library, import, require. */
#ifndef VS_LIBRARY_H
#define VS_LIBRARY_H

#include "vm/expand.h"

/* The environment called so, or VS_FALSE. The names of R7RS, of SRFIs that are built in, and (visualscheme ...) all are the one library of the
   VM: it holds more than each of them asks for. */
vs_value vs_library_find(vs *vm, vs_value name);
bool vs_library_known(vs *vm, vs_value name);
bool vs_library_register(vs *vm, vs_value name, vs_value env);
/* Imports an import set into env. *missing: the name of a library that is not there (then nothing happened), else VS_ABSENT. */
bool vs_library_import_set(vs *vm, vs_value set, vs_value env, vs_pos pos, vs_value *missing);
bool vs_features(vs *vm, vs_value *out);
bool vs_cond_expand(vs_expansion *x, vs_value form, vs_value *forms);

#endif
