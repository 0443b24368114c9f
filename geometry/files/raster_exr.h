/* Owns the interface of raster_exr.c: which numbers of an EXR picture are its heights. */
#ifndef VS_GEOMETRY_FILES_RASTER_EXR_H
#define VS_GEOMETRY_FILES_RASTER_EXR_H

#include "geometry/files/raster.h"

bool vs_raster_exr(vs_raster *r, const char *name, const unsigned char *bytes, size_t size, vs_error *e);

#endif
