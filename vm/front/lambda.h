/* Owns the interface of lambda.c: parameter lists. */
#ifndef VS_VM_FRONT_LAMBDA_H
#define VS_VM_FRONT_LAMBDA_H

#include "vm/front/expand.h"

/* A lambda's source. Its values need not be rooted: the expansion does so. */
typedef struct {
  vs_value params, body; /* the parameter list, and the list of the body's forms */
  bool tail;             /* params followed a name, as in (define (name . params) ...): [ ] around all of it then is a
                          * rest parameter with its predicate */
  vs_value env, name;    /* its environment; its symbol, or #f */
  vs_pos pos;
} vs_lambda_form;

/* Expands a parameter list and a body to a LAMBDA, in a LET of its contracts if need be. Returns false with the error
 * set. */
bool vs_expand_lambda(vs_expansion *x, const vs_lambda_form *form, vs_core_node **into);
bool vs_predicate_step(vs_expansion *x);

#endif
