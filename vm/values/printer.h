/* Owns the external representation of values: display, write, write-simple, write-shared, and the text of errors. */
#ifndef VS_VM_VALUES_PRINTER_H
#define VS_VM_VALUES_PRINTER_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

typedef enum {
  VS_PRINT_DISPLAY,      /* strings and characters without quotes; labels only for cycles */
  VS_PRINT_WRITE,        /* readable; labels only for cycles */
  VS_PRINT_SIMPLE,       /* readable; no labels (a cycle reaches the limits) */
  VS_PRINT_SHARED        /* readable; labels for all shared objects */
} vs_print_mode;

/* Appends v to t. Depth needs no C stack; a list of a million elements needs no memory beyond its text. */
bool vs_print(vs_scheme *vm, vs_value v, vs_print_mode mode, vs_text *t);

/* Appends the message and irritants of a CONDITION ("car: expected a pair, got 5"), or "uncaught raise: " and any other
 * object. */
bool vs_print_condition(vs_scheme *vm, vs_value condition, vs_text *t);

#endif
