/* Declares the procedures of points that accept dual numbers (numbers with a derivative). Implemented in
 * dual_points.c. */
#ifndef VS_BIND_FUNCTIONS_DUAL_POINTS_H
#define VS_BIND_FUNCTIONS_DUAL_POINTS_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* Calls a procedure that creates points or reads their coordinates. Of its n arguments, at least one is a dual
 * number. Sets *status. Returns false, without an error, for all other procedures, since objects cannot contain dual
 * numbers. */
bool vs_dual_points(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out, vs_status *status);

#endif
