/* Declares the writing of PNG pictures. */
#ifndef VS_GEOMETRY_FILES_PNG_WRITE_H
#define VS_GEOMETRY_FILES_PNG_WRITE_H

#include "geometry/files/file_bytes.h"
#include "geometry/files/pixels.h"
#include "model/node.h"

/* Makes the bytes of a PNG file for a picture. Equal pictures become equal bytes. Returns false and leaves *out
 * unchanged on failure. */
bool vs_png_write(vs_store *store, const vs_pixels *picture, vs_made_bytes *out, vs_error *e);

#endif
