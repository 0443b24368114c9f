/* Declares functions of operations.c that other constructors use. */
#ifndef VS_BIND_CONSTRUCTORS_OPERATIONS_H
#define VS_BIND_CONSTRUCTORS_OPERATIONS_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Refuses a closed curve that intersects itself. what: the curve's noun in the error. */
vs_status vs_bind_uncrossed(vs_args *f, vs_ref ref, const char *what);
/* If all `n` objects are regions and closed curves in one plane, replaces the closed curves in the array by the regions
 * that they enclose. */
vs_status vs_bind_fill(vs_args *f, vs_ref *ref, size_t n);

#endif
