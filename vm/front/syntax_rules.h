/* Declares the expansion of syntax-rules, implemented in syntax_rules.c. */
#ifndef VS_VM_FRONT_SYNTAX_RULES_H
#define VS_VM_FRONT_SYNTAX_RULES_H

#include "vm/front/expand.h"

bool vs_rules_make(vs_expansion *x, vs_value spec, vs_value env, vs_pos pos, vs_value *macro);
bool vs_rules_expand(vs_expansion *x, vs_value macro, vs_value form, vs_value env, vs_pos pos, vs_value *out);

#endif
