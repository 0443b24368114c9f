/* Declares the natives that take files of other programs apart, implemented in file_texts.c. */
#ifndef VS_BIND_INCOMING_FILE_TEXTS_H
#define VS_BIND_INCOMING_FILE_TEXTS_H

#include "vm/machine/native.h"

extern const vs_native_table vs_incoming_table;

#endif
