/* Owns reading EXR pictures by OpenEXR's C library, loaded at the first one: scan lines or tiles of the first part.
 *
 * The library decompresses; taking the numbers out of a chunk is done here. Its own routines for that suppose that every channel is wanted, and write
 * through a null pointer where a picture has one more (an alpha channel) than is asked for. A chunk holds its lines from the top; each line
 * holds the channels in alphabetical order, one number beside the other, low byte first. */
#include "geometry/files/raster.h"

#include <math.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/dynamic.h"

/* EXR(member, symbol, result, parameters): what we use of it */
#define EXR_FUNCTIONS                                                                                                  \
  EXR(start, exr_start_read, exr_result_t, (exr_context_t *, const char *, const exr_context_initializer_t *))         \
  EXR(finish, exr_finish, exr_result_t, (exr_context_t *))                                                             \
  EXR(storage, exr_get_storage, exr_result_t, (exr_const_context_t, int, exr_storage_t *))                             \
  EXR(window, exr_get_data_window, exr_result_t, (exr_const_context_t, int, exr_attr_box2i_t *))                       \
  EXR(channels, exr_get_channels, exr_result_t, (exr_const_context_t, int, const exr_attr_chlist_t **))                \
  EXR(lines, exr_get_scanlines_per_chunk, exr_result_t, (exr_const_context_t, int, int32_t *))                         \
  EXR(chunk, exr_read_scanline_chunk_info, exr_result_t, (exr_const_context_t, int, int, exr_chunk_info_t *))          \
  EXR(begin, exr_decoding_initialize, exr_result_t, (exr_const_context_t, int, const exr_chunk_info_t *, exr_decode_pipeline_t *)) \
  EXR(update, exr_decoding_update, exr_result_t, (exr_const_context_t, int, const exr_chunk_info_t *, exr_decode_pipeline_t *))    \
  EXR(tiles, exr_get_tile_descriptor, exr_result_t, (exr_const_context_t, int, uint32_t *, uint32_t *, exr_tile_level_mode_t *, exr_tile_round_mode_t *)) \
  EXR(tile, exr_read_tile_chunk_info, exr_result_t, (exr_const_context_t, int, int, int, int, int, exr_chunk_info_t *)) \
  EXR(choose, exr_decoding_choose_default_routines, exr_result_t, (exr_const_context_t, int, exr_decode_pipeline_t *)) \
  EXR(run, exr_decoding_run, exr_result_t, (exr_const_context_t, int, exr_decode_pipeline_t *))                        \
  EXR(end, exr_decoding_destroy, exr_result_t, (exr_const_context_t, exr_decode_pipeline_t *))                         \
  EXR(words, exr_get_error_code_as_string, const char *, (exr_result_t))

typedef struct {
#define EXR(member, symbol, result, parameters) result (*member) parameters;
  EXR_FUNCTIONS
#undef EXR
} exr_functions;

static const vs_dynamic_name exr_names[] = {
#define EXR(member, symbol, result, parameters) { #symbol, offsetof(exr_functions, member) },
  EXR_FUNCTIONS
#undef EXR
};

typedef struct { const unsigned char *bytes; size_t size; } exr_memory;

static int64_t exr_take(exr_const_context_t c, void *memory, void *to, uint64_t count, uint64_t from, exr_stream_error_func_ptr_t error) {
  (void)c, (void)error;
  const exr_memory *m = memory;
  if (from >= m->size) return 0;
  if (count > m->size - from) count = m->size - from;
  memcpy(to, m->bytes + from, count);
  return (int64_t)count;
}
static int64_t exr_size(exr_const_context_t c, void *memory) {
  (void)c;
  return (int64_t)((exr_memory *)memory)->size;
}
static void exr_quiet(exr_const_context_t c, exr_result_t code, const char *message) { (void)c, (void)code, (void)message; } /* the results say it too */

/* Which channel gives which of up to three numbers: names[k] is the channel's; *count 1 or 3. */
static bool exr_choose_channels(const exr_attr_chlist_t *all, const char *names[3], int *count) {
  const char *rgb[3] = { NULL, NULL, NULL }, *y = NULL, *only = NULL;
  int others = 0;
  for (int i = 0; i < all->num_channels; i++) {
    const char *name = all->entries[i].name.str;
    if (!strcmp(name, "Y")) y = name;
    for (int k = 0; k < 3; k++)
      if (name[0] == "RGB"[k] && !name[1]) rgb[k] = name;
    if (strcmp(name, "A")) only = name, others++;
  }
  *count = 1;
  names[0] = y ? y : others == 1 ? only : NULL;
  if (names[0]) return true;
  *count = 3;
  memcpy(names, rgb, sizeof rgb);
  return rgb[0] && rgb[1] && rgb[2];
}

