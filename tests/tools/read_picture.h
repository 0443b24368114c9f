/* Reads a picture, PNG or EXR, for a tool of the tests. */
#ifndef VS_TESTS_READ_PICTURE_H
#define VS_TESTS_READ_PICTURE_H

#include <stdio.h>
#include <stdlib.h>

#include "geometry/files/raster.h"

/* Reads the file, of at most 64 MB. On failure prints a message that begins with the tool's name, and returns false. */
static inline bool read_picture(vs_store *s, const char *tool, const char *path, vs_raster *r) {
  enum { MOST = 1 << 26 };
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  FILE *f = fopen(path, "rb");
  unsigned char *bytes = f ? malloc(MOST) : NULL;
  size_t size = bytes ? fread(bytes, 1, MOST, f) : 0;
  bool ok = size && vs_raster_read(s, &(vs_file_bytes){ path, bytes, size }, r, &e);
  if (!ok) fprintf(stderr, "%s: %s: %s\n", tool, path, size ? e.message : "cannot be read");
  if (f) fclose(f);
  free(bytes);
  return ok;
}

#endif
