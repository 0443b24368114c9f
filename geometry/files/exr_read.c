/* Reads EXR pictures with OpenEXR's C library, which is loaded at its first use. It reads scan lines or tiles of the
 * first part of a file.
 *
 * The library decompresses a chunk, and this file unpacks its numbers. The library's own unpacking assumes that all
 * channels are requested. If the picture has another channel, such as alpha, it writes through a null pointer. A chunk
 * contains its lines from the top. Each line contains the channels in alphabetical order, and the numbers of a channel
 * one after another, low byte first. */
#include "geometry/files/exr_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/files/exr_library.h"

/* X macro that lists the OpenEXR functions that this file calls, as rows F(member, symbol, result, parameters). */
#define EXR_PIPELINE (exr_const_context_t, int, exr_decode_pipeline_t *)
#define EXR_CHUNK (exr_const_context_t, int, const exr_chunk_info_t *, exr_decode_pipeline_t *)
#define EXR_TILES (exr_const_context_t, int, uint32_t *, uint32_t *, exr_tile_level_mode_t *, exr_tile_round_mode_t *)
#define EXR_FUNCTIONS(F)                                                                                               \
  F(start, exr_start_read, exr_result_t, (exr_context_t *, const char *, const exr_context_initializer_t *))           \
  F(finish, exr_finish, exr_result_t, (exr_context_t *))                                                               \
  F(storage, exr_get_storage, exr_result_t, (exr_const_context_t, int, exr_storage_t *))                               \
  F(window, exr_get_data_window, exr_result_t, (exr_const_context_t, int, exr_attr_box2i_t *))                         \
  F(channels, exr_get_channels, exr_result_t, (exr_const_context_t, int, const exr_attr_chlist_t **))                  \
  F(lines, exr_get_scanlines_per_chunk, exr_result_t, (exr_const_context_t, int, int32_t *))                           \
  F(chunk, exr_read_scanline_chunk_info, exr_result_t, (exr_const_context_t, int, int, exr_chunk_info_t *))            \
  F(begin, exr_decoding_initialize, exr_result_t, EXR_CHUNK)                                                           \
  F(update, exr_decoding_update, exr_result_t, EXR_CHUNK)                                                              \
  F(tiles, exr_get_tile_descriptor, exr_result_t, EXR_TILES)                                                           \
  F(tile, exr_read_tile_chunk_info, exr_result_t,                                                                      \
      (exr_const_context_t, int, int, int, int, int, exr_chunk_info_t *))                                              \
  F(choose, exr_decoding_choose_default_routines, exr_result_t, EXR_PIPELINE)                                          \
  F(run, exr_decoding_run, exr_result_t, EXR_PIPELINE)                                                                 \
  F(end, exr_decoding_destroy, exr_result_t, (exr_const_context_t, exr_decode_pipeline_t *))                           \
  F(text, exr_attr_get_string, exr_result_t, (exr_const_context_t, int, const char *, int32_t *, const char **))       \
  F(words, exr_get_error_code_as_string, const char *, (exr_result_t))

VS_DYNAMIC_FUNCTIONS(EXR_FUNCTIONS);

static int64_t exr_take(exr_const_context_t c, void *memory, void *to, uint64_t count, uint64_t from,
                        exr_stream_error_func_ptr_t error) {
  (void)c, (void)error;
  const vs_file_bytes *file = memory;
  if (from >= file->size) return 0;
  if (count > file->size - from) count = file->size - from;
  memcpy(to, file->at + from, count);
  return (int64_t)count;
}
static int64_t exr_size(exr_const_context_t c, void *memory) {
  (void)c;
  return (int64_t)((const vs_file_bytes *)memory)->size;
}

/* ---- half-precision numbers ---- */

