/* Declares EXR pictures as planes of numbers, one plane for each channel, and their writing with OpenEXR's C
 * library. */
#ifndef VS_GEOMETRY_FILES_EXR_H
#define VS_GEOMETRY_FILES_EXR_H

#include "geometry/files/file_bytes.h"
#include "geometry/files/raster.h"

enum { VS_EXR_CHANNELS = 64, /* greatest number of channels that are read from one picture */
       VS_EXR_NAME = 64 /* size of a channel's name in bytes, including its NUL */ };
/* The texts that a picture may have. Each becomes a text attribute of the EXR file. */
typedef enum {
  VS_EXR_SOURCES,   /* places in the model file, one on each line; a pixel of the channel `id` is the number of a line,
                     * counted from 1 */
  VS_EXR_MATERIALS, /* names of materials, one on each line; a pixel of the channel `material` is the number of a line,
                     * counted from 1 */
  VS_EXR_CAMERA, VS_EXR_SUN,
  VS_EXR_TEXTS
} vs_exr_text;
extern const char *const vs_exr_text_names[VS_EXR_TEXTS];

typedef enum {
  VS_EXR_HALF, VS_EXR_FLOAT,
  VS_EXR_WHOLE /* 32-bit integers in the file; in memory they are floats, which are exact up to 2^24 */
} vs_exr_type;

typedef struct { char name[VS_EXR_NAME]; vs_exr_type type; float *at; /* at: numbers of the channel's pixels, row by row
                                                                       * from the top */ } vs_exr_channel;
typedef struct {
  vs_store *store; /* store whose memory the arrays use */
  uint32_t columns, rows;
  vs_exr_channel channels[VS_EXR_CHANNELS];
  size_t count;
  struct { char *at; size_t room; } texts[VS_EXR_TEXTS]; /* at: the text, or NULL if the picture does not have it */
} vs_exr;

void vs_exr_free(vs_exr *x);
/* Returns the numbers of a channel, row by row from the top, or NULL if the picture does not have this channel. */
float *vs_exr_find(const vs_exr *x, const char *channel);
/* Adds a channel in which all pixels are 0. columns and rows must be set before. Returns its numbers, or NULL when
 * memory is out or there are too many channels. */
float *vs_exr_add(vs_exr *x, const char *channel, vs_exr_type type, vs_error *e);
/* Appends `length` bytes to one of the picture's texts. The bytes are copied. Returns false when memory is out. */
bool vs_exr_add_text(vs_exr *x, vs_exr_text text, const char *at, size_t length, vs_error *e);
/* Crops all channels to a rectangle of the picture, given in pixels from its upper left corner. Returns false when
 * memory is out; the picture is then unchanged. */
bool vs_exr_crop(vs_exr *x, uint32_t left, uint32_t top, uint32_t columns, uint32_t rows, vs_error *e);
/* Converts the picture x to the bytes of an EXR file. Equal pictures become equal bytes. Returns false and leaves *out
 * unchanged on failure. */
bool vs_exr_write(const vs_exr *x, vs_made_bytes *out, vs_error *e);

#endif
