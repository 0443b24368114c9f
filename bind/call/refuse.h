/* Owns the interface of refuse.c: the errors of arguments. Each sets the error and returns VS_ERROR. */
#ifndef VS_BIND_CALL_REFUSE_H
#define VS_BIND_CALL_REFUSE_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef struct vs_bind_param vs_bind_param;

/* Return the contract's two texts: the kind of thing, and the condition on it. */
const char *vs_contract_noun(uint8_t contract);
const char *vs_contract_condition(uint8_t contract);

/* Returns the first name of f's procedure, in room. A helper speaks for the procedure that it helps: the mark before
 * its name is omitted. */
const char *vs_bind_own_name(const vs_args *f, char room[64]);

/* Sets "PARAM must be EXPECTED, got GOT". */
vs_status vs_bind_refuse(vs_args *f, const char *param, const char *expected, vs_value got);
/* The same, with "(HINT?)" after the expectation: the form that was probably meant. */
vs_status vs_bind_refuse_hint(vs_args *f, const char *param, const char *expected, vs_value got, const char *hint);
/* Refuses a value of the wrong kind for p's contract. */
vs_status vs_bind_refuse_kind(vs_args *f, const vs_bind_param *p, vs_value got);
/* Refuses a value of the right kind that fails the contract's condition. */
vs_status vs_bind_refuse_condition(vs_args *f, const vs_bind_param *p, vs_value got);
/* Refuses a procedure in place of its result. Returns false, without an error, if v is no procedure. */
bool vs_bind_refuse_uncalled(vs_args *f, const vs_bind_param *p, vs_value v);
/* Sets "NAME: ..." with the message of a lower layer. */
vs_status vs_bind_error(vs_scheme *vm, const vs_error *e);

#endif
