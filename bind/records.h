/* Declares the flat record types of the language, defined in records.c. */
#ifndef VS_BIND_RECORDS_H
#define VS_BIND_RECORDS_H

#include "vm/machine/native.h"

/* The kinds of flat records. */
enum { VS_FLAT_POINT = 1, VS_FLAT_VECTOR, VS_FLAT_AXIS, VS_FLAT_PLANE, VS_FLAT_MATRIX, VS_FLAT_INTERVAL };

void vs_bind_flat_rules(vs_flat_rules *rules);

#endif
