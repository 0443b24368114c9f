/* Declares reading EXR pictures by OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_READ_H
#define VS_GEOMETRY_FILES_EXR_READ_H

#include "geometry/files/exr.h"
#include "geometry/files/file_bytes.h"

/* Reads a file that is in memory. wanted: the names of channels, ends with NULL; a missing channel is no error; NULL:
 * all channels. out needs no initialisation, and is empty after a failure. */
bool vs_exr_read(vs_store *store, const vs_file_bytes *file, const char *const *wanted, vs_exr *out, vs_error *e);

/* A part of a picture, in pixels from its upper left corner. */
typedef struct { uint32_t left, top, columns, rows; } vs_exr_part;
typedef struct {
  uint32_t columns, rows; /* size of the file's picture */
  vs_exr_part part;       /* the wanted part of the file's picture */
  uint32_t left, top;     /* its place in the other picture */
} vs_exr_cut;
/* Reads a part of a file's picture into another picture, all of whose channels are wanted. Returns false if the file is
 * damaged, its picture has another size or lacks a channel, or the part does not fit. */
bool vs_exr_read_cut(const vs_file_bytes *file, const vs_exr_cut *cut, vs_exr *into, vs_error *e);

/* ---- shared by the readers ---- */

/* The destination of a channel: share times each number is added to sum; if sum is NULL, the number goes into plane. */
typedef struct { const char *name; double share; double *sum; float *plane; } vs_exr_target;
typedef struct { const char *name; vs_exr_type type; } vs_exr_seen;
typedef struct {
  uint64_t columns, rows; /* unchecked, from the file */
  vs_exr_seen channels[VS_EXR_CHANNELS];
  size_t count;
  bool more;              /* the file has more channels than VS_EXR_CHANNELS */
  struct { const char *at; size_t length; } texts[VS_EXR_TEXTS]; /* at NULL: no text */
} vs_exr_view;
/* Inspects the header, allocates memory, and sets the destination of each wanted channel. */
typedef bool vs_exr_choose(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used, vs_error *e);
/* The part of the picture that goes to the targets; it lies within the picture. stride: numbers from one row of a
 * target to the next. */
typedef struct { vs_exr_part part; size_t stride; } vs_exr_window;
/* Decodes the picture into the chosen targets. window NULL: the whole picture. */
bool vs_exr_decode(vs_store *store, const vs_file_bytes *file, const vs_exr_window *window, vs_exr_choose *choose,
                   void *context, vs_error *e);

#endif
