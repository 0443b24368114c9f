/* Writes PNG pictures with libpng, which is loaded at its first use. The files contain no date.
 *
 * Compression used to be the slowest step of developing a picture. For a rendering of 960 by 720 pixels, libpng's
 * default (five filters tried for each row, zlib level 6) takes 160 ms. The Paeth filter with run lengths alone (Z_RLE)
 * takes 25 ms, and makes files 3 to 6 % larger. libpng's simple interface does not offer this choice. Its other
 * interface reports errors by longjmp; the jumps stay within png_rows. */
#include "geometry/files/png_write.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "geometry/files/raster.h"

/* X macro that lists the libpng functions that this file calls, as rows F(member, symbol, result, parameters). */
#define PNG_FUNCTIONS(F)                                                                                               \
  F(open, png_create_write_struct, png_structp, (const char *, void *, png_error_ptr, png_error_ptr))                  \
  F(info, png_create_info_struct, png_infop, (png_structp))                                                            \
  F(put, png_set_write_fn, void, (png_structp, void *, png_rw_ptr, png_flush_ptr))                                     \
  F(head, png_set_IHDR, void, (png_structp, png_infop, png_uint_32, png_uint_32, int, int, int, int, int))             \
  F(screen, png_set_sRGB, void, (png_structp, png_infop, int))                                                         \
  F(limits, png_set_user_limits, void, (png_structp, png_uint_32, png_uint_32))                                        \
  F(level, png_set_compression_level, void, (png_structp, int))                                                        \
  F(strategy, png_set_compression_strategy, void, (png_structp, int))                                                  \
  F(filter, png_set_filter, void, (png_structp, int, int))                                                             \
  F(write_info, png_write_info, void, (png_structp, png_infop))                                                        \
  F(write_row, png_write_row, void, (png_structp, const unsigned char *))                                              \
  F(write_end, png_write_end, void, (png_structp, png_infop))                                                          \
  F(close, png_destroy_write_struct, void, (png_structpp, png_infopp))

VS_DYNAMIC_FUNCTIONS(PNG_FUNCTIONS);

typedef struct {
  dynamic_functions call;
  png_structp png;
  png_infop info;
  vs_store *store;
  vs_made_bytes made;
  bool no_memory;
  char message[100];
  jmp_buf failed;
} png_sink;

/* Returns the destination of the bytes that libpng writes. libpng's callbacks get only libpng's own structure; to read
 * the destination from it, this function loads the library again, which takes some microseconds. */
static png_sink *png_sink_of(png_structp png) {
  struct { void *(*sink)(png_const_structp); } call = { NULL };
  static const vs_dynamic_name name = { "png_get_error_ptr", 0 };
  vs_error none = { VS_ERROR_NONE, NULL, "" };
  return vs_dynamic_load(VS_LIBRARY_PNG, "PNG pictures", &name, 1, &call, &none) ? call.sink(png) : NULL;
}

static void png_failed(png_structp png, const char *message) {
  png_sink *s = png_sink_of(png);
  snprintf(s->message, sizeof s->message, "%s", message);
  longjmp(s->failed, 1);
}
static void png_warned(png_structp png, const char *message) { (void)png, (void)message; }
static void png_flushed(png_structp png) { (void)png; }

static void png_take(png_structp png, unsigned char *bytes, size_t count) {
  png_sink *s = png_sink_of(png);
  vs_made_bytes *made = &s->made;
  if (count > made->room - made->size) {
    size_t room = made->room + made->room / 2 + count + 4096;
    unsigned char *more = vs_store_realloc(s->store, made->at, made->room, room);
    s->no_memory = more == NULL;
    if (s->no_memory) png_failed(png, "out of memory");
    made->at = more, made->room = room;
  }
  memcpy(made->at + made->size, bytes, count);
  made->size += count;
}

/* Writes the picture as a PNG file into the sink s, which receives its bytes. Returns false and sets the sink's message
 * on failure. After a longjmp, only the sink is read, because local variables may be indeterminate. */
static bool png_rows(png_sink *s, const vs_pixels *picture) {
  const dynamic_functions *call = &s->call;
  if (setjmp(s->failed) != 0) return false;
  s->png = call->open(PNG_LIBPNG_VER_STRING, s, png_failed, png_warned);
  s->info = s->png ? call->info(s->png) : NULL;
  s->no_memory = s->info == NULL;
  if (s->no_memory) return false;
  call->put(s->png, NULL, png_take, png_flushed);
  call->limits(s->png, 0x7fffffff, 0x7fffffff);
  call->head(s->png, s->info, picture->columns, picture->rows, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
             PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  call->screen(s->png, s->info, PNG_sRGB_INTENT_PERCEPTUAL);
  call->level(s->png, 1);
  call->strategy(s->png, Z_RLE);
  call->filter(s->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
  call->write_info(s->png, s->info);
  for (size_t y = 0; y < picture->rows; y++) call->write_row(s->png, picture->rgb + y * picture->columns * 3);
  call->write_end(s->png, s->info);
  return true;
}

bool vs_png_write(vs_store *store, const vs_pixels *picture, vs_made_bytes *out, vs_error *e) {
  png_sink s = { .store = store };
  if (!vs_dynamic_load(VS_LIBRARY_PNG, "PNG pictures", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &s.call, e))
    return false;
  bool ok = png_rows(&s, picture);
  if (s.png) s.call.close(&s.png, &s.info);
  if (ok) {
    *out = s.made;
    return true;
  }
  if (s.made.at) vs_store_realloc(store, s.made.at, s.made.room, 0);
  if (s.no_memory || strstr(s.message, "memory")) return vs_error_memory(e, NULL);
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "the PNG picture cannot be written: %s", s.message);
}
