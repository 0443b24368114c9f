/* Declares the precision that the program has set for curves and curved surfaces. */
#ifndef VS_BIND_CALL_PRECISION_H
#define VS_BIND_CALL_PRECISION_H

#include "vm/machine/native.h"

int32_t vs_bind_segments(vs_scheme *vm); /* Returns (current-segments); 0: computed from the tolerance. */
double vs_bind_tolerance(vs_scheme *vm); /* Returns (current-tolerance); 0: computed from the size of the drawing. */

#endif
