/* Owns the reading of plain C data out of values.
 *
 * Names in bind/ follow one rule: vs_bind_take_X reads an X out of a value; vs_bind_give_X makes a value of an X
 * (build.h, objects.h, rules/scope.h). */
#ifndef VS_BIND_CALL_TAKE_H
#define VS_BIND_CALL_TAKE_H

#include "vm/machine/native.h"

/* Reads any real number. Returns false, without an error, for other values. */
bool vs_bind_take_number(vs_scheme *vm, vs_value v, double *out);
/* Reads two or three numbers from a list or a vector. Returns their count; 0 for other values. */
int vs_bind_take_numbers(vs_scheme *vm, vs_value v, double d[3]);

/* Copies a string's or symbol's UTF-8 with a NUL into memory from vs_mem; the caller frees *bytes. Returns false with
 * the error set. */
bool vs_bind_take_text(vs_scheme *vm, vs_value string_or_symbol, char **out, size_t *bytes);

int32_t vs_bind_segments(vs_scheme *vm); /* (current-segments); 0: by tolerance */
double vs_bind_tolerance(vs_scheme *vm); /* (current-tolerance); 0: by the drawing's size */

#endif
