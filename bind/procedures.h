/* Declares the tables of procedures, their natives, and the native that runs them. Implemented in procedures.c.
 *
 * procedures.def lists every procedure with the forms of its arguments. A single C function, vs_bind_enter, implements
 * all of them as natives. It finds the row of the running native. call/contract.c chooses the form, checks and converts
 * the arguments, and calls the row's C function with C data. The C functions therefore need not repeat the checks that
 * their rows state. */
#ifndef VS_BIND_PROCEDURES_H
#define VS_BIND_PROCEDURES_H

#include "bind/call/procedure.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

extern const vs_procedure vs_bind_procedures[];
extern const vs_native_def vs_bind_defs[]; /* the natives, in the order of vs_bind_procedures; the last entry has no
                                            * name */
extern const vs_native_table vs_bind_table;

vs_native_fn vs_bind_enter;

/* declares the C function of each procedure in procedures.def */
#define PROC(id, name, fn, doc, forms, keys) vs_procedure_fn fn;
#define PROCS(id, name, signature, fn, doc, forms, keys) vs_procedure_fn fn;
#include "bind/procedures.def"
#undef PROC
#undef PROCS

#endif
