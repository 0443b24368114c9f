/* Reads clouds of points: .xyz, a point in each line of text; .las, the format of laser scans, uncompressed; .ply, by
 * meshfile.c. */
#include "geometry/files/pointfile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/files/byte_scan.h"

static bool ends_in(const char *name, const char *ending) {
  size_t n = strlen(name), k = strlen(ending);
  if (n <= k) return false;
  for (size_t i = 0; i < k; i++) {
    char c = name[n - k + i];
    if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
    if (c != ending[i]) return false;
  }
  return true;
}

static bool is_text(const char *name) {
  return ends_in(name, ".xyz") || ends_in(name, ".txt") || ends_in(name, ".csv");
}

bool vs_point_file_is(const char *name) { return is_text(name) || ends_in(name, ".las") || ends_in(name, ".ply"); }

/* ---- text ---- */

enum { LINE_NUMBER = 64 }; /* greatest length of a number in a line, in bytes with its NUL */

/* Reads a number at *at, before end, and the separator after it: blanks, a comma or a semicolon. Moves *at past both.
 * Returns false if there is no number. */
static bool text_number(const unsigned char **at, const unsigned char *end, double *out) {
  char t[LINE_NUMBER];
  size_t n = 0;
  while (*at < end && (**at == ' ' || **at == '\t')) ++*at;
  while (*at < end && n < sizeof t - 1 && **at && strchr("+-.0123456789eE", **at)) t[n++] = (char)*(*at)++;
  t[n] = '\0';
  char *stop;
  *out = strtod(t, &stop);
  if (n == 0 || *stop || !isfinite(*out)) return false;
  while (*at < end && (**at == ' ' || **at == '\t')) ++*at;
  if (*at < end && (**at == ',' || **at == ';')) ++*at;
  else if (*at < end && (*at)[-1] != ' ' && (*at)[-1] != '\t' && **at != '\r') return false;
  return true;
}

/* Reads x, y and z of each line as a point, and ignores further columns, such as intensities. Skips empty lines, lines
 * that begin with #, and a first line of headings. */
static bool read_text(vs_byte_scan *s, vs_face_list *out) {
  const unsigned char *end = s->bytes + s->size;
  for (s->line = 1; s->at < s->size; s->line++) {
    const unsigned char *at = s->bytes + s->at, *stop = memchr(at, '\n', (size_t)(end - at));
    double c[3];
    stop = stop ? stop : end;
    s->at = (size_t)(stop - s->bytes) + (stop < end);
    while (stop > at && (stop[-1] == '\r' || stop[-1] == ' ' || stop[-1] == '\t')) stop--;
    while (at < stop && (*at == ' ' || *at == '\t')) at++;
    if (!vs_scan_poll(s)) return false;
    if (at == stop || *at == '#') continue;
    bool found = true;
    for (int i = 0; i < 3 && found; i++) found = text_number(&at, stop, &c[i]);
    if (!found && out->point_count == 0 && s->line == 1) continue;
    if (!found) return vs_scan_fail(s, "expected three numbers, x, y and z");
    if (!vs_face_list_point(out, vs_v3(c[0], c[1], c[2]))) return vs_error_memory(s->error, NULL);
  }
  return true;
}

/* ---- .las, which is little-endian on every machine ---- */

static uint64_t las_integer(const unsigned char *at, int bytes) {
  uint64_t n = 0;
  for (int i = bytes; i-- > 0;) n = n << 8 | at[i];
  return n;
}
static double las_real(const unsigned char *at) {
  uint64_t bits = las_integer(at, 8);
  double d;
  memcpy(&d, &bits, sizeof d);
  return d;
}

/* Positions of the header's members in bytes from the beginning of a .las file, for versions 1.0 to 1.4 of the
 * format. */
enum { LAS_MINOR = 25, LAS_HEADER_SIZE = 94, LAS_DATA = 96, LAS_FORMAT = 104, LAS_RECORD = 105, LAS_COUNT = 107,
       LAS_SCALE = 131, LAS_OFFSET = 155, LAS_LEAST = 227, LAS_LONG_COUNT = 247, LAS_LONG_LEAST = 375 };

static bool las_fail(const vs_byte_scan *s, const char *why) {
  return vs_error_set(s->error, VS_ERROR_MODEL, NULL, "%.100s: %s", s->name, why);
}

static bool read_las(vs_byte_scan *s, vs_face_list *out) {
  const unsigned char *b = s->bytes;
  if (s->size < LAS_LEAST || memcmp(b, "LASF", 4))
    return las_fail(s, "this is no .las file: it does not begin with LASF");
  if (b[LAS_FORMAT] & 0x80) return las_fail(s, "the points are compressed; save them as .las, not as .laz");
  uint64_t data = las_integer(b + LAS_DATA, 4), record = las_integer(b + LAS_RECORD, 2);
  uint64_t count = las_integer(b + LAS_COUNT, 4);
  if (b[LAS_MINOR] >= 4 && s->size >= LAS_LONG_LEAST && las_integer(b + LAS_HEADER_SIZE, 2) >= LAS_LONG_LEAST)
    count = las_integer(b + LAS_LONG_COUNT, 8);
  if (record < 12 || data > s->size || count > (s->size - data) / record)
    return las_fail(s, "the file is too short for its points");
  double scale[3], offset[3];
  for (int i = 0; i < 3; i++) scale[i] = las_real(b + LAS_SCALE + 8 * i), offset[i] = las_real(b + LAS_OFFSET + 8 * i);
  for (uint64_t p = 0; p < count; p++) {
    double c[3];
    const unsigned char *at = b + data + p * record;
    for (int i = 0; i < 3; i++) c[i] = (int32_t)(uint32_t)las_integer(at + 4 * i, 4) * scale[i] + offset[i];
    if (!isfinite(c[0]) || !isfinite(c[1]) || !isfinite(c[2])) return las_fail(s, "its scales make no finite points");
    if (!vs_scan_poll(s)) return false;
    if (!vs_face_list_point(out, vs_v3(c[0], c[1], c[2]))) return vs_error_memory(s->error, NULL);
  }
  return true;
}

bool vs_point_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e) {
  if (ends_in(file->name, ".ply")) return vs_points_file_read(file, poll, false, out, e);
  const char *slash = strrchr(file->name, '/');
  vs_byte_scan s = { .name = slash ? slash + 1 : file->name, .bytes = file->at, .size = file->size, .poll = poll,
                     .error = e };
  return ends_in(file->name, ".las") ? read_las(&s, out) : read_text(&s, out);
}
