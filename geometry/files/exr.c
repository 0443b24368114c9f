/* Implements EXR pictures in memory, and writes them with OpenEXR's C library: as scan lines, with ZIP compression in
 * blocks of 16 lines. */
#include "geometry/files/exr.h"

#include <string.h>

#include "geometry/files/exr_library.h"

const char *const vs_exr_text_names[VS_EXR_TEXTS] = {
    [VS_EXR_SOURCES] = "visualscheme.sources", [VS_EXR_MATERIALS] = "visualscheme.materials",
    [VS_EXR_CAMERA] = "visualscheme.camera", [VS_EXR_SUN] = "visualscheme.sun" };

/* ---- pictures in memory ---- */

static size_t exr_plane_bytes(const vs_exr *x) { return (size_t)x->columns * x->rows * sizeof(float); }

void vs_exr_free(vs_exr *x) {
  for (size_t i = 0; i < x->count; i++) vs_store_realloc(x->store, x->channels[i].at, exr_plane_bytes(x), 0);
  for (int i = 0; i < VS_EXR_TEXTS; i++)
    if (x->texts[i].at) vs_store_realloc(x->store, x->texts[i].at, x->texts[i].room, 0);
  *x = (vs_exr){ .store = x->store };
}

float *vs_exr_find(const vs_exr *x, const char *channel) {
  for (size_t i = 0; i < x->count; i++)
    if (!strcmp(x->channels[i].name, channel)) return x->channels[i].at;
  return NULL;
}

float *vs_exr_add(vs_exr *x, const char *channel, vs_exr_type type, vs_error *e) {
  VS_ASSERT(x->columns > 0 && x->rows > 0);
  if (x->count == VS_EXR_CHANNELS) {
    vs_error_set(e, VS_ERROR_MODEL, NULL, "an EXR picture may have at most %d channels", VS_EXR_CHANNELS);
    return NULL;
  }
  float *at = vs_store_realloc(x->store, NULL, 0, exr_plane_bytes(x));
  if (!at) {
    vs_error_memory(e, NULL);
    return NULL;
  }
  memset(at, 0, exr_plane_bytes(x));
  vs_exr_channel *c = &x->channels[x->count++];
  *c = (vs_exr_channel){ .type = type, .at = at };
  size_t length = strlen(channel);
  memcpy(c->name, channel, length < VS_EXR_NAME ? length : VS_EXR_NAME - 1);
  return at;
}

bool vs_exr_add_text(vs_exr *x, vs_exr_text text, const char *at, size_t length, vs_error *e) {
  size_t used = x->texts[text].at ? x->texts[text].room - 1 : 0;
  char *all = vs_store_realloc(x->store, x->texts[text].at, x->texts[text].room, used + length + 1);
  VS_ASSERT((size_t)text < VS_EXR_TEXTS);
  if (!all) return vs_error_memory(e, NULL);
  memcpy(all + used, at, length);
  all[used + length] = 0;
  x->texts[text].at = all, x->texts[text].room = used + length + 1;
  return true;
}

bool vs_exr_crop(vs_exr *x, uint32_t left, uint32_t top, uint32_t columns, uint32_t rows, vs_error *e) {
  size_t bytes = (size_t)columns * rows * sizeof(float), whole = exr_plane_bytes(x), made = 0;
  float *parts[VS_EXR_CHANNELS];
  VS_ASSERT(columns <= x->columns && left <= x->columns - columns && rows <= x->rows && top <= x->rows - rows);
  while (made < x->count && (parts[made] = vs_store_realloc(x->store, NULL, 0, bytes))) made++;
  if (made < x->count) {
    while (made > 0) vs_store_realloc(x->store, parts[--made], bytes, 0);
    return vs_error_memory(e, NULL);
  }
  for (size_t i = 0; i < x->count; i++) {
    const float *from = x->channels[i].at + (size_t)top * x->columns + left;
    for (size_t row = 0; row < rows; row++)
      memcpy(parts[i] + row * columns, from + row * x->columns, columns * sizeof *from);
    vs_store_realloc(x->store, x->channels[i].at, whole, 0);
    x->channels[i].at = parts[i];
  }
  x->columns = columns, x->rows = rows;
  return true;
}

/* ---- writing ---- */

/* X macro that lists the OpenEXR functions that this file calls, as rows F(member, symbol, result, parameters). */
#define EXR_START (exr_context_t *, const char *, exr_default_write_mode_t, const exr_context_initializer_t *)
#define EXR_PIPELINE (exr_const_context_t, int, exr_encode_pipeline_t *)
#define EXR_CHUNK (exr_const_context_t, int, const exr_chunk_info_t *, exr_encode_pipeline_t *)
#define EXR_CHANNEL (exr_context_t, int, const char *, exr_pixel_type_t, exr_perceptual_treatment_t, int32_t, int32_t)
#define EXR_FUNCTIONS(F)                                                                                               \
  F(start, exr_start_write, exr_result_t, EXR_START)                                                                   \
  F(finish, exr_finish, exr_result_t, (exr_context_t *))                                                               \
  F(part, exr_add_part, exr_result_t, (exr_context_t, const char *, exr_storage_t, int *))                             \
  F(required, exr_initialize_required_attr_simple, exr_result_t,                                                       \
      (exr_context_t, int, int32_t, int32_t, exr_compression_t))                                                       \
  F(channel, exr_add_channel, int, EXR_CHANNEL)                                                                        \
  F(text, exr_attr_set_string, exr_result_t, (exr_context_t, int, const char *, const char *))                         \
  F(header, exr_write_header, exr_result_t, (exr_context_t))                                                           \
  F(lines, exr_get_scanlines_per_chunk, exr_result_t, (exr_const_context_t, int, int32_t *))                           \
  F(chunk, exr_write_scanline_chunk_info, exr_result_t, (exr_context_t, int, int, exr_chunk_info_t *))                 \
  F(begin, exr_encoding_initialize, exr_result_t, EXR_CHUNK)                                                           \
  F(update, exr_encoding_update, exr_result_t, EXR_CHUNK)                                                              \
  F(choose, exr_encoding_choose_default_routines, exr_result_t, EXR_PIPELINE)                                          \
  F(run, exr_encoding_run, exr_result_t, EXR_PIPELINE)                                                                 \
  F(end, exr_encoding_destroy, exr_result_t, (exr_const_context_t, exr_encode_pipeline_t *))                           \
  F(words, exr_get_error_code_as_string, const char *, (exr_result_t))

