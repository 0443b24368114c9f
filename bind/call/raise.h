/* Declares the function that raises the error of a lower layer in the program. */
#ifndef VS_BIND_CALL_RAISE_H
#define VS_BIND_CALL_RAISE_H

#include "model/node.h"
#include "vm/machine/native.h"

/* Sets the error "NAME: MESSAGE" with the message of *e, where NAME is the running native. Returns VS_ERROR. */
vs_status vs_bind_error(vs_scheme *vm, const vs_error *e);

#endif
