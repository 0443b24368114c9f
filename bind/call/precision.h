/* Declares the precision that the program has set for curves and curved surfaces. */
#ifndef VS_BIND_CALL_PRECISION_H
#define VS_BIND_CALL_PRECISION_H

#include "vm/machine/native.h"

int32_t vs_bind_segments(vs_scheme *vm); /* Returns the value of (current-segments), the number of segments of a full
                                          * turn; 0: it is computed from the tolerance. */
double vs_bind_tolerance(vs_scheme *vm); /* Returns the value of (current-tolerance), in model units; 0: it is computed
                                          * from the size of the drawing. */

#endif
