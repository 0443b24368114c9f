/* Owns hash tables: insertion-ordered, keys by eq?, eqv?, equal? or string=?. */
#ifndef VS_VM_VALUES_TABLE_H
#define VS_VM_VALUES_TABLE_H

#include "vm/machine/native.h"

/* VS_TABLE_EQ ... (value.h). kind is one of VS_TABLE_EQ to VS_TABLE_STRING. */
bool vs_make_table(vs_scheme *vm, uint32_t kind, vs_value *out);
/* *out = the value, or VS_VACANT where there is none */
bool vs_table_get(vs_scheme *vm, vs_value table, vs_value key, vs_value *out);
bool vs_table_put(vs_scheme *vm, vs_value table, vs_value key, vs_value value);
bool vs_table_remove(vs_scheme *vm, vs_value table, vs_value key);
bool vs_table_clear(vs_scheme *vm, vs_value table);
/* Iteration in insertion order: *position from 0; false at the end. Entries added meanwhile are seen, removed ones
 * skipped. count is at most used. */
bool vs_table_next(vs_value table, uint32_t *position, vs_value *key, vs_value *value);

#endif
