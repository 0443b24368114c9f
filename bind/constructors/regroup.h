/* Owns the interface of regroup.c: the advice on calls whose points were written as bare numbers. */
#ifndef VS_BIND_CONSTRUCTORS_REGROUP_H
#define VS_BIND_CONSTRUCTORS_REGROUP_H

#include "vm/machine/native.h"

typedef struct vs_procedure vs_procedure;

/* The call of p, under this name, that was meant where numbers stand for points, gvectors or factors, into text;
 * false: there is none (regroup.c). */
bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const char *name, const vs_value *a, int n, char *text,
    size_t room);

#endif
