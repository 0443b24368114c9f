/* Declares the removal of noise from rendered pictures. */
#ifndef VS_GEOMETRY_PICTURES_DENOISE_H
#define VS_GEOMETRY_PICTURES_DENOISE_H

#include "geometry/files/exr.h"

/* Smooths the channels R, G and B of picture x in place. *layers: true if the picture has channels of albedo and
 * normal, by which the filter keeps edges sharp. Returns false if the picture has no colours, or memory is out. */
bool vs_exr_smooth(vs_exr *x, bool *layers, vs_error *e);

#endif
