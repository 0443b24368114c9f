/* Declares the printer: display, write, write-simple, write-shared, and the texts of errors. */
#ifndef VS_VM_VALUES_PRINTER_H
#define VS_VM_VALUES_PRINTER_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

typedef enum {
  VS_PRINT_DISPLAY,      /* text as by display: strings and characters without quotes; labels only for cycles */
  VS_PRINT_WRITE,        /* text that can be read again; labels only for cycles */
  VS_PRINT_SIMPLE,       /* text that can be read again; no labels, so that printing a cycle ends only at a limit */
  VS_PRINT_SHARED        /* text that can be read again; labels for all shared objects */
} vs_print_mode;

/* Appends v to t. Deep structures need no C stack, and a list of a million elements needs no memory except its text. */
bool vs_print(vs_scheme *vm, vs_value v, vs_print_mode mode, vs_text *t);

/* Appends the message and irritants of a CONDITION ("car: expected a pair, got 5"). For any other object, appends
 * "uncaught raise: " and the object. */
bool vs_print_condition(vs_scheme *vm, vs_value condition, vs_text *t);

#endif
