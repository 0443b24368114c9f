/* Declares lamps as POV-Ray's lights. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_LAMPS_H
#define VS_BACKENDS_POVRAY_POVRAY_LAMPS_H

#include "backends/backend.h"

/* Writes the scene's lamps. per_candela: value in the scene that represents a luminance of 1 cd/m2. Returns false with
 * the error set. */
bool vs_povray_lamps(vs_emitter *e, double per_candela);

#endif
