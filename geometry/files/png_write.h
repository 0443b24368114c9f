/* Declares writing PNG pictures. */
#ifndef VS_GEOMETRY_FILES_PNG_WRITE_H
#define VS_GEOMETRY_FILES_PNG_WRITE_H

#include "geometry/files/file_bytes.h"
#include "geometry/files/pixels.h"
#include "model/node.h"

/* Makes a PNG: the same bytes for the same pixels. A failure leaves *out unchanged. */
bool vs_png_write(vs_store *store, const vs_pixels *picture, vs_made_bytes *out, vs_error *e);

#endif
