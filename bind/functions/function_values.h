/* Declares the natives of functions.scm, and tapes (compiled expressions) as Scheme objects. Implemented in
 * function_values.c. */
#ifndef VS_BIND_FUNCTIONS_FUNCTION_VALUES_H
#define VS_BIND_FUNCTIONS_FUNCTION_VALUES_H

#include "geometry/functions/tape.h"
#include "vm/machine/native.h"

extern const vs_native_table vs_function_table;
extern const vs_foreign_type vs_tape_type; /* type of Scheme objects that own a vs_tape */
extern const vs_foreign_type vs_tape_field_type; /* type of Scheme objects that own a reference to a vs_tape_field */

/* Implements vs_flat_rules.call for intervals. Sets *out to an interval that contains all values of the procedure
 * `name` for arguments in the n intervals. */
bool vs_interval_call(vs_scheme *vm, const char *name, const vs_value *a, int n, vs_value *out);

#endif
