/* Owns reading EXR pictures by OpenEXR's C library, loaded at the first one: scan lines of one part, as POV-Ray and most programs write them. */
#include "geometry/files/raster.h"

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

static exr_result_t exr_decode(vs_raster *r, const exr_functions *call, exr_context_t c, const exr_attr_box2i_t *box, const char *const names[3], int count, float *lines, int32_t per_chunk) {
  exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
  exr_chunk_info_t chunk;
  exr_result_t result = EXR_ERR_SUCCESS;
  bool begun = false;
  size_t plane = (size_t)r->columns * (size_t)per_chunk;
  for (int64_t y = box->min.y; result == EXR_ERR_SUCCESS && y <= box->max.y; y += per_chunk) {
    result = call->chunk(c, 0, (int)y, &chunk);
    if (result == EXR_ERR_SUCCESS) result = begun ? call->update(c, 0, &chunk, &decoder) : call->begin(c, 0, &chunk, &decoder);
    if (result != EXR_ERR_SUCCESS) break;
    for (int i = 0; i < decoder.channel_count; i++) {
      exr_coding_channel_info_t *info = &decoder.channels[i];
      info->decode_to_ptr = NULL;
      for (int k = 0; k < count; k++)
        if (!strcmp(info->channel_name, names[k])) {
          if (info->width != (int32_t)r->columns || info->height > per_chunk || info->x_samples != 1 || info->y_samples != 1) result = EXR_ERR_FEATURE_NOT_IMPLEMENTED;
          info->decode_to_ptr = (uint8_t *)(lines + plane * (size_t)k);
          info->user_bytes_per_element = 4;
          info->user_data_type = EXR_PIXEL_FLOAT;
          info->user_pixel_stride = 4;
          info->user_line_stride = (int32_t)(4 * r->columns);
        }
    }
    if (result == EXR_ERR_SUCCESS && !begun) result = call->choose(c, 0, &decoder);
    begun = true;
    if (result == EXR_ERR_SUCCESS) result = call->run(c, 0, &decoder);
    for (int64_t line = 0; result == EXR_ERR_SUCCESS && line < per_chunk && y + line <= box->max.y; line++)
      for (uint32_t x = 0; x < r->columns; x++) {
        const float *p = lines + (size_t)line * r->columns + x;
        double *to = &r->at[(size_t)(y + line - box->min.y) * r->columns + x];
        *to = count == 1 ? (double)p[0] : vs_raster_luminance((double)p[0], (double)p[plane], (double)p[2 * plane]);
      }
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
  exr_context_t c = NULL;
  exr_storage_t storage;
  exr_attr_box2i_t box;
  const exr_attr_chlist_t *all;
  const char *names[3];
  int count;
  int32_t per_chunk;
  float *lines = NULL;
  bool ok = true;
  exr_result_t result = call.start(&c, name, &how);
  if (result == EXR_ERR_SUCCESS) result = call.storage(c, 0, &storage);
  if (result == EXR_ERR_SUCCESS && storage != EXR_STORAGE_SCANLINE) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture is not made of scan lines: tiles and deep pictures are not read", name);
  if (ok && result == EXR_ERR_SUCCESS) result = call.window(c, 0, &box);
  if (ok && result == EXR_ERR_SUCCESS) result = call.channels(c, 0, &all);
  if (ok && result == EXR_ERR_SUCCESS) result = call.lines(c, 0, &per_chunk);
  if (ok && result == EXR_ERR_SUCCESS && !exr_choose_channels(all, names, &count)) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture has neither Y nor one channel nor R, G and B", name);
  if (ok && result == EXR_ERR_SUCCESS)
    ok = vs_raster_room(r, name, box.max.x < box.min.x ? 0 : (uint64_t)((int64_t)box.max.x - box.min.x) + 1, box.max.y < box.min.y ? 0 : (uint64_t)((int64_t)box.max.y - box.min.y) + 1, e);
  if (ok && result == EXR_ERR_SUCCESS) {
    lines = per_chunk > 0 && per_chunk <= 4096 ? calloc((size_t)count * (size_t)per_chunk * r->columns, sizeof *lines) : NULL;
    ok = lines || vs_error_memory(e, NULL);
  }
  if (ok && result == EXR_ERR_SUCCESS) result = exr_decode(r, &call, c, &box, names, count, lines, per_chunk);
  if (ok && result != EXR_ERR_SUCCESS) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture cannot be read: %s", name, call.words(result));
  free(lines);
  if (c) call.finish(&c);
  return ok;
}
