/* Declares the reading of data files for programs, implemented in data.c. */
#ifndef VS_BIND_DATA_H
#define VS_BIND_DATA_H

#include "vm/machine/native.h"

extern const vs_native_table vs_bind_data_table;

#endif
