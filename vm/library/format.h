/* Declares the directives of format, printf and PLT's error. Values: ~a ~d as by display; ~s ~w ~v as by write.
 * Numbers: ~b ~o ~x in radix 2, 8, 16; ~e inexact. Characters: ~c the argument; ~n ~% a newline; ~~ a tilde; ~ before a
 * line end nothing. */
#ifndef VS_VM_LIBRARY_FORMAT_H
#define VS_VM_LIBRARY_FORMAT_H

#include "vm/values/printer.h"

/* Appends the control string a[control] to t. The arguments a[control+1] to a[n-1] replace its directives, each
 * ~s by at most `brief` bytes (0: no limit). Returns false with the error set. */
bool vs_format(vs_scheme *vm, const vs_value *a, int control, int n, size_t brief, vs_text *t);

#endif
