/* Declares the reading of PNG pictures as they stand. */
#ifndef VS_GEOMETRY_FILES_PNG_READ_H
#define VS_GEOMETRY_FILES_PNG_READ_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  unsigned char *rows; /* channels of 8 bits, or of 16 in this machine's order where it is deep */
  size_t room;
  uint32_t columns, high;
  unsigned channels;
  bool color, deep;
} vs_png_pixels;

/* All of a file that is in memory. The rows are the caller's to give back to the store; NULL after a failure. */
bool vs_png_read(vs_store *store, const vs_file_bytes *file, vs_png_pixels *out, vs_error *e);
/* The picture has that pixel and channel. */
double vs_png_at(const vs_png_pixels *p, size_t pixel, unsigned channel); /* a number of a pixel, from 0 to 1 */

#endif
