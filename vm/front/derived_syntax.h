/* Declares functions of derived_syntax.c for syntax that is rewritten to other syntax. */
#ifndef VS_VM_FRONT_DERIVED_SYNTAX_H
#define VS_VM_FRONT_DERIVED_SYNTAX_H

#include "vm/front/expand.h"

/* Sets *out to an alias of a name of the library, for the results of rewriting. */
bool vs_core_name(vs_scheme *vm, const char *name, vs_value *out);
bool vs_make_form_list(vs_scheme *vm, vs_value *out, size_t n, const vs_value *items);   /* Sets *out to a list of n
                                                                                          * items, which are in
                                                                                          * roots. */
bool vs_features(vs_scheme *vm, vs_value *out);
bool vs_cond_expand(vs_expansion *x, vs_value form, vs_value *forms);

#endif
