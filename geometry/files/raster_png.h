/* Declares the reading of PNG pictures as one number for each pixel. */
#ifndef VS_GEOMETRY_FILES_RASTER_PNG_H
#define VS_GEOMETRY_FILES_RASTER_PNG_H

#include "geometry/files/raster.h"

bool vs_raster_png(vs_raster *r, const vs_file_bytes *file, vs_error *e);

#endif
