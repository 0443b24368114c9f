/* Owns the interface of contract.c: the checked call. */
#ifndef VS_BIND_CALL_CONTRACT_H
#define VS_BIND_CALL_CONTRACT_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef struct vs_procedure vs_procedure;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

/* A procedure as the table has it. */
typedef struct {
  const vs_procedure *procedure;
  vs_procedure_fn *function;
  const char *names; /* with spaces between them */
  /* The call where an argument is a number that is being differentiated. False, without an error: the procedure takes
   * plain numbers only; else *status is the call's. */
  bool (*differentiate)(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out,
                        vs_status *status);
} vs_bind_row;

/* Calls the row's function with n arguments, checked and converted. VS_ERROR: the error is set. */
vs_status vs_bind_call(vs_scheme *vm, const vs_bind_row *row, vs_value *a, int n, vs_value *out);
/* Writes the ways to call it: "takes (make-plane point normal) or (make-plane p q r)". */
void vs_bind_forms(const vs_procedure *procedure, const char *name, char *text, size_t room);

#endif
