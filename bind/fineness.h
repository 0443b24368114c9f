/* Owns the interface of fineness.c: how finely the program wants curves drawn. */
#ifndef VS_BIND_FINENESS_H
#define VS_BIND_FINENESS_H

#include "vm/machine/native.h"

int32_t vs_bind_segments(vs_scheme *vm);                   /* (current-segments), 0: by tolerance */
double vs_bind_tolerance(vs_scheme *vm);                   /* (current-tolerance), 0: by the drawing size */

#endif
