/* Declares the natives that parse files of other programs. Implemented in file_texts.c. */
#ifndef VS_BIND_INCOMING_FILE_TEXTS_H
#define VS_BIND_INCOMING_FILE_TEXTS_H

#include "vm/machine/native.h"
#include "vm/values/text.h"

/* Copies the bytes of a file to *text, because the garbage collector may move the original bytes. Skips a byte order
 * mark. */
bool vs_incoming_read(vs_scheme *vm, vs_value path, vs_text *text);
/* Sets the error "PATH:LINE: WHY", and returns false. */
vs_status vs_incoming_broken(vs_scheme *vm, vs_value path, size_t line, const char *why);

extern const vs_native_table vs_incoming_table;

#endif
