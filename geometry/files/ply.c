/* Reads PLY files. A header lists the properties of each element. The elements follow, as text or binary in either byte
 * order.
 *
 * The reader keeps three kinds of elements, and skips others by their types:
 *   vertex     its properties x, y, z
 *   face       its list vertex_indices or vertex_index
 *   tristrips  such a list: each corner from the third on makes a triangle with the two before it, every second
 *              triangle in reverse order; -1 begins a new strip */
#include "geometry/files/ply.h"

#include <string.h>

typedef enum { PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64, PLY_TYPES } ply_type;
typedef enum { PLY_OTHER, PLY_X, PLY_Y, PLY_Z, PLY_CORNERS, PLY_STRIPS } ply_role;
typedef struct { ply_type type, count_type; bool list; ply_role role; } ply_property;
enum { PLY_PROPERTIES = 64, PLY_ELEMENTS = 16 };
typedef struct {
  char name[VS_SCAN_WORD];
  uint64_t count;
  ply_property at[PLY_PROPERTIES];
  size_t properties;
} ply_element;
typedef enum { PLY_WORDS, PLY_LITTLE, PLY_BIG } ply_form;

static const unsigned char ply_width[PLY_TYPES] = { 1, 1, 2, 2, 4, 4, 4, 8 };

static bool ply_type_of(const vs_byte_scan *s, const char *word, ply_type *out) {
  static const char *const names[PLY_TYPES][2] = { { "char", "int8" },     { "uchar", "uint8" },   { "short", "int16" },
                                                   { "ushort", "uint16" }, { "int", "int32" },     { "uint", "uint32" },
                                                   { "float", "float32" }, { "double", "float64" } };
  for (int i = 0; i < PLY_TYPES; i++)
    if (!strcmp(word, names[i][0]) || !strcmp(word, names[i][1])) return *out = (ply_type)i, true;
  return vs_scan_fail(s, "\"%.32s\" is no type of PLY", word);
}

/* ---- the header ---- */

static bool ply_header_property(vs_byte_scan *s, ply_element *e) {
  char word[VS_SCAN_WORD];
  if (!e) return vs_scan_fail(s, "a property comes before any element");
  if (e->properties == PLY_PROPERTIES) return vs_scan_fail(s, "an element has more than %d properties", PLY_PROPERTIES);
  ply_property *p = &e->at[e->properties];
  *p = (ply_property){ .role = PLY_OTHER };
  vs_scan_word(s, false, 0, word);
  p->list = !strcmp(word, "list");
  if (p->list) {
    vs_scan_word(s, false, 0, word);
    if (!ply_type_of(s, word, &p->count_type)) return false;
    if (p->count_type >= PLY_F32) return vs_scan_fail(s, "a list cannot have %s items", word);
    vs_scan_word(s, false, 0, word);
  }
  if (!ply_type_of(s, word, &p->type)) return false;
  vs_scan_word(s, false, 0, word);
  if (!strcmp(e->name, "vertex") && !p->list && !word[1] && word[0] >= 'x' && word[0] <= 'z')
    p->role = (ply_role)(PLY_X + (word[0] - 'x'));
  bool corners = p->list && p->type < PLY_F32 && (!strcmp(word, "vertex_indices") || !strcmp(word, "vertex_index"));
  if (corners && !strcmp(e->name, "face")) p->role = PLY_CORNERS;
  if (corners && !strcmp(e->name, "tristrips")) p->role = PLY_STRIPS;
  e->properties++;
  return true;
}

