/* Declares the reading of pictures as numbers for height fields: PNG and EXR files, with one number for each pixel. */
#ifndef VS_GEOMETRY_FILES_RASTER_H
#define VS_GEOMETRY_FILES_RASTER_H

#include "geometry/dynamic.h"
#include "geometry/files/file_bytes.h"
#include "model/node.h"

enum { VS_RASTER_MOST = 1 << 26 }; /* greatest number of pixels of a picture */

typedef struct {
  double *at; /* one number for each pixel, row by row from the top: 0 (black) to 1 (white) for a PNG file, the stored
               * numbers for an EXR file */
  uint32_t columns, rows;
  vs_store *store; /* store whose memory `at` uses */
} vs_raster;
void vs_raster_free(vs_raster *r);

/* Reads a PNG or EXR picture that is in memory. The number of a pixel is its grey value; for a colour, its luminance
 * (Rec. 709). *out needs no initialisation, and is empty after a failure. */
bool vs_raster_read(vs_store *store, const vs_file_bytes *file, vs_raster *out, vs_error *e);

/* Returns true if a picture of this size can be read. Otherwise sets e to a message with the greatest number of
 * pixels. */
bool vs_raster_size(const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* Allocates the numbers of a picture, for the readers of PNG and EXR files. Returns false and sets e on failure. */
bool vs_raster_room(vs_raster *r, const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* weights of red, green and blue in the luminance (Rec. 709) */
static const double vs_raster_share[3] = { 0.2126, 0.7152, 0.0722 };

#endif
