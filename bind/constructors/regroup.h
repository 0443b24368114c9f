/* Declares advice for calls with plain numbers in place of points. Implemented in regroup.c. */
#ifndef VS_BIND_CONSTRUCTORS_REGROUP_H
#define VS_BIND_CONSTRUCTORS_REGROUP_H

#include "vm/machine/native.h"

typedef struct vs_procedure vs_procedure;

/* A call with unconverted arguments, `count` of them. The function vs_bind_grouped writes the call of procedure p that
 * was probably meant: it groups the numbers to points, gvectors or factors. It returns false if no grouping fits. */
typedef struct { const char *name; const vs_value *at; int count; } vs_plain_call;
bool vs_bind_grouped(vs_scheme *vm, const vs_procedure *p, const vs_plain_call *call, char *text, size_t room);

#endif
