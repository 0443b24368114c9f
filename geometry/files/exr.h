/* Owns EXR pictures as planes of numbers, one for each channel, and writing them by OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_H
#define VS_GEOMETRY_FILES_EXR_H

#include "geometry/dynamic.h"
#include "geometry/files/file_bytes.h"
#include "geometry/files/raster.h"

enum { VS_EXR_CHANNELS = 64, /* that are read of one picture */
       VS_EXR_NAME = 64 /* bytes of a name, its NUL counted */ };
/* The texts of a picture, in attributes of these names. */
typedef enum {
  VS_EXR_SOURCES,   /* the places in the model that the channel id counts from 1, a line each */
  VS_EXR_MATERIALS, /* the names that the channel material counts from 1, a line each */
  VS_EXR_CAMERA, VS_EXR_SUN,
  VS_EXR_TEXTS
} vs_exr_text;
extern const char *const vs_exr_text_names[VS_EXR_TEXTS];

extern const vs_dynamic_library vs_exr_library;

typedef enum {
  VS_EXR_HALF, VS_EXR_FLOAT,
  VS_EXR_WHOLE /* of 32 bits: exact here up to 2^24 */
} vs_exr_type;

typedef struct { char name[VS_EXR_NAME]; vs_exr_type type; float *at; /* row by row from the top */ } vs_exr_channel;
typedef struct {
  vs_store *store; /* whose memory it is */
  uint32_t columns, rows;
  vs_exr_channel channels[VS_EXR_CHANNELS];
  size_t count;
  struct { char *at; size_t room; } texts[VS_EXR_TEXTS]; /* NULL: there is none */
} vs_exr;

void vs_exr_free(vs_exr *x);
/* A channel's numbers; NULL: the picture has no such channel. */
float *vs_exr_find(const vs_exr *x, const char *channel);
/* Adds a channel whose numbers are 0; columns and rows are set before. NULL: out of memory, or there are too many. */
float *vs_exr_add(vs_exr *x, const char *channel, vs_exr_type type, vs_error *e);
/* Adds `length` bytes to a text; *x has a copy. The text is one of vs_exr_text. */
bool vs_exr_add_text(vs_exr *x, vs_exr_text text, const char *at, size_t length, vs_error *e);
/* Keeps a part, which lies within the picture, of all its channels. False: out of memory; the picture is as it was. */
bool vs_exr_crop(vs_exr *x, uint32_t left, uint32_t top, uint32_t columns, uint32_t rows, vs_error *e);
/* Makes a file of it: the same bytes for the same picture. *out is as it was after a failure. */
bool vs_exr_write(const vs_exr *x, vs_made_bytes *out, vs_error *e);

#endif
