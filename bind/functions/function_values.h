/* Owns the interface of function_values.c: the natives of functions.scm, and tapes as Scheme objects. */
#ifndef VS_BIND_FUNCTIONS_FUNCTION_VALUES_H
#define VS_BIND_FUNCTIONS_FUNCTION_VALUES_H

#include "geometry/functions/tape.h"
#include "vm/machine/native.h"

extern const vs_native_table vs_function_table;
extern const vs_foreign_type vs_tape_type; /* owns a vs_tape */
extern const vs_foreign_type vs_tape_field_type; /* owns a count of a vs_tape_field */

/* vs_flat_rules.call for intervals: sets *out to an interval that contains the values of the procedure of this name. */
bool vs_interval_call(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out);

#endif
