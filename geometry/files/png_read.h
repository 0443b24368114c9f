/* Declares the reading of PNG pictures without conversion of their numbers. */
#ifndef VS_GEOMETRY_FILES_PNG_READ_H
#define VS_GEOMETRY_FILES_PNG_READ_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  unsigned char *rows; /* numbers of the pixels, row by row, with all channels of a pixel together; if `deep` is true,
                        * 16-bit numbers in this machine's byte order, else bytes */
  size_t room;
  uint32_t columns, high;
  unsigned channels;
  bool color, deep;
} vs_png_pixels;

/* Reads a PNG file that is in memory. The caller returns out->rows to the store; it is NULL after a failure. */
bool vs_png_read(vs_store *store, const vs_file_bytes *file, vs_png_pixels *out, vs_error *e);
/* Returns the number of a pixel in one channel, scaled to 0 to 1. The pixel and the channel must be within the
 * picture. */
double vs_png_at(const vs_png_pixels *p, size_t pixel, unsigned channel);

#endif
