/* Declares the reader of scripts in JavaScript. */
#ifndef VS_VM_JAVASCRIPT_READ_SCRIPT_H
#define VS_VM_JAVASCRIPT_READ_SCRIPT_H

#include "vm/machine/native.h"

/* Converts a script to the forms of a program, of which the first imports the libraries for scripts. `line` is the
 * number of the text's first line. If the script has mistakes, sets an error of kind `read` for the first mistake, and
 * returns false. */
bool vs_read_script(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
