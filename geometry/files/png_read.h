/* Declares the reading of PNG pictures without conversion of their numbers. */
#ifndef VS_GEOMETRY_FILES_PNG_READ_H
#define VS_GEOMETRY_FILES_PNG_READ_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  unsigned char *rows; /* channels of 8 bits; if deep, of 16 bits in this machine's byte order */
  size_t room;
  uint32_t columns, high;
  unsigned channels;
  bool color, deep;
} vs_png_pixels;

/* Reads a whole file that is in memory. The caller returns the rows to the store; they are NULL after a failure. */
bool vs_png_read(vs_store *store, const vs_file_bytes *file, vs_png_pixels *out, vs_error *e);
/* Returns a number of a pixel, from 0 to 1. The picture has this pixel and channel. */
double vs_png_at(const vs_png_pixels *p, size_t pixel, unsigned channel);

#endif
