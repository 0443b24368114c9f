/* Owns the interface of lambda.c: parameter lists. */
#ifndef VS_VM_FRONT_LAMBDA_H
#define VS_VM_FRONT_LAMBDA_H

#include "vm/front/expand.h"

/* A parameter list and a body become a LAMBDA, in a LET of its contracts if need be. tail: the list stood behind a
   name, as in (define (name . params) ...): then [ ] around all of it is a rest parameter with its predicate. */
bool vs_expand_lambda(vs_expansion *x, vs_value params, bool tail, vs_value body, vs_value env, vs_value name,
                      vs_pos pos, vs_core_node **into);
bool vs_predicate_step(vs_expansion *x);

#endif
