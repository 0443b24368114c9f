/* Owns reading EXR pictures by OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_READ_H
#define VS_GEOMETRY_FILES_EXR_READ_H

#include "geometry/files/exr.h"
#include "geometry/files/file_bytes.h"

/* Reads a file that is in memory. wanted: the names of channels, NULL at the end; what is missing is no error. NULL:
 * all of them. out need not be initialised and is empty after a failure. */
bool vs_exr_read(vs_store *store, const vs_file_bytes *file, const char *const *wanted, vs_exr *out, vs_error *e);

/* A part of a picture, in pixels from its upper left corner. */
typedef struct { uint32_t left, top, columns, rows; } vs_exr_part;
typedef struct {
  uint32_t columns, rows; /* of the file's picture */
  vs_exr_part part;       /* of it */
  uint32_t left, top;     /* where it goes in the other picture */
} vs_exr_cut;
/* Reads a part of a file's picture into another picture, whose channels are those that are wanted. False: the file is
 * damaged, its picture has another size or lacks a channel, or the part does not fit. */
bool vs_exr_read_cut(const vs_file_bytes *file, const vs_exr_cut *cut, vs_exr *into, vs_error *e);

/* ---- what readers share ---- */

/* share times the number is added to sum; where that is NULL the number goes into plane */
typedef struct { const char *name; double share; double *sum; float *plane; } vs_exr_target;
typedef struct { const char *name; vs_exr_type type; } vs_exr_seen;
typedef struct {
  uint64_t columns, rows; /* as the file has them: unchecked */
  vs_exr_seen channels[VS_EXR_CHANNELS];
  size_t count;
  bool more;              /* there are more channels */
  struct { const char *at; size_t length; } texts[VS_EXR_TEXTS]; /* NULL: there is none */
} vs_exr_view;
/* Sees what the file has, makes room, and says which channels go where. */
typedef bool vs_exr_choose(void *context, const vs_exr_view *view, vs_exr_target *targets, size_t *used, vs_error *e);
/* The part of the picture that goes to the targets: a part that lies within it; stride: from one row of their numbers
 * to the next. */
typedef struct { vs_exr_part part; size_t stride; } vs_exr_window;
/* window NULL: all of the picture. */
bool vs_exr_decode(vs_store *store, const vs_file_bytes *file, const vs_exr_window *window, vs_exr_choose *choose,
                   void *context, vs_error *e);

#endif
