/* Reads STL, OBJ and OFF files, and implements the list of points and faces that all readers fill. ply.c reads PLY
 * files. */
#include "geometry/files/meshfile.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/ply.h"
#include "geometry/files/byte_scan.h"
#include "model/store/array.h"

/* ---- the list of points and faces ---- */

void vs_face_list_free(vs_face_list *l) {
  free(l->points);
  free(l->starts);
  free(l->corners);
  *l = (vs_face_list){ 0 };
}

bool vs_face_list_point(vs_face_list *l, vs_vec3 p) {
  if (!VS_GROW(l->points, l->point_room, l->point_count + 1)) return false;
  l->points[l->point_count++] = p;
  return true;
}

bool vs_face_list_corner(vs_face_list *l, uint32_t point) {
  if (!VS_GROW(l->corners, l->corner_room, l->corner_count + 1)) return false;
  l->corners[l->corner_count++] = point;
  return true;
}

bool vs_face_list_close(vs_face_list *l) {
  if (!VS_GROW(l->starts, l->start_room, l->face_count + 2)) return false;
  if (!l->face_count) l->starts[0] = 0;
  if (l->corner_count - l->starts[l->face_count] < 3) l->corner_count = l->starts[l->face_count];
  else l->starts[++l->face_count] = (uint32_t)l->corner_count;
  return true;
}

static bool face_list_memory(const vs_byte_scan *s, bool ok) { return ok || vs_error_memory(s->error, NULL); }

/* ---- STL ---- */

