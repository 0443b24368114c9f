/* Owns the interface of records.c: the flat record types of the language. */
#ifndef VS_BIND_RECORDS_H
#define VS_BIND_RECORDS_H

#include "vm/machine/native.h"

/* The tags of flat records. */
enum { VS_FLAT_POINT = 1, VS_FLAT_VECTOR, VS_FLAT_AXIS, VS_FLAT_PLANE, VS_FLAT_MATRIX, VS_FLAT_INTERVAL };

void vs_bind_flat_rules(vs_flat_rules *rules);

#endif
