/* Owns reading PNG pictures by libpng, loaded at the first one.
 *
 * libpng's simple interface reports errors by its results. It would bend the numbers by what a file says of gamma and
 * colour profiles; heights are numbers as they stand, so it is handed a copy of the file with the critical chunks
 * alone. Eight bits then come as they are, and sixteen, which it takes for linear, too. */
#include "geometry/files/raster.h"

#include <png.h>
#include <string.h>

#include "geometry/dynamic.h"

/* Deflate packs at most so many bytes into one: a size that the file has no room for is a lie, and no memory is asked
 * for it. */
enum { DEFLATE_MOST = 1032 };

typedef struct {
  int (*begin)(png_imagep, png_const_voidp, size_t);
  int (*finish)(png_imagep, png_const_colorp, void *, png_int_32, void *);
  void (*free)(png_imagep);
} png_functions;

static const vs_dynamic_name png_names[] = {
  { "png_image_begin_read_from_memory", offsetof(png_functions, begin) },
  { "png_image_finish_read", offsetof(png_functions, finish) },
  { "png_image_free", offsetof(png_functions, free) },
};

static const char *const png_files[] = { "libpng16.so.16", "libpng16.so", NULL };
const vs_dynamic_library vs_png_library = { png_files, "libpng16-16", "PNG pictures" };

static uint32_t png_number(const unsigned char *b) {
  return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | (uint32_t)b[3];
}

/* Copies signature and critical chunks (capital first letter). Returns the size; 0: it is cut off or does not begin
 * with its header. */
static size_t png_bare(const unsigned char *bytes, size_t size, unsigned char *to) {
  size_t at = 8, kept = 8;
  memcpy(to, bytes, 8);
  if (size < 33 || memcmp(bytes + 12, "IHDR", 4) || png_number(bytes + 8) != 13) return 0;
  while (size - at >= 12) {
    size_t length = png_number(bytes + at);
    if (length > size - at - 12) return 0;
    if (!(bytes[at + 4] & 0x20)) {
      memcpy(to + kept, bytes + at, length + 12);
      kept += length + 12;
    }
    if (!memcmp(bytes + at + 4, "IEND", 4)) return kept;
    at += length + 12;
  }
  return 0;
}

bool vs_raster_png(vs_raster *r, const char *name, const unsigned char *bytes, size_t size, vs_error *e) {
  png_functions call;
  if (!vs_dynamic_load(&vs_png_library, png_names, sizeof png_names / sizeof *png_names, &call, e)) return false;
  unsigned char *bare = vs_store_realloc(r->store, NULL, 0, size);
  if (!bare) return vs_error_memory(e, NULL);
  size_t kept = png_bare(bytes, size, bare), line = 0;
  if (!kept)
    return vs_store_realloc(r->store, bare, size, 0),
           vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the PNG file is cut off or broken", name);
  bool deep = bare[24] == 16, color = bare[25] & 2, alpha = bare[25] & 4;
  unsigned channels = (color ? 3u : 1u) + (alpha ? 1u : 0u);
  unsigned char *rows = NULL;
  png_image image;
  memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  uint64_t columns = png_number(bare + 16), high = png_number(bare + 20), most = (uint64_t)kept * DEFLATE_MOST;
  bool lies = columns && high && high <= VS_RASTER_MOST / columns && high > most * 8 / columns;
  bool ok = !lies || vs_error_set(e, VS_ERROR_MODEL, NULL,
                                  "%.100s: the PNG file is too short for a picture of %llu x %llu pixels", name,
                                  (unsigned long long)columns, (unsigned long long)high);
  ok = ok && vs_raster_room(r, name, columns, high, e);
  if (ok) {
    line = (size_t)r->columns * channels * (deep ? 2 : 1);
    rows = vs_store_realloc(r->store, NULL, 0, line * r->rows);
    ok = rows || vs_error_memory(e, NULL);
  }
  bool read = ok && call.begin(&image, bare, kept);
  image.format = (color ? PNG_FORMAT_FLAG_COLOR : 0u) | (alpha ? PNG_FORMAT_FLAG_ALPHA : 0u) |
                 (deep ? PNG_FORMAT_FLAG_LINEAR : 0u);
  read = read && image.width == r->columns && image.height == r->rows && call.finish(&image, NULL, rows, 0, NULL);
  /* "out of memory", "insufficient memory" */
  if (ok && !read && strstr(image.message, "memory")) ok = vs_error_memory(e, NULL);
  else if (ok && !read)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: %s", name,
                      *image.message ? image.message : "the PNG file is broken");
  for (size_t i = 0; ok && i < (size_t)r->columns * r->rows; i++) {
    double c[3];
    for (unsigned k = 0; k < (color ? 3u : 1u); k++) {
      size_t at = i * channels + k;
      uint16_t two = 0;
      if (deep) memcpy(&two, rows + 2 * at, 2);
      c[k] = deep ? two / 65535.0 : rows[at] / 255.0;
    }
    r->at[i] = color ? vs_raster_share[0] * c[0] + vs_raster_share[1] * c[1] + vs_raster_share[2] * c[2] : c[0];
  }
  call.free(&image);
  if (rows) vs_store_realloc(r->store, rows, line * r->rows, 0);
  vs_store_realloc(r->store, bare, size, 0);
  return ok;
}
