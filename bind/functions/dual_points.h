/* Owns the interface of dual_points.c: the procedures of points when a number is being differentiated. */
#ifndef VS_BIND_FUNCTIONS_DUAL_POINTS_H
#define VS_BIND_FUNCTIONS_DUAL_POINTS_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* Calls a procedure with n arguments, one of them dual, and sets *status, if the procedure makes points or reads their
 * parts. Returns false, without an error, for other procedures: objects hold plain numbers. */
bool vs_dual_points(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out, vs_status *status);

#endif
