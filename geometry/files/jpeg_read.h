/* Declares the reading of JPEG pictures. */
#ifndef VS_GEOMETRY_FILES_JPEG_READ_H
#define VS_GEOMETRY_FILES_JPEG_READ_H

#include "model/node.h"

/* Reads all of a file that is in memory, at an eighth of its size, and tells its size and the mean number of each byte
 * of red, green and blue by `count`: how often it stands in the picture made small. False: it is cut off, broken or too
 * large, and the error says so. */
bool vs_jpeg_read(vs_store *store, const char *name, const unsigned char *bytes, size_t size, uint32_t *columns,
                  uint32_t *rows, uint64_t count[3][256], vs_error *e);

#endif
