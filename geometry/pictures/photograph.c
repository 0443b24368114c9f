/* Reads pictures that cover surfaces (textures): checks that they are complete, and determines their size and mean
 * colour. */
#include "geometry/pictures/photograph.h"

#include <math.h>
#include <string.h>

#include "geometry/files/jpeg_read.h"
#include "geometry/files/png_read.h"

/* returns the linear light, 0 to 1, of an sRGB component x, 0 to 1, by IEC 61966-2-1 */
static double light_of(double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); }
static double screen_of(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055; }

static void mean_of(const uint64_t count[3][256], double out[3]) {
  for (int k = 0; k < 3; k++) {
    double sum = 0, all = 0;
    for (int i = 0; i < 256; i++) sum += (double)count[k][i] * light_of(i / 255.0), all += (double)count[k][i];
    out[k] = all > 0 ? fmin(1, screen_of(sum / all)) : 0;
  }
}

static bool read_png(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e) {
  vs_png_pixels p;
  uint64_t count[3][256] = { { 0 } };
  if (!vs_png_read(store, file, &p, e)) return false;
  out->format = "png", out->columns = p.columns, out->rows = p.high;
  for (size_t i = 0; i < (size_t)p.columns * p.high; i++)
    for (unsigned k = 0; k < 3; k++) count[k][lround(255 * vs_png_at(&p, i, p.color ? k : 0))]++;
  vs_store_realloc(store, p.rows, p.room, 0);
  mean_of((const uint64_t(*)[256])count, out->mean);
  return true;
}

static bool read_jpeg(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e) {
  vs_jpeg_bytes read;
  if (!vs_jpeg_read(store, file, &read, e)) return false;
  out->format = "jpeg", out->columns = read.columns, out->rows = read.rows;
  mean_of((const uint64_t(*)[256])read.count, out->mean);
  return true;
}

bool vs_photograph_read(vs_store *store, const vs_file_bytes *file, vs_photograph *out, vs_error *e) {
  *out = (vs_photograph){ .format = "jpeg" };
  if (file->size >= 8 && !memcmp(file->at, "\x89PNG\r\n\x1a\n", 8)) return read_png(store, file, out, e);
  if (file->size >= 3 && !memcmp(file->at, "\xff\xd8\xff", 3)) return read_jpeg(store, file, out, e);
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: this is neither a PNG nor a JPEG picture", file->name);
}
