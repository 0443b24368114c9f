/* Owns the layers that an EXR picture may have beside POV-Ray's light. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_LAYERS_H
#define VS_BACKENDS_POVRAY_POVRAY_LAYERS_H

#include "backends/backend.h"
#include "geometry/files/exr.h"

/* Says in the picture's texts how it was looked at and where the sun stood. columns, rows: of the whole picture. */
bool vs_povray_say_view(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);
/* Adds depth (Z, along the look; of a panorama the distance), normal (N.X, N.Y, N.Z), paint (albedo.R, albedo.G,
 * albedo.B, linear), id, material and openness (AO) of what is seen in the middle of each pixel, and the places in the
 * program and the materials that the numbers from 1 stand for, a line each. The ground has the id 0.
 * The pictures show the drawing's solids and the ground: curves and surfaces are left out.
 * columns, rows: of the whole picture, of which *x is the options' part. */
bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);

#endif
