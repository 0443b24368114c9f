/* Declares procedures that return facts about an object, implemented in queries.c. */
#ifndef VS_BIND_QUERIES_H
#define VS_BIND_QUERIES_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Checks that the object in argument i is finite. If it is not, sets an error that explains how to bound the object. */
vs_status vs_bind_finite(vs_args *f, int i);

#endif
