/* Owns reading EXR pictures by OpenEXR's C library. */
#ifndef VS_GEOMETRY_FILES_EXR_READ_H
#define VS_GEOMETRY_FILES_EXR_READ_H

#include "geometry/files/exr.h"
#include "geometry/files/file_bytes.h"

/* Reads a file that is in memory. wanted: the names of channels, NULL at the end; what is missing is no error. NULL:
 * all of them. out need not be initialised and is empty after a failure. */
bool vs_exr_read(vs_store *store, const vs_file_bytes *file, const char *const *wanted, vs_exr *out, vs_error *e);

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
bool vs_exr_decode(vs_store *store, const vs_file_bytes *file, vs_exr_choose *choose, void *context, vs_error *e);

#endif
