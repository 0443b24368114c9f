/* Declares hash tables in insertion order, with keys compared by eq?, eqv?, equal? or string=?. */
#ifndef VS_VM_VALUES_TABLE_H
#define VS_VM_VALUES_TABLE_H

#include "vm/machine/native.h"

/* Sets *out to a new table. kind is VS_TABLE_EQ to VS_TABLE_STRING (value.h). */
bool vs_make_table(vs_scheme *vm, uint32_t kind, vs_value *out);
/* Sets *out to the value of the key in the table, or to VS_VACANT if the key is missing. */
bool vs_table_get(vs_scheme *vm, vs_value table, vs_value key, vs_value *out);
bool vs_table_put(vs_scheme *vm, vs_value table, vs_value key, vs_value value);
bool vs_table_remove(vs_scheme *vm, vs_value table, vs_value key);
bool vs_table_clear(vs_scheme *vm, vs_value table);
/* Sets *key and *value to those of the next entry in insertion order. *position is 0 before the first call. Returns
 * false after the last entry. Entries added during an iteration are included; removed entries are not. */
bool vs_table_next(vs_value table, uint32_t *position, vs_value *key, vs_value *value);

#endif