static double exr_half(unsigned bits) {
  uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023, sign = (uint32_t)(bits & 0x8000) << 16;
  if (exponent == 0) return (bits & 0x8000 ? -0x1p-24 : 0x1p-24) * fraction;
  /* Converts a half-precision number to single precision: adds 112 to the exponent, the difference of the biases, and
   * 13 zero bits to the fraction. Infinity and NaN have the greatest exponent in both formats. */
  uint32_t wide = sign | (exponent == 31 ? 255 : exponent + 112) << 23 | fraction << 13;
  float value;
  memcpy(&value, &wide, sizeof value);
  return (double)value;
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

/* The rectangle of a chunk in the picture, in pixels from the picture's upper left corner. The reader omits pixels of a
 * chunk outside the picture. */
typedef struct { int64_t x, y, columns, rows; } exr_place;

typedef struct {
  vs_store *store;
  dynamic_functions call;
  exr_context_t c;
  exr_attr_box2i_t box;
  const exr_attr_chlist_t *all;
  bool tiled;
  int64_t wide, high;       /* width and height of a chunk in pixels */
  int64_t columns, rows;    /* size of the picture in pixels */
  exr_place part;           /* rectangle of the picture to read */
  size_t stride;            /* distance, in numbers, between the starts of two rows in a target; a target is an array
                             * that receives a channel */
  vs_exr_target targets[VS_EXR_CHANNELS];
  size_t count;
} exr_reader;

/* Copies `columns` numbers of a channel's line, from column `skip` on, to the channel's target (array that receives
 * it). first: index in the target of the first number. */
static exr_result_t exr_take_line(const exr_coding_channel_info_t *info, const unsigned char *at,
                                  const vs_exr_target *t, size_t first, int64_t skip, int64_t columns) {
  if (info->x_samples != 1 || info->y_samples != 1) return EXR_ERR_FEATURE_NOT_IMPLEMENTED;
  if (info->bytes_per_element < (info->data_type == EXR_PIXEL_HALF ? 2 : 4) || info->width < skip + columns)
    return EXR_ERR_CORRUPT_CHUNK;
  for (int64_t x = 0; x < columns; x++) {
    double value = exr_number(at + (skip + x) * info->bytes_per_element, info->data_type);
    if (t->sum) t->sum[first + (size_t)x] += t->share * value;
    else t->plane[first + (size_t)x] = (float)value;
  }
  return EXR_ERR_SUCCESS;
}

/* Copies the numbers of a chunk to the targets (arrays that receive the channels). top: y of its first line in the
 * coordinates of the file, which determine sub-sampling. */
static exr_result_t exr_unpack(exr_reader *r, const exr_decode_pipeline_t *d, exr_place place, int64_t top) {
  const unsigned char *at = d->unpacked_buffer ? d->unpacked_buffer : d->packed_buffer;
  uint64_t left = at ? d->chunk.unpacked_size : 0;
  const exr_place *part = &r->part;
  int64_t from = place.x > part->x ? place.x : part->x, end = part->x + part->columns;
  int64_t columns = (place.x + place.columns < end ? place.x + place.columns : end) - from;
  for (int64_t line = 0; line < place.rows; line++)
    for (int c = 0; c < d->channel_count; c++) {
      const exr_coding_channel_info_t *info = &d->channels[c];
      if (info->x_samples < 1 || info->y_samples < 1 || info->width < 0 || info->bytes_per_element < 1)
        return EXR_ERR_CORRUPT_CHUNK;
      if ((top + line) % info->y_samples != 0) continue; /* a sub-sampled channel has numbers only in some lines, and
                                                          * none in this line */
      uint64_t bytes = (uint64_t)info->width * (uint64_t)info->bytes_per_element;
      if (bytes > left) return EXR_ERR_CORRUPT_CHUNK;
      int64_t row = place.y + line - part->y;
      for (size_t k = 0; row >= 0 && row < part->rows && k < r->count; k++) {
        if (strcmp(info->channel_name, r->targets[k].name) != 0) continue;
        size_t first = (size_t)row * r->stride + (size_t)(from - part->x);
        exr_result_t result = exr_take_line(info, at, &r->targets[k], first, from - place.x, columns);
        if (result != EXR_ERR_SUCCESS) return result;
      }
      at += bytes;
      left -= bytes;
    }
  return EXR_ERR_SUCCESS;
}

/* Decompresses a chunk. The library also reports a broken chunk when zlib has no memory. Therefore this function then
 * tries to allocate more memory than zlib needs: if that fails, memory is out; otherwise it decompresses once more. */
static exr_result_t exr_run(exr_reader *r, exr_decode_pipeline_t *d) {
  enum { WORK = 1 << 16 }; /* size in bytes of a trial allocation; it exceeds the memory that zlib needs */
  exr_result_t result = r->call.run(r->c, 0, d);
  if (result != EXR_ERR_CORRUPT_CHUNK) return result;
  void *volatile probe = malloc(WORK);
  if (!probe) return EXR_ERR_OUT_OF_MEMORY;
  free(probe);
  return r->call.run(r->c, 0, d);
}

/* Reads all chunks of the picture. A chunk is either a fixed number of lines or a tile of fixed size. After each chunk,
 * asks the caller whether to continue. */
static exr_result_t exr_decode(exr_reader *r, vs_error *e) {
  const dynamic_functions *call = &r->call;
  exr_context_t c = r->c;
  exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
  exr_result_t result = EXR_ERR_SUCCESS;
  bool begun = false;
  int64_t wide = r->wide, high = r->high, right = r->part.x + r->part.columns, bottom = r->part.y + r->part.rows;
  for (int64_t y = r->part.y / high * high; result == EXR_ERR_SUCCESS && y < bottom; y += high)
    for (int64_t x = r->part.x / wide * wide; result == EXR_ERR_SUCCESS && x < right; x += wide) {
      exr_chunk_info_t chunk;
      exr_place place = { x, y, wide < r->columns - x ? wide : r->columns - x, high < r->rows - y ? high
          : r->rows - y };
      uint64_t work = (uint64_t)(place.columns * place.rows) * 8;
      if (!vs_store_going(r->store, work < UINT32_MAX ? (uint32_t)work : UINT32_MAX, e)) break;
      result = r->tiled ? call->tile(c, 0, (int)(x / wide), (int)(y / high), 0, 0, &chunk)
                        : call->chunk(c, 0, (int)(r->box.min.y + y), &chunk);
      bool bare = result == EXR_ERR_SUCCESS && chunk.compression == EXR_COMPRESSION_NONE;
      if (bare && chunk.packed_size != chunk.unpacked_size) result = EXR_ERR_CORRUPT_CHUNK;
      if (result == EXR_ERR_SUCCESS)
        result = begun ? call->update(c, 0, &chunk, &decoder) : call->begin(c, 0, &chunk, &decoder);
      if (!begun && result == EXR_ERR_SUCCESS) {
        begun = true;
        result = call->choose(c, 0, &decoder); /* lets the library choose how to decompress; no channel has a
                                                * destination yet, so the library only decompresses */
        decoder.unpack_and_convert_fn = NULL;
      }
      if (result == EXR_ERR_SUCCESS) result = exr_run(r, &decoder);
      if (result == EXR_ERR_SUCCESS) result = exr_unpack(r, &decoder, place, r->box.min.y + y);
    }
  if (begun) call->end(c, &decoder);
  return result;
}

/* Reads the size of the picture and of its chunks. Returns false and sets e or *result on failure. */
static bool exr_measure(exr_reader *r, const vs_file_bytes *file, exr_result_t *result, vs_error *e) {
  exr_storage_t storage;
  uint32_t tile_wide = 0, tile_high = 0;
  int32_t per_chunk = 0;
  *result = r->call.storage(r->c, 0, &storage);
  if (*result != EXR_ERR_SUCCESS) return false;
  if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: deep EXR pictures cannot be read",
        file->name);
  *result = r->call.window(r->c, 0, &r->box);
  if (*result == EXR_ERR_SUCCESS) *result = r->call.channels(r->c, 0, &r->all);
  if (*result != EXR_ERR_SUCCESS) return false;
  r->tiled = storage == EXR_STORAGE_TILED;
  exr_tile_level_mode_t levels = 0;
  exr_tile_round_mode_t rounds = 0;
  *result = r->tiled ? r->call.tiles(r->c, 0, &tile_wide, &tile_high, &levels, &rounds)
                     : r->call.lines(r->c, 0, &per_chunk);
  if (*result != EXR_ERR_SUCCESS) return false;
  bool tiles = tile_wide && tile_high && tile_wide <= INT32_MAX && tile_high <= INT32_MAX;
  if (r->tiled ? !tiles : per_chunk < 1) {
    *result = EXR_ERR_INVALID_ATTR;
    return false;
  }
  r->columns = (int64_t)r->box.max.x - r->box.min.x + 1, r->rows = (int64_t)r->box.max.y - r->box.min.y + 1;
  r->wide = r->tiled ? (int64_t)tile_wide : r->columns, r->high = r->tiled ? (int64_t)tile_high : per_chunk;
  /* A file has a table with eight bytes for each chunk. If the file is too short for the table that a picture of this
   * size needs, the size is refused, and no memory is allocated. */
  bool sized = r->columns > 0 && r->rows > 0 && r->rows <= VS_RASTER_MOST / r->columns;
  if (sized && (uint64_t)((r->rows - 1) / r->high + 1) > file->size / 8)
    return vs_error_set(e, VS_ERROR_MODEL, NULL,
        "%.100s: the EXR file is too short for a picture of %lld x %lld pixels",
                        file->name, (long long)r->columns, (long long)r->rows);
  return true;
}

