/* Declares functions that read C data from values.
 *
 * Names in bind/ follow one rule: vs_bind_take_X reads an X from a value; vs_bind_give_X creates a value from an X
 * (give.h, objects.h, rules/scope.h). */
#ifndef VS_BIND_CALL_TAKE_H
#define VS_BIND_CALL_TAKE_H

#include "vm/machine/native.h"

/* Reads a real number of any type. Returns false, without an error, for other values. */
bool vs_bind_take_number(vs_scheme *vm, vs_value v, double *out);
/* Reads two or three numbers from a list or vector to d. Returns how many it has read; 0 if v is no such list or
 * vector. */
int vs_bind_take_numbers(vs_scheme *vm, vs_value v, double d[3]);

/* Copies the UTF-8 text of a string or symbol, with a NUL. The copy *out is memory of vs_mem, which the caller frees.
 * If it fails, sets the error and returns false. */
bool vs_bind_take_text(vs_scheme *vm, vs_value string_or_symbol, char **out, size_t *bytes);

#endif