static bool ply_header(vs_byte_scan *s, ply_form *form, ply_element *elements, size_t *count) {
  char word[VS_SCAN_WORD];
  bool formed = false;
  s->line = 1;
  vs_scan_word(s, false, 0, word);
  if (strcmp(word, "ply")) return vs_scan_fail(s, "this is no PLY file: it does not begin with \"ply\"");
  for (*count = 0;;) {
    vs_scan_next_line(s);
    if (s->at >= s->size) return vs_scan_fail(s, "the file ends in its header");
    vs_scan_word(s, false, 0, word);
    if (!strcmp(word, "end_header")) break;
    if (!strcmp(word, "format")) {
      vs_scan_word(s, false, 0, word);
      *form = !strcmp(word, "ascii") ? PLY_WORDS : !strcmp(word, "binary_little_endian") ? PLY_LITTLE : PLY_BIG;
      formed = true;
      if (*form == PLY_BIG && strcmp(word, "binary_big_endian"))
        return vs_scan_fail(s, "expected the format ascii, binary_little_endian or binary_big_endian, got \"%.32s\"",
                            word);
    } else if (!strcmp(word, "element")) {
      if (*count == PLY_ELEMENTS) return vs_scan_fail(s, "there are more than %d kinds of element", PLY_ELEMENTS);
      ply_element *e = &elements[*count];
      int64_t n;
      vs_scan_word(s, false, 0, e->name);
      if (!vs_scan_integer(s, false, 0, &n)) return false;
      if (n < 0) return vs_scan_fail(s, "there cannot be %lld elements", (long long)n);
      e->count = (uint64_t)n;
      e->properties = 0;
      ++*count;
    } else if (!strcmp(word, "property")) {
      if (!ply_header_property(s, *count ? &elements[*count - 1] : NULL)) return false;
    } /* ignores the file's comment and obj_info lines */
  }
  if (!formed) return vs_scan_fail(s, "the header names no format");
  vs_scan_next_line(s);
  return true;
}

/* ---- the elements ---- */

static bool ply_value(vs_byte_scan *s, ply_form form, ply_type type, double *out) {
  if (form == PLY_WORDS) return vs_scan_real(s, true, 0, out);
  size_t width = ply_width[type];
  if (s->size - s->at < width) return vs_scan_fail(s, "the file is cut off");
  uint64_t bits = 0;
  for (size_t i = 0; i < width; i++)
    bits |= (uint64_t)s->bytes[s->at + (form == PLY_LITTLE ? i : width - 1 - i)] << 8 * i;
  s->at += width;
  switch (type) {
    case PLY_I8: *out = (int8_t)bits; break;
    case PLY_U8: *out = (double)(uint8_t)bits; break;
    case PLY_I16: *out = (int16_t)bits; break;
    case PLY_U16: *out = (double)(uint16_t)bits; break;
    case PLY_I32: *out = (int32_t)bits; break;
    case PLY_U32: *out = (double)(uint32_t)bits; break;
    case PLY_F32: {
      uint32_t half = (uint32_t)bits;
      float f;
      memcpy(&f, &half, sizeof f);
      *out = (double)f;
      break;
    }
    case PLY_F64: memcpy(out, &bits, sizeof *out); break;
    case PLY_TYPES: break;
  }
  return true;
}

/* State of the reading of a strip of triangles: its last two corners, and the number of corners so far. */
typedef struct { uint32_t last[2]; uint64_t count; } ply_strip;

/* Adds a corner to a strip of triangles. Strips may repeat a corner to change direction. The triangles with a repeated
 * corner have no area and are omitted. */
static bool ply_strip_corner(ply_strip *s, uint32_t corner, vs_face_list *out) {
  uint32_t a = s->last[s->count % 2], b = s->last[1 - s->count % 2]; /* a, b: the last two corners in the order of the
                                                                      * triangle; every second triangle of a strip is
                                                                      * reversed */
  bool ok = true;
  if (s->count >= 2 && a != b && a != corner && b != corner)
    ok = vs_face_list_corner(out, a) && vs_face_list_corner(out, b) && vs_face_list_corner(out, corner) &&
         vs_face_list_close(out);
  s->last[0] = s->last[1];
  s->last[1] = corner;
  s->count++;
  return ok;
}