static bool exr_choose(exr_reader *r, vs_exr_choose *choose, void *context, vs_error *e) {
  vs_exr_view view = { .columns = r->columns < 0 ? 0 : (uint64_t)r->columns, .rows = r->rows < 0 ? 0
      : (uint64_t)r->rows };
  for (int i = 0; i < r->all->num_channels && view.count < VS_EXR_CHANNELS; i++) {
    const exr_attr_chlist_entry_t *entry = &r->all->entries[i];
    vs_exr_type type = entry->pixel_type == EXR_PIXEL_HALF ? VS_EXR_HALF : entry->pixel_type == EXR_PIXEL_UINT
        ? VS_EXR_WHOLE : VS_EXR_FLOAT;
    view.channels[view.count++] = (vs_exr_seen){ entry->name.str, type };
  }
  view.more = r->all->num_channels > VS_EXR_CHANNELS;
  for (int i = 0; i < VS_EXR_TEXTS; i++) {
    const char *text = NULL;
    int32_t length = 0;
    if (r->call.text(r->c, 0, vs_exr_text_names[i], &length, &text) == EXR_ERR_SUCCESS && length > 0)
      view.texts[i].at = text, view.texts[i].length = (size_t)length;
  }
  return choose(context, &view, r->targets, &r->count, e);
}

