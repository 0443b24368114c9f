/* Declares the layers that an EXR picture may have in addition to POV-Ray's light. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_LAYERS_H
#define VS_BACKENDS_POVRAY_POVRAY_LAYERS_H

#include "backends/backend.h"
#include "geometry/files/exr.h"

/* Writes the camera and the sun's direction into the picture's texts. columns, rows: size of the entire picture in
 * pixels. */
bool vs_povray_say_view(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);
/* Adds layers for the surface at the centre of each pixel: depth, normal, paint, id, material and ambient occlusion.
 * Adds texts that list the origins and materials by number. columns, rows: size of the entire picture in pixels. *x is
 * the part that the options select. */
bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);

#endif
