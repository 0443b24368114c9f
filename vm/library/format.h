/* Owns the directives of format, printf and PLT's error: ~a ~d display, ~s ~w ~v written, ~c a character, ~b ~o ~x ~e
 * number in a radix (~e: inexact), ~n ~% a newline, ~~ a tilde, ~ with a line's end nothing. */
#ifndef VS_VM_LIBRARY_FORMAT_H
#define VS_VM_LIBRARY_FORMAT_H

#include "vm/values/printer.h"

/* Appends a[control], a string, with a[control+1 ... n-1] in place of its directives. */
bool vs_format(vs_scheme *vm, const vs_value *a, int control, int n, vs_text *t);

#endif
