/* Declares the errors for reserved names, implemented in reserved.c. */
#ifndef VS_BIND_RESERVED_H
#define VS_BIND_RESERVED_H

#include "vm/machine/native.h"

extern const vs_native_table vs_bind_reserved_table;

#endif
