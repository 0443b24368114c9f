/* Owns reading pictures as numbers: PNG and EXR, one number a pixel, for height fields. */
#ifndef VS_GEOMETRY_FILES_RASTER_H
#define VS_GEOMETRY_FILES_RASTER_H

#include "geometry/dynamic.h"
#include "geometry/files/file_bytes.h"
#include "model/node.h"

enum { VS_RASTER_MOST = 1 << 26 }; /* pixels */

typedef struct {
  double *at; /* row by row from the top: of a PNG 0 for black to 1 for white, of an EXR what stands in it */
  uint32_t columns, rows;
  vs_store *store; /* whose memory it is */
} vs_raster;
void vs_raster_free(vs_raster *r);

/* All of a file that is in memory; by its first bytes. Grey is taken as it is, of colours the luminance (Rec. 709) of
 * the numbers as they stand; an EXR's Y, else its one channel, else the luminance of R, G and B. Out need not be
 * initialised and is empty after a failure. The libraries are loaded at the first use. */
bool vs_raster_read(vs_store *store, const vs_file_bytes *file, vs_raster *out, vs_error *e);

/* Is there room for such a picture? False: the error says how many pixels are read. */
bool vs_raster_size(const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* The two readers; room for the pixels comes from vs_raster_room. */
bool vs_raster_room(vs_raster *r, const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* of red, green and blue in the luminance (Rec. 709) */
static const double vs_raster_share[3] = { 0.2126, 0.7152, 0.0722 };

extern const vs_dynamic_library vs_png_library; /* libpng */

#endif
