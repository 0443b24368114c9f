/* Chooses the reader of a picture by the file's first bytes, and contains the code that the PNG and EXR readers
 * share. */
#include "geometry/files/raster.h"

#include <string.h>

#include "geometry/files/raster_exr.h"
#include "geometry/files/raster_png.h"

void vs_raster_free(vs_raster *r) {
  if (r->at) vs_store_realloc(r->store, r->at, (size_t)r->columns * r->rows * sizeof *r->at, 0);
  r->at = NULL;
  r->columns = r->rows = 0;
}

bool vs_raster_size(const char *name, uint64_t columns, uint64_t rows, vs_error *e) {
  return (columns && rows && columns <= VS_RASTER_MOST / rows) ||
         vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the picture has %llu x %llu pixels; up to %d are read", name,
                      (unsigned long long)columns, (unsigned long long)rows, VS_RASTER_MOST);
}

bool vs_raster_room(vs_raster *r, const char *name, uint64_t columns, uint64_t rows, vs_error *e) {
  if (!vs_raster_size(name, columns, rows, e)) return false;
  r->at = vs_store_realloc(r->store, NULL, 0, (size_t)(columns * rows) * sizeof *r->at);
  if (!r->at) return vs_error_memory(e, NULL);
  memset(r->at, 0, (size_t)(columns * rows) * sizeof *r->at);
  r->columns = (uint32_t)columns;
  r->rows = (uint32_t)rows;
  return true;
}

bool vs_raster_read(vs_store *store, const vs_file_bytes *file, vs_raster *out, vs_error *e) {
  *out = (vs_raster){ .store = store };
  bool ok = false;
  if (file->size >= 8 && !memcmp(file->at, "\x89PNG\r\n\x1a\n", 8)) ok = vs_raster_png(out, file, e);
  else if (file->size >= 4 && !memcmp(file->at, "\x76\x2f\x31\x01", 4)) ok = vs_raster_exr(out, file, e);
  else vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: this is neither a PNG nor an EXR picture", file->name);
  if (!ok) vs_raster_free(out);
  return ok;
}