static float little_float(const unsigned char *b) {
  uint32_t bits = (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
  float f;
  memcpy(&f, &bits, sizeof f);
  return f;
}

static bool read_stl_bytes(vs_byte_scan *s, uint32_t count, vs_face_list *out) {
  for (uint32_t i = 0; i < count; i++) {
    const unsigned char *b = s->bytes + 84 + (size_t)50 * i + 12; /* skips the triangle's normal, which follows from its
                                                                   * corners */
    for (int k = 0; k < 3; k++, b += 12) {
      vs_vec3 p = { (double)little_float(b), (double)little_float(b + 4), (double)little_float(b + 8) };
      s->at = (size_t)(b - s->bytes);
      if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
        return vs_scan_fail(s, "corner %d of triangle %u is not at a finite place", k + 1, i + 1);
      if (!face_list_memory(s, vs_face_list_point(out, p) && vs_face_list_corner(out, (uint32_t)out->point_count - 1)))
        return false;
    }
    if (!face_list_memory(s, vs_face_list_close(out)) || !vs_scan_poll(s)) return false;
  }
  return true;
}

static bool read_stl_words(vs_byte_scan *s, vs_face_list *out) {
  char word[VS_SCAN_WORD];
  vs_vec3 p;
  s->line = 1;
  for (;;) {
    vs_scan_word(s, true, 0, word);
    if (!*word) break;
    if (!strcmp(word, "solid") || !strcmp(word, "endsolid")) {
      vs_scan_next_line(s);
    } else if (!strcmp(word, "vertex")) {
      if (!vs_scan_point(s, true, 0, &p)) return false;
      if (!face_list_memory(s, vs_face_list_point(out, p) && vs_face_list_corner(out, (uint32_t)out->point_count - 1)))
        return false;
    } else if (!strcmp(word, "endfacet")) {
      size_t open = out->corner_count - (out->face_count ? out->starts[out->face_count] : 0);
      if (open < 3) return vs_scan_fail(s, "the facet has %zu corners, not three", open);
      if (!face_list_memory(s, vs_face_list_close(out)) || !vs_scan_poll(s)) return false;
    } else if (!strcmp(word, "normal")) {
      for (int i = 0; i < 3; i++) vs_scan_word(s, true, 0, word); /* skips the triangle's normal, whose words may be
                                                                   * anything, often nan */
    } else if (strcmp(word, "facet") && strcmp(word, "outer") && strcmp(word, "loop") && strcmp(word, "endloop")) {
      return vs_scan_fail(s, "expected \"facet\", \"vertex\" or another word of STL, got \"%.32s\"", word);
    }
  }
  return out->corner_count == (out->face_count ? out->starts[out->face_count] : 0) ||
         vs_scan_fail(s, "the file ends within a facet");
}

/* A binary STL file has 80 bytes of text, the number of triangles, and 50 bytes for each triangle. The file's size
 * shows whether a file is binary, because many binary files also begin with "solid" like text files. */
static bool read_stl(vs_byte_scan *s, vs_face_list *out) {
  uint32_t count = s->size >= 84 ? (uint32_t)s->bytes[80] | (uint32_t)s->bytes[81] << 8 | (uint32_t)s->bytes[82] << 16 |
                                       (uint32_t)s->bytes[83] << 24
                                 : 0;
  uint64_t need = 84 + (uint64_t)50 * count;
  if (s->size >= 84 && s->size == need) return read_stl_bytes(s, count, out);
  size_t start = 0;
  while (start < s->size && (s->bytes[start] == ' ' || (s->bytes[start] >= 9 && s->bytes[start] <= 13))) start++;
  if (s->size - start >= 5 && !memcmp(s->bytes + start, "solid", 5) &&
      !memchr(s->bytes, 0, s->size < 512 ? s->size : 512))
    return read_stl_words(s, out);
  if (s->size >= 84 && s->size > need) return read_stl_bytes(s, count, out); /* a binary file may have more bytes after
                                                                              * the last triangle */
  if (s->size < 84)
    return vs_error_set(s->error, VS_ERROR_MODEL, NULL, "%.100s: this is no STL file: it has %zu bytes", s->name,
                        s->size);
  return vs_error_set(s->error, VS_ERROR_MODEL, NULL,
                      "%.100s: the file is cut off, or no STL file: %u triangles need %llu bytes, it has %zu", s->name,
                      count, (unsigned long long)need, s->size);
}

/* ---- OBJ ---- */

static bool read_obj_face(vs_byte_scan *s, vs_face_list *out) {
  char word[VS_SCAN_WORD], *end;
  while (!vs_scan_line_end(s) && s->bytes[s->at] != '#') {
    if (s->bytes[s->at] == '\\') { /* a backslash at the end of a line continues the face on the next line */
      vs_scan_next_line(s);
      continue;
    }
    vs_scan_word(s, false, '#', word);
    long long i = strtoll(word, &end, 10);
    if (end == word || (*end && *end != '/') || i == 0)
      return vs_scan_fail(s, "expected the number of a point, got \"%.32s\"", word);
    if (i < 0) i += (long long)out->point_count + 1; /* a negative index counts backwards: -1 is the point that was read
                                                      * last */
    if (i < 1 || i > (long long)UINT32_MAX)
      return vs_scan_fail(s, "the face refers to point %.32s, but there are %zu so far", word, out->point_count);
    if (!face_list_memory(s, vs_face_list_corner(out, (uint32_t)(i - 1)))) return false;
  }
  size_t open = out->corner_count - (out->face_count ? out->starts[out->face_count] : 0);
  if (open < 3) return vs_scan_fail(s, "a face has three corners or more, this one %zu", open);
  return face_list_memory(s, vs_face_list_close(out));
}

static bool read_obj(vs_byte_scan *s, vs_face_list *out) {
  char word[VS_SCAN_WORD];
  vs_vec3 p;
  for (s->line = 1; s->at < s->size; vs_scan_next_line(s)) {
    vs_scan_word(s, false, '#', word);
    if (!strcmp(word, "v")) {
      if (!vs_scan_point(s, false, '#', &p) || !face_list_memory(s, vs_face_list_point(out, p))) return false;
    } else if (!strcmp(word, "f")) {
      if (!read_obj_face(s, out)) return false;
    } /* ignores other lines: normals, textures, groups, materials and curves */
    if (!vs_scan_poll(s)) return false;
  }
  return true;
}

/* ---- OFF ---- */

/* Reads an OFF file. It begins with the word OFF, perhaps after the letters ST, C or N, and the numbers of points,
 * faces and edges; the points and the faces follow. Colours and other numbers may follow each point. */
static bool read_off(vs_byte_scan *s, vs_face_list *out) {
  char word[VS_SCAN_WORD];
  int64_t points, faces, edges, corners, index;
  vs_vec3 p;
  s->line = 1;
  vs_scan_word(s, true, '#', word);
  size_t n = strlen(word);
  if (n < 3 || strcmp(word + n - 3, "OFF") || (n > 3 && strspn(word, "STCN") != n - 3))
    return vs_scan_fail(s, "expected OFF, got \"%.32s\"", word);
  bool more = n > 3;
  if (!vs_scan_line_end(s) && s->bytes[s->at] == 'B')
    return vs_scan_fail(s, "OFF files in bytes are not read; write it in words, or as STL or PLY");
  if (!vs_scan_integer(s, true, '#', &points) || !vs_scan_integer(s, true, '#', &faces) ||
      !vs_scan_integer(s, true, '#', &edges))
    return false;
  if (points < 0 || faces < 0 || (uint64_t)points > s->size || (uint64_t)faces > s->size)
    return vs_scan_fail(s, "the file is too short for %lld points and %lld faces", (long long)points, (long long)faces);
  for (int64_t i = 0; i < points; i++) {
    if (!vs_scan_point(s, true, '#', &p) || !face_list_memory(s, vs_face_list_point(out, p)) || !vs_scan_poll(s))
      return false;
    if (more) vs_scan_next_line(s);
  }
  for (int64_t f = 0; f < faces; f++) {
    if (!vs_scan_integer(s, true, '#', &corners)) return false;
    if (corners < 0 || (uint64_t)corners > s->size)
      return vs_scan_fail(s, "face %lld cannot have %lld corners", (long long)f + 1, (long long)corners);
    for (int64_t k = 0; k < corners; k++) {
      if (!vs_scan_integer(s, true, '#', &index)) return false;
      if (index < 0 || index >= points)
        return vs_scan_fail(s, "face %lld refers to point %lld, but there are %lld, counted from 0", (long long)f + 1,
                            (long long)index, (long long)points);
      if (!face_list_memory(s, vs_face_list_corner(out, (uint32_t)index))) return false;
    }
    vs_scan_next_line(s); /* skips the rest of the line, which is a colour of the face */
    if (!face_list_memory(s, vs_face_list_close(out)) || !vs_scan_poll(s)) return false;
  }
  return true;
}

/* ---- choice of the reader by the file's ending ---- */

typedef bool mesh_reader(vs_byte_scan *s, vs_face_list *out);

static mesh_reader *reader_of(const char *name) {
  static const struct {
    const char *ending;
    mesh_reader *read;
  } readers[] = { { ".stl", read_stl }, { ".obj", read_obj }, { ".off", read_off }, { ".ply", vs_ply_read } };
  size_t n = strlen(name);
  for (size_t i = 0; i < sizeof readers / sizeof *readers; i++) {
    bool same = n > 4;
    for (size_t k = 0; same && k < 4; k++) {
      char c = name[n - 4 + k];
      if (c >= 'A' && c <= 'Z') c = (char)(c - 'A' + 'a');
      same = c == readers[i].ending[k];
    }
    if (same) return readers[i].read;
  }
  return NULL;
}

bool vs_mesh_file_is(const char *name) { return reader_of(name) != NULL; }

static const char *base_name(const char *name) {
  const char *slash = strrchr(name, '/');
  return slash ? slash + 1 : name;
}

bool vs_points_file_read(const vs_file_bytes *file, vs_poller poll, bool nowhere, vs_face_list *out, vs_error *e) {
  vs_byte_scan s = { .name = base_name(file->name),
                     .bytes = file->at,
                     .size = file->size,
                     .poll = poll,
                     .error = e,
                     .nowhere = nowhere };
  mesh_reader *read = reader_of(file->name);
  if (!read)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the name must end in .stl, .obj, .off or .ply", s.name);
  if (!read(&s, out)) return false;
  for (size_t f = 0; f < out->face_count; f++)
    for (uint32_t c = out->starts[f]; c < out->starts[f + 1]; c++)
      if (out->corners[c] >= out->point_count)
        return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: face %zu refers to point %u, but there are %zu", s.name,
                            f + 1, out->corners[c] + 1, out->point_count);
  return true;
}

bool vs_mesh_file_read(const vs_file_bytes *file, vs_poller poll, vs_face_list *out, vs_error *e) {
  if (!vs_points_file_read(file, poll, false, out, e)) return false;
  return out->face_count ||
         vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: there are no faces in it", base_name(file->name));
}