/* Sets the rectangle of the picture to read; w may be NULL for the whole picture. */
static void exr_cut(exr_reader *r, const vs_exr_window *w) {
  r->part = (exr_place){ 0, 0, r->columns, r->rows };
  if (w) r->part = (exr_place){ w->part.left, w->part.top, w->part.columns, w->part.rows };
  r->stride = w ? w->stride : (size_t)r->columns;
}

bool vs_exr_decode(vs_store *store, const vs_file_bytes *file, const vs_exr_window *window, vs_exr_choose *choose,
                   void *context, vs_error *e) {
  exr_reader r = { .store = store };
  if (!vs_dynamic_load(VS_LIBRARY_OPENEXR, "EXR pictures", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &r.call, e))
    return false;
  vs_file_bytes memory = *file;
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = vs_exr_quiet;
  how.user_data = &memory;
  how.read_fn = exr_take;
  how.size_fn = exr_size;
  how.max_image_width = how.max_image_height = how.max_tile_width = how.max_tile_height = VS_RASTER_MOST;
  bool ok = true;
  exr_result_t result = r.call.start(&r.c, file->name, &how);
  if (result == EXR_ERR_SUCCESS) {
    ok = exr_measure(&r, file, &result, e) && exr_choose(&r, choose, context, e);
    vs_error stopped = { VS_ERROR_NONE, NULL, "" };
    if (ok) exr_cut(&r, window);
    if (ok) result = exr_decode(&r, &stopped);
    if (stopped.kind != VS_ERROR_NONE) ok = vs_error_set(e, stopped.kind, NULL, "%s", stopped.message);
  }
  if (result == EXR_ERR_OUT_OF_MEMORY) ok = vs_error_memory(e, NULL);
  else if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL,
        "%.100s: vs cannot read the compression, or the sampling of channels, of this EXR picture", file->name);
  else if (result != EXR_ERR_SUCCESS)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture cannot be read: %s", file->name,
        r.call.words(result));
  if (r.c) r.call.finish(&r.c);
  return ok;
}

