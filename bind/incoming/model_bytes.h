/* Declares the natives that convert model files to Scheme data, implemented in model_bytes.c. */
#ifndef VS_BIND_INCOMING_MODEL_BYTES_H
#define VS_BIND_INCOMING_MODEL_BYTES_H

#include "vm/machine/native.h"

extern const vs_native_table vs_model_bytes_table;

#endif
