/* Declares the natives that parse files of other programs. Implemented in file_texts.c. */
#ifndef VS_BIND_INCOMING_FILE_TEXTS_H
#define VS_BIND_INCOMING_FILE_TEXTS_H

#include "vm/machine/native.h"

extern const vs_native_table vs_incoming_table;

#endif
