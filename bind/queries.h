/* Owns the interface of queries.c: what a program can ask of an object. */
#ifndef VS_BIND_QUERIES_H
#define VS_BIND_QUERIES_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* argument i, an object, has an end; else the error says what to do */
vs_status vs_bind_finite(vs_args *f, int i);

#endif
