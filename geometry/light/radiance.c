/* Reads Radiance pictures. A file consists of lines of text, the size, and rows of pixels. A pixel has four bytes: red,
 * green, blue and a common exponent (G. Ward, Real Pixels, Graphics Gems II, 1991). Rows are run-length encoded, one
 * component after another, or uncompressed. */
#include "geometry/light/radiance.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct { const unsigned char *at, *end; } radiance_bytes;

static bool wrong(vs_error *e, const char *name, const char *what) {
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: %s", name, what);
}

/* Reads the text lines up to an empty line, and then the line with the picture's size. Accepts only pictures with rows
 * from the top and columns from the left. */
static bool read_head(radiance_bytes *b, unsigned long *columns, unsigned long *rows) {
  char line[128];
  bool empty = false, rgbe = false;
  while (b->at < b->end) {
    size_t count = 0;
    while (b->at < b->end && *b->at != '\n') {
      if (count + 1 < sizeof line) line[count++] = (char)*b->at;
      b->at++;
    }
    if (b->at < b->end) b->at++;
    line[count] = 0;
    char rest;
    if (empty) return rgbe && sscanf(line, "-Y %9lu +X %9lu%c", rows, columns, &rest) == 2;
    if (!strcmp(line, "FORMAT=32-bit_rle_rgbe")) rgbe = true;
    empty = count == 0;
  }
  return false;
}

/* Reads a row of pixels into `to`, all red bytes first, then green, blue and exponents. Returns false if the file ends
 * too early or a run of equal bytes is longer than the row. */
static bool read_row(radiance_bytes *b, unsigned char *to, size_t columns) {
  const unsigned char *at = b->at;
  bool packed = columns >= 8 && columns < 32768 && b->end - at >= 4 && at[0] == 2 && at[1] == 2 &&
                (size_t)at[2] * 256 + at[3] == columns;
  if (!packed) {
    if ((size_t)(b->end - at) < 4 * columns) return false;
    for (size_t i = 0; i < columns; i++)
      for (size_t k = 0; k < 4; k++) to[k * columns + i] = at[4 * i + k];
    b->at += 4 * columns;
    return true;
  }
  b->at += 4;
  for (size_t k = 0; k < 4; k++)
    for (size_t i = 0; i < columns;) {
      if (b->end - b->at < 2) return false;
      size_t count = *b->at++;
      bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > columns - i || (!run && (size_t)(b->end - b->at) < count)) return false;
      if (run) memset(to + k * columns + i, *b->at++, count);
      else memcpy(to + k * columns + i, b->at, count), b->at += count;
      i += count;
    }
  return true;
}

bool vs_radiance_read(vs_store *store, const vs_file_bytes *file, vs_exr *out, vs_error *e) {
  static const char *const names[] = { "R", "G", "B" };
  const char *name = file->name;
  radiance_bytes b = { file->at, file->at + file->size };
  unsigned long columns, rows;
  float *planes[3];
  *out = (vs_exr){ .store = store };
  if (!read_head(&b, &columns, &rows)) return wrong(e, name, "this is no Radiance picture from the upper left");
  if (!vs_raster_size(name, columns, rows, e)) return false;
  /* Even the shortest coding has more than one byte for 32 pixels. A file that is too short for its stated size is
   * refused before memory is allocated. */
  if ((size_t)(b.end - b.at) < (size_t)columns * rows / 32) return wrong(e, name, "the Radiance file is cut off");
  out->columns = (uint32_t)columns, out->rows = (uint32_t)rows;
  unsigned char *row = vs_store_realloc(store, NULL, 0, 4 * columns);
  bool ok = row != NULL || vs_error_memory(e, NULL);
  for (int k = 0; ok && k < 3; k++) ok = (planes[k] = vs_exr_add(out, names[k], VS_EXR_FLOAT, e)) != NULL;
  for (size_t y = 0; ok && y < rows; y++) {
    ok = read_row(&b, row, columns) || wrong(e, name, "the Radiance file is cut off or broken");
    for (size_t i = 0; ok && i < columns; i++) {
      double scale = row[3 * columns + i] ? ldexp(1, row[3 * columns + i] - 136) : 0;
      for (size_t k = 0; k < 3; k++)
        planes[k][y * columns + i] = (float)(scale > 0 ? (row[k * columns + i] + 0.5) * scale : 0);
    }
  }
  if (row) vs_store_realloc(store, row, 4 * columns, 0);
  if (!ok) vs_exr_free(out);
  return ok;
}