static bool ply_one(vs_byte_scan *s, ply_form form, const ply_element *e, uint64_t number, uint64_t points,
                    vs_face_list *out) {
  double xyz[3] = { 0, 0, 0 }, value, items;
  bool ok = true;
  for (size_t i = 0; ok && i < e->properties; i++) {
    const ply_property *p = &e->at[i];
    if (!p->list) {
      if (!ply_value(s, form, p->type, &value)) return false;
      if (p->role >= PLY_X && p->role <= PLY_Z) xyz[p->role - PLY_X] = value;
      continue;
    }
    if (!ply_value(s, form, p->count_type, &items)) return false;
    if (!(items >= 0) || items > (double)(s->size - s->at) || items != floor(items))
      return vs_scan_fail(s, "%s %llu cannot have a list of %.6g", e->name, (unsigned long long)number + 1, items);
    ply_strip strip = { { 0, 0 }, 0 };
    for (uint64_t k = 0; ok && k < (uint64_t)items; k++) {
      if (!ply_value(s, form, p->type, &value)) return false;
      if (p->role != PLY_CORNERS && p->role != PLY_STRIPS) continue;
      if (p->role == PLY_STRIPS && value == -1) {
        strip.count = 0;
        continue;
      }
      if (!(value >= 0) || value >= (double)points || value != floor(value))
        return vs_scan_fail(s, "%s %llu refers to point %.10g, but there are %llu, counted from 0", e->name,
                            (unsigned long long)number + 1, value, (unsigned long long)points);
      ok = p->role == PLY_STRIPS ? ply_strip_corner(&strip, (uint32_t)value, out)
                                 : vs_face_list_corner(out, (uint32_t)value);
    }
    if (ok && p->role == PLY_CORNERS) ok = vs_face_list_close(out);
  }
  if (ok && !strcmp(e->name, "vertex")) {
    bool finite = isfinite(xyz[0]) && isfinite(xyz[1]) && isfinite(xyz[2]);
    if (!finite && !s->nowhere)
      return vs_scan_fail(s, "point %llu is not at a finite place", (unsigned long long)number + 1);
    ok = vs_face_list_point(out, vs_v3(xyz[0], xyz[1], xyz[2]));
  }
  return (ok || vs_error_memory(s->error, NULL)) && vs_scan_poll(s);
}

bool vs_ply_read(vs_byte_scan *s, vs_face_list *out) {
  ply_element elements[PLY_ELEMENTS];
  ply_form form = PLY_WORDS;
  size_t count = 0;
  uint64_t points = 0;
  if (!ply_header(s, &form, elements, &count)) return false;
  for (size_t i = 0; i < count; i++) {
    ply_element *e = &elements[i];
    size_t least = 0, roles = 0; /* least: smallest possible size of an element of the file in bytes, to check the
                                  * number of elements against the file's size */
    for (size_t k = 0; k < e->properties; k++) {
      least += form == PLY_WORDS ? 1 : ply_width[e->at[k].list ? e->at[k].count_type : e->at[k].type];
      roles += e->at[k].role != PLY_OTHER;
    }
    if (!strcmp(e->name, "vertex") && roles != 3) return vs_scan_fail(s, "the vertices have no x, y and z");
    if (!strcmp(e->name, "face") && roles != 1) return vs_scan_fail(s, "the faces have no list vertex_indices");
    if (!strcmp(e->name, "tristrips") && roles != 1)
      return vs_scan_fail(s, "the tristrips have no list vertex_indices");
    if (!strcmp(e->name, "vertex")) points += e->count;
    if (least && e->count > (s->size - s->at) / least + 1)
      return vs_scan_fail(s, "the file is cut off: it is too short for %llu of element %s",
                          (unsigned long long)e->count, e->name);
    if (form != PLY_WORDS) s->line = 0; /* the file is binary, so messages about its data name the byte instead of the
                                         * line */
    for (uint64_t n = 0; least && n < e->count; n++)
      if (!ply_one(s, form, e, n, points, out)) return false;
  }
  return true;
}
