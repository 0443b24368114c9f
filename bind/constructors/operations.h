/* Owns the interface of operations.c: the operations. */
#ifndef VS_BIND_CONSTRUCTORS_OPERATIONS_H
#define VS_BIND_CONSTRUCTORS_OPERATIONS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* a closed curve that crosses itself is refused; what: what it is */
vs_status vs_bind_uncrossed(vs_args *f, vs_ref ref, const char *what);
/* where all are regions and closed curves of one plane, the curves become regions */
vs_status vs_bind_fill(vs_args *f, vs_ref *ref, size_t n);

#endif
