/* Owns the interface of contract.c: the checked call. */
#ifndef VS_BIND_CALL_CONTRACT_H
#define VS_BIND_CALL_CONTRACT_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef struct vs_procedure vs_procedure;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* A row of the table of procedures. */
typedef struct {
  const vs_procedure *procedure;
  vs_procedure_fn *function;
  const char *names; /* separated by spaces */
  /* Runs the call if an argument is a number that is being differentiated, and sets *status. Returns false, without an
   * error, if the procedure takes only plain numbers. */
  bool (*differentiate)(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out,
                        vs_status *status);
} vs_bind_row;

/* Calls the row's function with n arguments, after checks and conversion. Returns VS_ERROR with the error set. */
vs_status vs_bind_call(vs_scheme *vm, const vs_bind_row *row, vs_value *a, int n, vs_value *out);
/* Writes all forms of the call: "takes (make-plane point normal) or (make-plane p q r)". */
void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room);

#endif
