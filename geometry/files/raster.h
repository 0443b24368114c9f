/* Declares reading pictures as numbers, for height fields: PNG and EXR, one number for each pixel. */
#ifndef VS_GEOMETRY_FILES_RASTER_H
#define VS_GEOMETRY_FILES_RASTER_H

#include "geometry/dynamic.h"
#include "geometry/files/file_bytes.h"
#include "model/node.h"

enum { VS_RASTER_MOST = 1 << 26 }; /* pixels of the largest picture */

typedef struct {
  double *at; /* row by row from the top: of a PNG, from 0 (black) to 1 (white); of an EXR, the stored number */
  uint32_t columns, rows;
  vs_store *store; /* the owner of the memory */
} vs_raster;
void vs_raster_free(vs_raster *r);

/* Reads a whole file that is in memory; its first bytes determine the format. Numbers: grey unchanged; of colours the
 * luminance (Rec. 709) of the stored numbers; of an EXR Y, else its only channel, else the luminance of R, G and B.
 * *out needs no initialisation, and is empty after a failure. The libraries are loaded at their first use. */
bool vs_raster_read(vs_store *store, const vs_file_bytes *file, vs_raster *out, vs_error *e);

/* Returns true if a picture of this size can be read; else the error gives the largest number of pixels. */
bool vs_raster_size(const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* Allocates the pixels, for the two readers. */
bool vs_raster_room(vs_raster *r, const char *name, uint64_t columns, uint64_t rows, vs_error *e);
/* weights of red, green and blue in the luminance (Rec. 709) */
static const double vs_raster_share[3] = { 0.2126, 0.7152, 0.0722 };

extern const vs_dynamic_library vs_png_library; /* libpng */

#endif
