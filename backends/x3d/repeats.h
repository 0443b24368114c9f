/* Declares the search for repeated stretches in a drawing of very many shapes. */
#ifndef VS_BACKENDS_X3D_REPEATS_H
#define VS_BACKENDS_X3D_REPEATS_H

#include "backends/x3d/x3d.h"

bool vs_x3d_repeats(vs_emitter *e); /* makes templates of the repeated stretches of the drawing */

#endif
