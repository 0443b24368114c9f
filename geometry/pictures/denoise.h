/* Owns taking noise out of pictures. */
#ifndef VS_GEOMETRY_PICTURES_DENOISE_H
#define VS_GEOMETRY_PICTURES_DENOISE_H

#include "geometry/files/exr.h"

/* Smooths R, G and B of the picture, in its place; the other channels stay. False: it has no colours, or memory ran
 * out. *layers: it went by albedo and normal, and not by the colours alone. */
bool vs_exr_smooth(vs_exr *x, bool *layers, vs_error *e);

#endif
