/* Declares the reading of JPEG pictures. */
#ifndef VS_GEOMETRY_FILES_JPEG_READ_H
#define VS_GEOMETRY_FILES_JPEG_READ_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

/* columns, rows: size of a picture in pixels. count[k][b]: number of pixels whose colour component k has the value b,
 * counted in the picture at an eighth of its size. */
typedef struct { uint32_t columns, rows; uint64_t count[3][256]; } vs_jpeg_bytes;

/* Reads a JPEG file that is in memory. Returns false if it is truncated, broken or too large. */
bool vs_jpeg_read(vs_store *store, const vs_file_bytes *file, vs_jpeg_bytes *out, vs_error *e);

#endif
