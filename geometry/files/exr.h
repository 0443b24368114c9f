/* Declares EXR pictures as planes of numbers, one for each channel, and their writing by OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_H
#define VS_GEOMETRY_FILES_EXR_H

#include "geometry/dynamic.h"
#include "geometry/files/file_bytes.h"
#include "geometry/files/raster.h"

enum { VS_EXR_CHANNELS = 64, /* the most channels that are read from one picture */
       VS_EXR_NAME = 64 /* bytes of a name, including its NUL */ };
/* The texts of a picture; each is an attribute with such a name. */
typedef enum {
  VS_EXR_SOURCES,   /* the places in the model that the channel id refers to, counted from 1, one on each line */
  VS_EXR_MATERIALS, /* the names of the materials that the channel material refers to, counted from 1, one on each
                     * line */
  VS_EXR_CAMERA, VS_EXR_SUN,
  VS_EXR_TEXTS
} vs_exr_text;
extern const char *const vs_exr_text_names[VS_EXR_TEXTS];

extern const vs_dynamic_library vs_exr_library;

typedef enum {
  VS_EXR_HALF, VS_EXR_FLOAT,
  VS_EXR_WHOLE /* 32-bit integers, exact up to 2^24 */
} vs_exr_type;

typedef struct { char name[VS_EXR_NAME]; vs_exr_type type; float *at; /* at: rows from the top */ } vs_exr_channel;
typedef struct {
  vs_store *store; /* the owner of the memory */
  uint32_t columns, rows;
  vs_exr_channel channels[VS_EXR_CHANNELS];
  size_t count;
  struct { char *at; size_t room; } texts[VS_EXR_TEXTS]; /* at NULL: no text */
} vs_exr;

void vs_exr_free(vs_exr *x);
/* Returns the channel's numbers; NULL: the picture lacks the channel. */
float *vs_exr_find(const vs_exr *x, const char *channel);
/* Adds a channel of zeros; columns and rows are set before. Returns NULL when memory is out or there are too many
 * channels. */
float *vs_exr_add(vs_exr *x, const char *channel, vs_exr_type type, vs_error *e);
/* Appends `length` bytes to a text; *x owns a copy. The text is one of vs_exr_text. */
bool vs_exr_add_text(vs_exr *x, vs_exr_text text, const char *at, size_t length, vs_error *e);
/* Crops all channels to a part, which lies within the picture. Returns false when memory is out; the picture is then
 * unchanged. */
bool vs_exr_crop(vs_exr *x, uint32_t left, uint32_t top, uint32_t columns, uint32_t rows, vs_error *e);
/* Makes the file's bytes: the same for the same picture. A failure leaves *out unchanged. */
bool vs_exr_write(const vs_exr *x, vs_made_bytes *out, vs_error *e);

#endif
