/* Declares the layers that an EXR picture may have in addition to POV-Ray's light. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_LAYERS_H
#define VS_BACKENDS_POVRAY_POVRAY_LAYERS_H

#include "backends/backend.h"
#include "geometry/files/exr.h"

/* Writes the camera and the sun's direction into the picture's texts. columns, rows: size of the entire picture in
 * pixels. */
bool vs_povray_say_view(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);
/* Adds layers for the surface at the centre of each pixel: depth (Z), normal (N.X, N.Y, N.Z), paint (albedo.R,
 * albedo.G, albedo.B, linear), id, material and ambient occlusion (AO). Depth is measured along the direction of view;
 * in a panorama it is the distance from the eye. Adds texts with a line for each origin in the program and each
 * material, in the order of their numbers from 1. The ground has the id 0. The layers show the drawing's solids and the
 * ground, but no curves and surfaces. columns, rows: size of the entire picture in pixels. *x is the part of the
 * picture that the options select. */
bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows);

#endif
