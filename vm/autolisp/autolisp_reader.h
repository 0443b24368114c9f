/* Declares the reader of AutoLISP, which converts a text to forms of Scheme. */
#ifndef VS_VM_AUTOLISP_AUTOLISP_READER_H
#define VS_VM_AUTOLISP_AUTOLISP_READER_H

#include "vm/machine/native.h"

/* Reads the forms of a text with their places, as vs_read_all does. The forms begin with an import of the library
 * (autolisp), which implements the language. If it fails, sets vm->condition and returns false. */
bool vs_autolisp_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
