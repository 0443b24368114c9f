/* Owns the interface of regroup.c: the advice on calls whose points were written as bare numbers. */
#ifndef VS_BIND_CONSTRUCTORS_REGROUP_H
#define VS_BIND_CONSTRUCTORS_REGROUP_H

#include "vm/machine/native.h"

typedef struct vs_procedure vs_procedure;

/* A call as it came: the name of the procedure, and its arguments. vs_bind_grouped writes the call of p that was meant
 * where numbers stand for points, gvectors or factors, into text. False: there is none. */
typedef struct { const char *name; const vs_value *at; int count; } vs_plain_call;
bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const vs_plain_call *call, char *text, size_t room);

#endif
