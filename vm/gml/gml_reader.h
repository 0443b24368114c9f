/* Declares the reader of the Generative Modeling Language, which converts a text to forms of Scheme. */
#ifndef VS_VM_GML_GML_READER_H
#define VS_VM_GML_GML_READER_H

#include "vm/machine/native.h"

/* Reads the forms of a text with their places, as vs_read_all does. The forms begin with an import of the library
 * (gml), which implements the language. If it fails, sets the VM's error and returns false. */
bool vs_gml_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
