/* Declares the reading of a picture that is to cover a surface (a texture). */
#ifndef VS_GEOMETRY_PICTURES_PHOTOGRAPH_H
#define VS_GEOMETRY_PICTURES_PHOTOGRAPH_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  const char *format; /* format of the file: "png" or "jpeg" */
  uint32_t columns, rows;
  double mean[3];     /* mean of the picture's linear light, converted to sRGB: its colour as seen from far away */
} vs_photograph;

/* Reads a PNG or JPEG file that is in memory. Returns false if the file has neither format, is truncated, broken or too
 * large. */
bool vs_photograph_read(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e);

#endif
