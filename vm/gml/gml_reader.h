/* Owns the conversion of a text in the Generative Modeling Language to forms of this language. */
#ifndef VS_VM_GML_GML_READER_H
#define VS_VM_GML_GML_READER_H

#include "vm/machine/native.h"

/* Reads the forms of a whole text, located, as vs_read_all does; they import the library (gml), which runs them.
 * Returns false with vm->condition set. */
bool vs_gml_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
