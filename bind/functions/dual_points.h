/* Owns points and gvectors made of dual numbers: what the procedures of points give when a number is being
 * differentiated. */
#ifndef VS_BIND_FUNCTIONS_DUAL_POINTS_H
#define VS_BIND_FUNCTIONS_DUAL_POINTS_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* Calls a procedure with n arguments, one of them dual, where it is one that points are made and taken apart by.
 * Returns false, without an error, where it is another: objects hold plain numbers. *status is the call's otherwise. */
bool vs_dual_points(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out, vs_status *status);

#endif
