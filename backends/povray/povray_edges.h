/* Declares the lines for the style 'technical: the visible edges of the drawing's solids as thin black rods. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_EDGES_H
#define VS_BACKENDS_POVRAY_POVRAY_EDGES_H

#include "backends/backend.h"

/* Writes the lines for a picture of width by height pixels. A panorama gets no lines. Returns false with e's error set
 * if the solids cannot be computed, memory is out or the caller interrupts. */
bool vs_povray_edges(vs_emitter *e, int width, int height);

#endif
