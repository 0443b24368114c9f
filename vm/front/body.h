/* Declares the expansion of definitions, implemented in body.c. */
#ifndef VS_VM_FRONT_BODY_H
#define VS_VM_FRONT_BODY_H

#include "vm/front/expand.h"

/* Converts the expression `spec` after define-syntax to a MACRO, or to a call that returns a MACRO. Sets *done to false
 * if the call of x->procedure must run first; the caller then sets x->now.waiting. */
bool vs_expand_transformer(vs_expansion *x, vs_value spec, vs_value env, vs_value *macro, bool *done);
/* Performs one step of the current task, which expands a body (definitions and expressions). */
bool vs_body_step(vs_expansion *x);
/* Performs one step of the current task, which expands a form at top level. */
bool vs_top_step(vs_expansion *x);
/* Continues the task that waits for the result of a call; `value` is this result. */
bool vs_body_resume(vs_expansion *x, vs_value value);
/* Divides the define form (define . rest) into three parts, which are roots of the garbage collector: the name; the
 * parameters, or VS_ABSENT if no procedure is defined; the body or the value's form. If it fails, sets the error and
 * returns false. */
bool vs_define_parts(vs_expansion *x, vs_value form, vs_value parts[3], bool *procedure);

#endif
