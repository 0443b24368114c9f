/* Reads PNG pictures with libpng, which is loaded at its first use.
 *
 * libpng's simple interface reports errors as results, but transforms the numbers by the file's gamma and colour
 * profile. Heights need the stored numbers. Therefore libpng gets a copy of the file with only its critical chunks. It
 * then returns numbers of eight bits unchanged. It also returns sixteen bits unchanged, because it assumes that they
 * are linear. */
#include "geometry/files/png_read.h"

#include <png.h>
#include <string.h>

#include "geometry/dynamic.h"
#include "geometry/files/raster.h"

/* Greatest number of bytes that deflate compresses to one byte. If the file is too short for a picture of the stated
 * size, the size is refused, and no memory is allocated. */
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

static uint32_t png_number(const unsigned char *b) {
  return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | (uint32_t)b[3];
}

/* Copies the file's signature and its critical chunks, whose names begin with a capital letter, to `to`. Returns the
 * number of copied bytes; 0: the file is truncated or does not begin with its header chunk. */
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

bool vs_png_read(vs_store *store, const vs_file_bytes *file, vs_png_pixels *out, vs_error *e) {
  png_functions call;
  *out = (vs_png_pixels){ 0 };
  if (!vs_dynamic_load(VS_LIBRARY_PNG, "PNG pictures", png_names, sizeof png_names / sizeof *png_names, &call, e))
    return false;
  unsigned char *bare = vs_store_realloc(store, NULL, 0, file->size);
  if (!bare) return vs_error_memory(e, NULL);
  size_t kept = png_bare(file->at, file->size, bare);
  if (!kept)
    return vs_store_realloc(store, bare, file->size, 0),
           vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the PNG file is cut off or broken", file->name);
  bool alpha = bare[25] & 4;
  out->deep = bare[24] == 16, out->color = bare[25] & 2;
  out->channels = (out->color ? 3u : 1u) + (alpha ? 1u : 0u);
  png_image image;
  memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  uint64_t columns = png_number(bare + 16), high = png_number(bare + 20), most = (uint64_t)kept * DEFLATE_MOST;
  bool lies = columns && high && high <= VS_RASTER_MOST / columns && high > most * 8 / columns;
  bool ok = !lies || vs_error_set(e, VS_ERROR_MODEL, NULL,
                                  "%.100s: the PNG file is too short for a picture of %llu x %llu pixels", file->name,
                                  (unsigned long long)columns, (unsigned long long)high);
  ok = ok && vs_raster_size(file->name, columns, high, e);
  if (ok) {
    out->columns = (uint32_t)columns, out->high = (uint32_t)high;
    out->room = (size_t)columns * out->channels * (out->deep ? 2 : 1) * high;
    out->rows = vs_store_realloc(store, NULL, 0, out->room);
    ok = out->rows || vs_error_memory(e, NULL);
  }
  bool read = ok && call.begin(&image, bare, kept);
  image.format = (out->color ? PNG_FORMAT_FLAG_COLOR : 0u) | (alpha ? PNG_FORMAT_FLAG_ALPHA : 0u) |
                 (out->deep ? PNG_FORMAT_FLAG_LINEAR : 0u);
  read = read && image.width == out->columns && image.height == out->high && call.finish(&image, NULL, out->rows, 0,
                                                                                         NULL);
  /* libpng says in its message, "out of memory" or "insufficient memory", that memory is out */
  if (ok && !read && strstr(image.message, "memory")) ok = vs_error_memory(e, NULL);
  else if (ok && !read)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: %s", file->name,
                      *image.message ? image.message : "the PNG file is broken");
  call.free(&image);
  vs_store_realloc(store, bare, file->size, 0);
  if (!ok && out->rows) vs_store_realloc(store, out->rows, out->room, 0), out->rows = NULL;
  return ok;
}

double vs_png_at(const vs_png_pixels *p, size_t pixel, unsigned channel) {
  size_t at = pixel * p->channels + channel;
  uint16_t two;
  VS_ASSERT(channel < p->channels && pixel < (size_t)p->columns * p->high);
  if (!p->deep) return p->rows[at] / 255.0;
  memcpy(&two, p->rows + 2 * at, 2);
  return two / 65535.0;
}
