/* Declares checked calls, implemented in contract.c. */
#ifndef VS_BIND_CALL_CONTRACT_H
#define VS_BIND_CALL_CONTRACT_H

#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_bind_param vs_bind_param;
typedef struct vs_args vs_args;
typedef struct vs_procedure vs_procedure;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* The table of procedures in columns: natives, contracts and C functions. */
typedef struct {
  const vs_native_def *natives;
  const vs_procedure *procedures;
  vs_procedure_fn *const *functions;
  /* Called if an argument is a dual number, which carries a derivative. Runs the call and sets *status. Returns false,
   * without an error, if the procedure accepts only ordinary numbers. */
  bool (*differentiate)(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out,
                        vs_status *status);
} vs_bind_columns;

/* Checks and converts the n arguments, and calls the C function in the running native's row of the table. If it fails,
 * sets the error and returns VS_ERROR. */
vs_status vs_bind_call(vs_scheme *vm, const vs_bind_columns *table, vs_value *a, int n, vs_value *out);
/* Converts v as the contract of parameter p requires. If it fails, sets the error and returns VS_ERROR. */
vs_status vs_convert(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out);
/* Writes all forms of a procedure's call to `text`, such as "takes (make-plane point normal) or (make-plane p q r)". */
void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room);

#endif
