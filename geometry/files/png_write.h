/* Owns writing PNG pictures. */
#ifndef VS_GEOMETRY_FILES_PNG_WRITE_H
#define VS_GEOMETRY_FILES_PNG_WRITE_H

#include "model/node.h"

/* Makes a PNG of 3 bytes a pixel, sRGB: *bytes are the store's, *room what to give back. The same bytes for the same
 * pixels. */
bool vs_png_write(vs_store *store, const unsigned char *rgb, uint32_t columns, uint32_t rows, unsigned char **bytes,
                  size_t *size, size_t *room, vs_error *e);

#endif
