/* Owns the conversion of a script's text to the data of a program. */
#ifndef VS_VM_JAVASCRIPT_READ_SCRIPT_H
#define VS_VM_JAVASCRIPT_READ_SCRIPT_H

#include "vm/machine/native.h"

/* Does the same as vs_read_all for a script: gives the forms of a program; the first imports the libraries for
 * scripts. `line` is the number of the text's first line. A text with mistakes gives one condition of kind `read`
 * for the first. */
bool vs_read_script(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
