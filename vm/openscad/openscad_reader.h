/* Declares the reader of OpenSCAD. */
#ifndef VS_VM_OPENSCAD_OPENSCAD_READER_H
#define VS_VM_OPENSCAD_OPENSCAD_READER_H

#include "vm/values/value.h"

/* Reads a program in OpenSCAD, with the files that it includes and uses, as forms of Scheme with their places. If the
 * text has a mistake, sets an error of kind `read`. Arguments as for the readers of vm/front/front_ends.def. */
bool vs_openscad_read(vs_scheme *vm, const char *text, size_t size, uint32_t file, uint32_t line, vs_value *forms);

#endif
