/* Declares what is asked of a picture that is to lie on a surface. */
#ifndef VS_GEOMETRY_PICTURES_PHOTOGRAPH_H
#define VS_GEOMETRY_PICTURES_PHOTOGRAPH_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

typedef struct {
  const char *format; /* "png" or "jpeg" */
  uint32_t columns, rows;
  double mean[3];     /* its colour from afar, sRGB: the mean of its light */
} vs_photograph;

/* Reads all of a file that is in memory, PNG or JPEG by its first bytes. False: it is neither, cut off, broken or too
 * large. */
bool vs_photograph_read(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e);

#endif
