/* Owns the interface of measures.c: the measures of objects. */
#ifndef VS_BIND_MEASURES_H
#define VS_BIND_MEASURES_H

#include "bind/call/call.h"

/* For what works long in the layers below: polls; false: the condition is set. context is the vs_scheme */
bool vs_bind_keep_going(void *vm, double done);
/* sections, shadows and edges in argument i become what they are in space */
vs_status vs_bind_resolve(vs_args *f, int i);

#endif