VS_DYNAMIC_FUNCTIONS(EXR_FUNCTIONS);

typedef struct { vs_store *store; vs_made_bytes made; bool full; } exr_file;

/* Writes `count` bytes at the offset `from` of the file in memory, for the library. The buffer grows by half of its
 * size. */
static int64_t exr_put(exr_const_context_t c, void *to, const void *bytes, uint64_t count, uint64_t from,
                       exr_stream_error_func_ptr_t error) {
  (void)c, (void)error;
  exr_file *f = to;
  vs_made_bytes *made = &f->made;
  uint64_t end = from + count;
  if (end > made->room) {
    size_t room = (size_t)end + made->room / 2 + 4096;
    unsigned char *more = vs_store_realloc(f->store, made->at, made->room, room);
    if (!more) return f->full = true, -1;
    memset(more + made->room, 0, room - made->room);
    made->at = more, made->room = room;
  }
  memcpy(made->at + from, bytes, count);
  if (end > made->size) made->size = (size_t)end;
  return (int64_t)count;
}

static exr_result_t exr_put_header(const dynamic_functions *call, exr_context_t c, const vs_exr *x) {
  static const exr_pixel_type_t types[] = {
      [VS_EXR_HALF] = EXR_PIXEL_HALF, [VS_EXR_FLOAT] = EXR_PIXEL_FLOAT, [VS_EXR_WHOLE] = EXR_PIXEL_UINT };
  int part = 0;
  exr_result_t result = call->part(c, "picture", EXR_STORAGE_SCANLINE, &part);
  if (result == EXR_ERR_SUCCESS)
    result = call->required(c, 0, (int32_t)x->columns, (int32_t)x->rows, EXR_COMPRESSION_ZIP);
  for (size_t i = 0; result == EXR_ERR_SUCCESS && i < x->count; i++)
    result = call->channel(c, 0, x->channels[i].name, types[x->channels[i].type], EXR_PERCEPTUALLY_LINEAR, 1, 1);
  for (int i = 0; result == EXR_ERR_SUCCESS && i < VS_EXR_TEXTS; i++)
    if (x->texts[i].at) result = call->text(c, 0, vs_exr_text_names[i], x->texts[i].at);
  return result == EXR_ERR_SUCCESS ? call->header(c) : result;
}

static exr_result_t exr_put_lines(const dynamic_functions *call, exr_context_t c, const vs_exr *x) {
  exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
  int32_t high = 0;
  bool begun = false;
  exr_result_t result = call->lines(c, 0, &high);
  for (uint32_t y = 0; result == EXR_ERR_SUCCESS && high > 0 && y < x->rows; y += (uint32_t)high) {
    exr_chunk_info_t chunk;
    result = call->chunk(c, 0, (int)y, &chunk);
    if (result == EXR_ERR_SUCCESS)
      result = begun ? call->update(c, 0, &chunk, &encoder) : call->begin(c, 0, &chunk, &encoder);
    for (int k = 0; result == EXR_ERR_SUCCESS && k < encoder.channel_count; k++) {
      exr_coding_channel_info_t *info = &encoder.channels[k];
      const float *plane = vs_exr_find(x, info->channel_name);
      info->encode_from_ptr = (const uint8_t *)(plane + (size_t)y * x->columns);
      info->user_pixel_stride = sizeof(float), info->user_line_stride = (int32_t)(x->columns * sizeof(float));
      info->user_data_type = EXR_PIXEL_FLOAT, info->user_bytes_per_element = sizeof(float);
    }
    if (!begun && result == EXR_ERR_SUCCESS) begun = true, result = call->choose(c, 0, &encoder);
    if (result == EXR_ERR_SUCCESS) result = call->run(c, 0, &encoder);
  }
  if (begun) call->end(c, &encoder);
  return result;
}

bool vs_exr_write(const vs_exr *x, vs_made_bytes *out, vs_error *e) {
  dynamic_functions call;
  if (!vs_dynamic_load(VS_LIBRARY_OPENEXR, "EXR pictures", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &call, e))
    return false;
  exr_file f = { .store = x->store };
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = vs_exr_quiet;
  how.user_data = &f;
  how.write_fn = exr_put;
  exr_context_t c = NULL;
  exr_result_t result = call.start(&c, "picture", EXR_WRITE_FILE_DIRECTLY, &how);
  if (result == EXR_ERR_SUCCESS) result = exr_put_header(&call, c, x);
  if (result == EXR_ERR_SUCCESS) result = exr_put_lines(&call, c, x);
  if (c) { /* closes the file: only then does the library write the table of chunks into it */
    exr_result_t last = call.finish(&c);
    if (result == EXR_ERR_SUCCESS) result = last;
  }
  if (result == EXR_ERR_SUCCESS) {
    *out = f.made;
    return true;
  }
  vs_store_realloc(f.store, f.made.at, f.made.room, 0);
  if (f.full || result == EXR_ERR_OUT_OF_MEMORY) return vs_error_memory(e, NULL);
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "the EXR picture cannot be written: %s", call.words(result));
}
