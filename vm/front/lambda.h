/* Declares the expansion of parameter lists, implemented in lambda.c. */
#ifndef VS_VM_FRONT_LAMBDA_H
#define VS_VM_FRONT_LAMBDA_H

#include "vm/front/expand.h"

/* The source of a lambda. Its values need not be roots of the garbage collector. */
typedef struct {
  vs_value params, body; /* params: the parameter list; body: the list of the body's forms */
  bool tail;             /* whether params follow a procedure's name, as in (define (name . params) ...) */
  vs_value env, name;    /* env: environment of the lambda; name: its symbol, or #f */
  vs_pos pos;
} vs_lambda_form;

/* Expands a parameter list and a body to a LAMBDA. If predicates must be evaluated, the LAMBDA is inside a LET that
 * evaluates them. If it fails, sets the error and returns false. */
bool vs_expand_lambda(vs_expansion *x, const vs_lambda_form *form, vs_core_node **into);
bool vs_predicate_step(vs_expansion *x);

#endif
