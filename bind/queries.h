/* Owns the interface of queries.c: the questions of a program about an object. */
#ifndef VS_BIND_QUERIES_H
#define VS_BIND_QUERIES_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Checks that argument i, an object, is finite; the error says how to bound it. */
vs_status vs_bind_finite(vs_args *f, int i);

#endif
