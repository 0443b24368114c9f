/* Declares the reading of JPEG pictures. */
#ifndef VS_GEOMETRY_FILES_JPEG_READ_H
#define VS_GEOMETRY_FILES_JPEG_READ_H

#include "geometry/files/file_bytes.h"
#include "model/node.h"

/* The size of a picture in pixels; count: how often each byte of red, green and blue occurs in the picture at an eighth
 * of its size. */
typedef struct { uint32_t columns, rows; uint64_t count[3][256]; } vs_jpeg_bytes;

/* Reads all of a file that is in memory. False: it is cut off, broken or too large, and the error says so. */
bool vs_jpeg_read(vs_store *store, const vs_file_bytes *file, vs_jpeg_bytes *out, vs_error *e);

#endif
