/* Owns the layers that an EXR picture may have beside POV-Ray's light. */
#ifndef VS_BACKENDS_POVRAY_LAYERS_H
#define VS_BACKENDS_POVRAY_LAYERS_H

#include "backends/backend.h"
#include "geometry/files/exr.h"

/* Adds depth (Z, along the look), normal (N.X, N.Y, N.Z), paint (albedo.R, albedo.G, albedo.B, linear) and id of what
 * is seen in the middle of each pixel, and the places in the program that the ids from 1 stand for, a line each. The
 * ground has the id 0. The pictures show the drawing's solids and the ground: curves and surfaces are left out.
 * columns, rows: of the whole picture, of which *x is the options' part. */
bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);

#endif