/* ---- reading of a picture with its channels ---- */

typedef struct { vs_exr *out; const char *name; const char *const *wanted; } exr_load;

static bool exr_is_wanted(const char *const *wanted, const char *name) {
  bool found = wanted == NULL;
  for (; !found && *wanted; wanted++) found = strcmp(*wanted, name) == 0;
  return found;
}

static bool exr_choose_planes(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used,
    vs_error *e) {
  exr_load *l = context;
  if (!view->columns || !view->rows || view->columns > VS_RASTER_MOST / view->rows)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the picture has %llu x %llu pixels; up to %d are read",
        l->name,
                        (unsigned long long)view->columns, (unsigned long long)view->rows, VS_RASTER_MOST);
  if (view->more && !l->wanted)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture has more than %d channels", l->name,
                        VS_EXR_CHANNELS);
  l->out->columns = (uint32_t)view->columns, l->out->rows = (uint32_t)view->rows;
  for (size_t i = 0; i < view->count; i++) {
    const char *name = view->channels[i].name;
    if (!exr_is_wanted(l->wanted, name) || strlen(name) >= VS_EXR_NAME) continue;
    float *plane = vs_exr_add(l->out, name, view->channels[i].type, e);
    if (!plane) return false;
    targets[(*used)++] = (vs_exr_target){ .name = l->out->channels[l->out->count - 1].name, .plane = plane };
  }
  bool ok = true;
  for (int i = 0; ok && i < VS_EXR_TEXTS; i++)
    ok = !view->texts[i].at || vs_exr_add_text(l->out, (vs_exr_text)i, view->texts[i].at, view->texts[i].length, e);
  return ok;
}

bool vs_exr_read(vs_store *store, const vs_file_bytes *file, const char *const *wanted, vs_exr *out, vs_error *e) {
  *out = (vs_exr){ .store = store };
  if (file->size < 4 || memcmp(file->at, "\x76\x2f\x31\x01", 4) != 0)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: this is no EXR picture", file->name);
  bool ok = vs_exr_decode(store, file, NULL, exr_choose_planes, &(exr_load){ out, file->name, wanted }, e);
  if (!ok) vs_exr_free(out);
  return ok;
}

/* ---- reading of a part of a picture into another ---- */

typedef struct { const vs_exr_cut *cut; vs_exr *into; const char *name; } exr_cutting;

static bool exr_choose_rows(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used,
    vs_error *e) {
  const exr_cutting *c = context;
  const vs_exr_part *part = &c->cut->part;
  if (view->columns != c->cut->columns || view->rows != c->cut->rows || part->left + part->columns > view->columns ||
      part->top + part->rows > view->rows || c->cut->left + part->columns > c->into->columns ||
      c->cut->top + part->rows > c->into->rows)
    return vs_error_set(e, VS_ERROR_WORKER, NULL, "%.100s has another size", c->name);
  for (size_t i = 0; i < c->into->count; i++) {
    const vs_exr_channel *channel = &c->into->channels[i];
    bool there = false;
    for (size_t k = 0; !there && k < view->count; k++) there = strcmp(view->channels[k].name, channel->name) == 0;
    if (!there) return vs_error_set(e, VS_ERROR_WORKER, NULL, "%.100s has no channel %s", c->name, channel->name);
    float *plane = channel->at + (size_t)c->cut->top * c->into->columns + c->cut->left;
    targets[(*used)++] = (vs_exr_target){ .name = channel->name, .plane = plane };
  }
  return true;
}

bool vs_exr_read_cut(const vs_file_bytes *file, const vs_exr_cut *cut, vs_exr *into, vs_error *e) {
  const vs_exr_window window = { cut->part, into->columns };
  return vs_exr_decode(into->store, file, &window, exr_choose_rows, &(exr_cutting){ cut, into, file->name }, e);
}
