/* Reads PNG pictures as numbers: grey values unchanged, colours as luminance. */
#include "geometry/files/raster_png.h"

#include "geometry/files/png_read.h"
#include "geometry/files/raster.h"

bool vs_raster_png(vs_raster *r, const vs_file_bytes *file, vs_error *e) {
  vs_png_pixels p;
  if (!vs_png_read(r->store, file, &p, e)) return false;
  bool ok = vs_raster_room(r, file->name, p.columns, p.high, e);
  for (size_t i = 0; ok && i < (size_t)r->columns * r->rows; i++) {
    double c[3] = { vs_png_at(&p, i, 0) };
    for (unsigned k = 1; p.color && k < 3; k++) c[k] = vs_png_at(&p, i, k);
    r->at[i] = p.color ? vs_raster_share[0] * c[0] + vs_raster_share[1] * c[1] + vs_raster_share[2] * c[2] : c[0];
  }
  vs_store_realloc(r->store, p.rows, p.room, 0);
  return ok;
}

