/* Owns the interface of lambda.c: parameter lists. */
#ifndef VS_VM_FRONT_LAMBDA_H
#define VS_VM_FRONT_LAMBDA_H

#include "vm/front/expand.h"

/* A lambda as it is written. Its values need not be rooted: the expansion does so. */
typedef struct {
  vs_value params, body; /* the parameter list, and the list of the body's forms */
  bool tail;             /* params stood behind a name, as in (define (name . params) ...): then [ ] around all of it is
                            a rest parameter with its predicate */
  vs_value env, name;    /* where it is expanded; the symbol that it is called, or #f */
  vs_pos pos;
} vs_lambda_form;

/* A parameter list and a body become a LAMBDA, in a LET of its contracts if need be. False: the error is set. */
bool vs_expand_lambda(vs_expansion *x, const vs_lambda_form *form, vs_core_node **into);
bool vs_predicate_step(vs_expansion *x);

#endif
