/* Owns the interface of regroup.c: the advice on calls with bare numbers instead of points. */
#ifndef VS_BIND_CONSTRUCTORS_REGROUP_H
#define VS_BIND_CONSTRUCTORS_REGROUP_H

#include "vm/machine/native.h"

typedef struct vs_procedure vs_procedure;

/* A call before any conversion: the name of the procedure, and its arguments. vs_bind_grouped writes the probable call
 * of p, with numbers grouped to points, gvectors or factors, into text. It returns false if there is none. */
typedef struct { const char *name; const vs_value *at; int count; } vs_plain_call;
bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const vs_plain_call *call, char *text, size_t room);

#endif
