/* Declares the functions of refuse.c that refuse arguments. Each sets the error and returns VS_ERROR. */
#ifndef VS_BIND_CALL_REFUSE_H
#define VS_BIND_CALL_REFUSE_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef struct vs_bind_param vs_bind_param;

/* vs_contract_noun returns the kind of value that a contract requires, as text; the next function returns its condition
 * on the value. */
const char *vs_contract_noun(uint8_t contract);
const char *vs_contract_condition(uint8_t contract);

/* Returns the first name of f's procedure, stored in `room`. For an internal procedure, whose name begins with %,
 * returns the name without the %: it is the name of the calling procedure. */
const char *vs_bind_own_name(const vs_args *f, char room[64]);

/* Sets the error "PARAM must be EXPECTED, got GOT". */
vs_status vs_bind_refuse(vs_args *f, const char *param, const char *expected, vs_value got);
/* Sets the error "PARAM must be EXPECTED (HINT?), got GOT". hint is the value or form that was probably meant. */
vs_status vs_bind_refuse_hint(vs_args *f, const char *param, const char *expected, vs_value got, const char *hint);
/* Refuses a value that is not of the kind in p's contract. */
vs_status vs_bind_refuse_kind(vs_args *f, const vs_bind_param *p, vs_value got);
/* Refuses a value that is of the kind in p's contract but does not fulfil its condition. */
vs_status vs_bind_refuse_condition(vs_args *f, const vs_bind_param *p, vs_value got);
/* Refuses a procedure that was passed instead of its result. Returns false, without an error, if v is no procedure. */
bool vs_bind_refuse_uncalled(vs_args *f, const vs_bind_param *p, vs_value v);

#endif