/* ---- numbers ---- */

static double exr_half(unsigned bits) {
  unsigned exponent = bits >> 10 & 31, fraction = bits & 1023;
  double value = exponent == 31 ? (fraction ? (double)NAN : (double)INFINITY) : exponent ? ldexp(1024 + fraction, (int)exponent - 25) : ldexp(fraction, -24);
  return bits & 0x8000 ? -value : value;
}

static double exr_number(const unsigned char *at, uint16_t type) {
  if (type == EXR_PIXEL_HALF) return exr_half((unsigned)at[0] | (unsigned)at[1] << 8);
  uint32_t bits = (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
  float real;
  if (type == EXR_PIXEL_UINT) return bits;
  memcpy(&real, &bits, sizeof real);
  return (double)real;
}

/* ---- chunks ---- */

/* Where a chunk lies in the picture, in pixels from its upper left corner; what reaches past the picture is left out. */
typedef struct { int64_t x, y, columns, rows; } exr_place;

/* Puts a chunk's numbers in their place. top: the y of its first line in the file's own coordinates, which sub-sampling goes by. */
static exr_result_t exr_unpack(vs_raster *r, const exr_decode_pipeline_t *d, const char *const names[3], int count, exr_place place, int64_t top) {
  const unsigned char *at = d->unpacked_buffer ? d->unpacked_buffer : d->packed_buffer;
  uint64_t left = at ? d->chunk.unpacked_size : 0;
  for (int64_t line = 0; line < place.rows; line++)
    for (int c = 0; c < d->channel_count; c++) {
      const exr_coding_channel_info_t *info = &d->channels[c];
      if (info->x_samples < 1 || info->y_samples < 1 || info->width < 0 || info->bytes_per_element < 1) return EXR_ERR_CORRUPT_CHUNK;
      if ((top + line) % info->y_samples != 0) continue; /* this line has none of it */
      uint64_t bytes = (uint64_t)info->width * (uint64_t)info->bytes_per_element;
      if (bytes > left) return EXR_ERR_CORRUPT_CHUNK;
      for (int k = 0; k < count; k++) {
        if (strcmp(info->channel_name, names[k]) != 0) continue;
        if (info->x_samples != 1 || info->y_samples != 1) return EXR_ERR_FEATURE_NOT_IMPLEMENTED;
        if (info->bytes_per_element < (info->data_type == EXR_PIXEL_HALF ? 2 : 4) || info->width < place.columns) return EXR_ERR_CORRUPT_CHUNK;
        double *to = &r->at[(size_t)(place.y + line) * r->columns + (size_t)place.x];
        for (int64_t x = 0; x < place.columns; x++) to[x] += (count == 1 ? 1 : vs_raster_share[k]) * exr_number(at + x * info->bytes_per_element, info->data_type);
      }
      at += bytes;
      left -= bytes;
    }
  return EXR_ERR_SUCCESS;
}

/* The chunks of scan lines are as wide as the picture and so many lines high; tiles have a size of their own. Asks whether to go on after each. */
static exr_result_t exr_decode(vs_raster *r, const exr_functions *call, exr_context_t c, const exr_attr_box2i_t *box, const char *const names[3], int count, bool tiled,
                               int64_t wide, int64_t high, vs_error *e) {
  exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
  exr_result_t result = EXR_ERR_SUCCESS;
  bool begun = false;
  for (int64_t y = 0; result == EXR_ERR_SUCCESS && y < r->rows; y += high)
    for (int64_t x = 0; result == EXR_ERR_SUCCESS && x < r->columns; x += wide) {
      exr_chunk_info_t chunk;
      exr_place place = { x, y, wide < r->columns - x ? wide : r->columns - x, high < r->rows - y ? high : r->rows - y };
      uint64_t work = (uint64_t)(place.columns * place.rows) * 8;
      if (!vs_store_going(r->store, work < UINT32_MAX ? (uint32_t)work : UINT32_MAX, e)) break;
      result = tiled ? call->tile(c, 0, (int)(x / wide), (int)(y / high), 0, 0, &chunk) : call->chunk(c, 0, (int)(box->min.y + y), &chunk);
      if (result == EXR_ERR_SUCCESS && chunk.compression == EXR_COMPRESSION_NONE && chunk.packed_size != chunk.unpacked_size) result = EXR_ERR_CORRUPT_CHUNK;
      if (result == EXR_ERR_SUCCESS) result = begun ? call->update(c, 0, &chunk, &decoder) : call->begin(c, 0, &chunk, &decoder);
      if (!begun && result == EXR_ERR_SUCCESS) {
        begun = true;
        result = call->choose(c, 0, &decoder); /* how to read and to decompress: no channel has a place to go */
        decoder.unpack_and_convert_fn = NULL;
      }
      if (result == EXR_ERR_SUCCESS) result = call->run(c, 0, &decoder);
      if (result == EXR_ERR_SUCCESS) result = exr_unpack(r, &decoder, names, count, place, box->min.y + y);
    }
  if (begun) call->end(c, &decoder);
  return result;
}

bool vs_raster_exr(vs_raster *r, const char *name, const unsigned char *bytes, size_t size, vs_error *e) {
  static const char *const files[] = { "libOpenEXRCore-3_1.so.30", "libOpenEXRCore-3_2.so.31", "libOpenEXRCore.so", NULL };
  static const vs_dynamic_library library = { files, "libopenexr-3-1-30", "reading EXR pictures" };
  exr_functions call;
  if (!vs_dynamic_load(&library, exr_names, sizeof exr_names / sizeof *exr_names, &call, e)) return false;
  exr_memory memory = { bytes, size };
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = exr_quiet;
  how.user_data = &memory;
  how.read_fn = exr_take;
  how.size_fn = exr_size;
  how.max_image_width = how.max_image_height = how.max_tile_width = how.max_tile_height = VS_RASTER_MOST;
  exr_context_t c = NULL;
  exr_storage_t storage;
  exr_attr_box2i_t box;
  const exr_attr_chlist_t *all;
  const char *names[3];
  int count = 0;
  uint32_t tile_wide = 0, tile_high = 0;
  int32_t per_chunk = 0;
  bool ok = true, tiled = false;
  exr_result_t result = call.start(&c, name, &how);
  if (result == EXR_ERR_SUCCESS) result = call.storage(c, 0, &storage);
  if (result == EXR_ERR_SUCCESS && storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture is a deep one: those are not read", name);
  if (ok && result == EXR_ERR_SUCCESS) result = call.window(c, 0, &box);
  if (ok && result == EXR_ERR_SUCCESS) result = call.channels(c, 0, &all);
  tiled = ok && result == EXR_ERR_SUCCESS && storage == EXR_STORAGE_TILED;
  if (tiled) result = call.tiles(c, 0, &tile_wide, &tile_high, &(exr_tile_level_mode_t){ 0 }, &(exr_tile_round_mode_t){ 0 });
  else if (ok && result == EXR_ERR_SUCCESS) result = call.lines(c, 0, &per_chunk);
  if (ok && result == EXR_ERR_SUCCESS && (tiled ? !tile_wide || !tile_high || tile_wide > INT32_MAX || tile_high > INT32_MAX : per_chunk < 1)) result = EXR_ERR_INVALID_ATTR;
  if (ok && result == EXR_ERR_SUCCESS && !exr_choose_channels(all, names, &count)) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture has neither Y nor one channel nor R, G and B", name);
  if (ok && result == EXR_ERR_SUCCESS) {
    int64_t columns = (int64_t)box.max.x - box.min.x + 1, rows = (int64_t)box.max.y - box.min.y + 1, high = tiled ? (int64_t)tile_high : per_chunk;
    /* every chunk has an entry of eight bytes in a table: a size that the file has no room for is a lie, and no memory is asked for it */
    bool lies = columns > 0 && rows > 0 && rows <= VS_RASTER_MOST / columns && (uint64_t)((rows - 1) / high + 1) > size / 8;
    if (lies) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR file is too short for a picture of %lld x %lld pixels", name, (long long)columns, (long long)rows);
    ok = ok && vs_raster_room(r, name, columns < 0 ? 0 : (uint64_t)columns, rows < 0 ? 0 : (uint64_t)rows, e);
    vs_error stopped = { VS_ERROR_NONE, NULL, "" };
    if (ok) result = exr_decode(r, &call, c, &box, names, count, tiled, tiled ? (int64_t)tile_wide : columns, high, &stopped);
    if (stopped.kind != VS_ERROR_NONE) ok = vs_error_set(e, stopped.kind, NULL, "%s", stopped.message);
  }
  if (ok && result == EXR_ERR_OUT_OF_MEMORY) ok = vs_error_memory(e, NULL);
  if (ok && result == EXR_ERR_FEATURE_NOT_IMPLEMENTED) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture is compressed, or its channels are sampled, in a way that is not read", name);
  if (ok && result != EXR_ERR_SUCCESS) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture cannot be read: %s", name, call.words(result));
  if (c) call.finish(&c);
  return ok;
}
