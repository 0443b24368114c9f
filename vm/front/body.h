/* Owns the interface of body.c: definitions. */
#ifndef VS_VM_FRONT_BODY_H
#define VS_VM_FRONT_BODY_H

#include "vm/front/expand.h"

/* Turns the transformer spec into a MACRO, or into a call that returns one. *done false: the call (x->procedure) must
 * run; then set `waiting`. */
bool vs_expand_transformer(vs_expansion *x, vs_value spec, vs_value env, vs_value *macro, bool *done);
/* steps of the tasks, and the value for a waiting one */
bool vs_body_step(vs_expansion *x);
bool vs_top_step(vs_expansion *x);
bool vs_body_resume(vs_expansion *x, vs_value value);
/* Divides form, (define . rest), into roots: the name; the parameters, VS_ABSENT if it defines no procedure; the body,
 * or the value's form. Returns false with the error set. */
bool vs_define_parts(vs_expansion *x, vs_value form, vs_value parts[3], bool *procedure);

#endif
