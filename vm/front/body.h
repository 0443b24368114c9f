/* Owns the interface of body.c: definitions. */
#ifndef VS_VM_FRONT_BODY_H
#define VS_VM_FRONT_BODY_H

#include "vm/front/expand.h"

/* the transformer spec to a MACRO, or a call that yields it. *done false: it must be called (x->procedure), put
   `waiting` */
bool vs_expand_transformer(vs_expansion *x, vs_value spec, vs_value env, vs_value *macro, bool *done);
/* the steps of the tasks, and the value that one of them waited for */
bool vs_body_step(vs_expansion *x);
bool vs_top_step(vs_expansion *x);
bool vs_body_resume(vs_expansion *x, vs_value value);
/* Takes form, (define . rest), apart into roots: the name; the parameters, VS_ABSENT where it defines no procedure; the
   body, or the value's form. False: the error is set. */
bool vs_define_parts(vs_expansion *x, vs_value form, vs_value parts[3], bool *procedure);

#endif
