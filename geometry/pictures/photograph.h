/* Declares the reading of a picture for a surface. */
#ifndef VS_GEOMETRY_PICTURES_PHOTOGRAPH_H
#define VS_GEOMETRY_PICTURES_PHOTOGRAPH_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  const char *format; /* "png" or "jpeg" */
  uint32_t columns, rows;
  double mean[3];     /* the mean of its light, as sRGB: its colour from far away */
} vs_photograph;

/* Reads a whole file that is in memory, PNG or JPEG by its first bytes. Returns false if it is neither, truncated,
 * broken or too large. */
bool vs_photograph_read(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e);

#endif
