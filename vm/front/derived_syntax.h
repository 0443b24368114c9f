/* Declares functions of derived_syntax.c for syntax that is rewritten to other syntax. */
#ifndef VS_VM_FRONT_DERIVED_SYNTAX_H
#define VS_VM_FRONT_DERIVED_SYNTAX_H

#include "vm/front/expand.h"

/* Sets *out to an alias (a renamed identifier) of a name of the library, for use in rewritten forms. The alias refers
 * to the library's binding even if the program redefines the name. */
bool vs_core_name(vs_scheme *vm, const char *name, vs_value *out);
/* Sets *out to a list of n items. `items` are roots of the garbage collector. */
bool vs_make_form_list(vs_scheme *vm, vs_value *out, size_t n, const vs_value *items);
bool vs_features(vs_scheme *vm, vs_value *out);
bool vs_cond_expand(vs_expansion *x, vs_value form, vs_value *forms);

#endif
