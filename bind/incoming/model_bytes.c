/* Converts model files to Scheme data: the chunks of a .glb, the XML of a .x3d, a part of a .3mf. Sequences of numbers
 * are bytevectors of doubles. load_model.scm creates objects from these data.
 *
 * The library libzip, which unpacks .3mf, is loaded when it is first used. */
#include "bind/incoming/model_bytes.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

#include "bind/incoming/file_texts.h"
#include "bind/incoming/xml_events.h"
#include "geometry/dynamic.h"
#include "vm/library/port.h"
#include "vm/machine/activation.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

/* ---- .glb ---- */

static uint32_t u32_at(const unsigned char *b) {
  return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* Sets *out to a bytevector with a copy of the `count` bytes at `at`. */
static bool bytes_of(vs_scheme *vm, const char *at, size_t count, vs_value *out) {
  if (!vs_make_bytes(vm, count, out)) return false;
  if (count) memcpy(vs_as_bytes(*out)->at, at, count);
  return true;
}

/* Sets *out to a pair: the JSON chunk of a .glb as a string, and the bytes of its binary chunk. */
static vs_status glb_chunks(vs_scheme *vm, vs_value path, const vs_text *file, vs_value *out) {
  const unsigned char *b = (const unsigned char *)file->at;
  if (file->count < 20 || memcmp(b, "glTF", 4) != 0)
    return vs_incoming_broken(vm, path, 1, "this is no .glb: it does not begin with glTF");
  if (u32_at(b + 4) != 2) return vs_incoming_broken(vm, path, 1, "only version 2 of .glb is read");
  size_t json = u32_at(b + 12), all = u32_at(b + 8);
  if (all > file->count || all < 20 || json > all - 20 || memcmp(b + 16, "JSON", 4) != 0)
    return vs_incoming_broken(vm, path, 1, "the file is cut off");
  size_t next = 20 + json, binary = 0;
  if (all >= next + 8 && memcmp(b + next + 4, "BIN", 4) == 0) {
    binary = u32_at(b + next);
    if (binary > all - next - 8) return vs_incoming_broken(vm, path, 1, "the file is cut off");
  }
  VS_ROOTS(vm, r, 2);
  return vs_string_from_utf8(vm, file->at + 20, json, &r[0]) &&
         bytes_of(vm, binary ? file->at + next + 8 : "", binary, &r[1]) && vs_cons(vm, r[0], r[1], out);
}

/* ---- .3mf ---- */

#define ZIP_FUNCTIONS(F)                                                                                       \
  F(source, zip_source_buffer_create, zip_source_t *, (const void *, zip_uint64_t, int, zip_error_t *))        \
  F(source_free, zip_source_free, void, (zip_source_t *))                                                      \
  F(open, zip_open_from_source, zip_t *, (zip_source_t *, int, zip_error_t *))                                 \
  F(locate, zip_name_locate, zip_int64_t, (zip_t *, const char *, zip_flags_t))                                \
  F(file, zip_fopen_index, zip_file_t *, (zip_t *, zip_uint64_t, zip_flags_t))                                 \
  F(read, zip_fread, zip_int64_t, (zip_file_t *, void *, zip_uint64_t))                                        \
  F(close, zip_fclose, int, (zip_file_t *))                                                                    \
  F(discard, zip_discard, void, (zip_t *))

VS_DYNAMIC_FUNCTIONS(ZIP_FUNCTIONS);

/* Appends the text of a part of the .3mf package to *out. Sets *found to true if the package has the part; upper and
 * lower case of its name count as equal. */
static bool unpack(vs_scheme *vm, const dynamic_functions *z, zip_t *zip, const char *part, bool *found, bool *whole,
                   vs_text *out) {
  static const uint64_t most = UINT64_C(1) << 32; /* bytes; a small package can unpack to any size */
  char piece[16384];
  zip_int64_t at = z->locate(zip, part, ZIP_FL_NOCASE), count = 0;
  zip_file_t *file = at >= 0 ? z->file(zip, (zip_uint64_t)at, 0) : NULL;
  bool ok = true;
  *found = at >= 0, *whole = file != NULL;
  while (ok && file && (count = z->read(file, piece, sizeof piece)) > 0)
    ok = vs_poll(vm, 64) && out->count < most && vs_text_put(out, piece, (size_t)count);
  if (count < 0 || out->count >= most) *whole = false;
  if (file) z->close(file);
  return ok || out->count >= most;
}

/* Sets *out to the XML events of a part of the .3mf package, or to #f if the package has no such part. */
static vs_status package_part(vs_scheme *vm, vs_value path, vs_value name, const vs_text *file, vs_value *out) {
  dynamic_functions z;
  vs_error e = { 0 };
  vs_text part, text;
  VS_ROOTS(vm, r, 1);
  r[0] = path;
  if (!vs_dynamic_load(VS_LIBRARY_LIBZIP, "reading .3mf", dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                       &z, &e))
    return vs_fail(vm, vm->sym.file, "%s", e.message);
  vs_text_open(vm, &part, 0);
  vs_text_open(vm, &text, 0);
  bool found = false, whole = false, ok = vs_text_string(&part, name) && vs_text_end(&part);
  zip_source_t *source = ok ? z.source(file->at, file->count, 0, NULL) : NULL;
  zip_t *zip = source ? z.open(source, ZIP_RDONLY, NULL) : NULL;
  if (ok && !zip) ok = vs_incoming_broken(vm, r[0], 1, "this is no .3mf: it is no zip, or cut off");
  ok = ok && unpack(vm, &z, zip, part.at, &found, &whole, &text);
  if (ok && found && !whole) ok = vs_incoming_broken(vm, r[0], 1, "a part of the package cannot be unpacked");
  if (zip) z.discard(zip);
  else if (source) z.source_free(source);
  *out = VS_FALSE;
  ok = ok && (!found || vs_xml_text_events(vm, r[0], &text, true, out));
  vs_text_close(&part);
  vs_text_close(&text);
  return ok;
}

/* (%load-model path part): if part is #t, returns the chunks of a .glb; if it is #f, the events of an XML file. If it
 * is a string, returns the XML events of this part of a .3mf package, or #f. */
static vs_status load_model(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text file;
  if (a[1] == VS_FALSE) return vs_xml_events(vm, a[0], out);
  vs_text_open(vm, &file, 0);
  bool ok = vs_incoming_read(vm, a[0], &file) &&
            (a[1] == VS_TRUE ? glb_chunks(vm, a[0], &file, out) : package_part(vm, a[0], a[1], &file, out));
  vs_text_close(&file);
  return ok;
}

/* ---- numbers ---- */

/* Returns the number at b, which has the component type `type` of glTF. */
static double component_at(const unsigned char *b, int64_t type) {
  uint32_t bits = type >= 5125 ? u32_at(b) : 0, half = (uint32_t)b[0] | (type >= 5122 ? (uint32_t)b[1] << 8 : 0);
  float f;
  memcpy(&f, &bits, sizeof f);
  switch (type) {
  case 5120: return (int8_t)b[0];
  case 5121: return b[0];
  case 5122: return (int16_t)half;
  case 5123: return half;
  case 5125: return bits;
  }
  return (double)f;
}
static int64_t component_size(int64_t type) {
  return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : type == 5125 || type == 5126 ? 4 : 0;
}

/* (%glb-numbers bytes offset end stride count width type): returns the numbers of `count` items from `offset` on, each
 * with `width` components of a type of glTF. The stride is the distance between items in bytes, or 0 if the items
 * follow each other. Returns #f if an item exceeds `end`. Each argument except bytes is a fixnum from 0 to 2^33, and
 * `end` is at most the number of bytes. */
static vs_status glb_numbers(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t at[6];
  for (int i = 0; i < 6; i++)
    if (!vs_arg_index(vm, a, i + 1, 0, (int64_t)1 << 33, &at[i])) return VS_ERROR;
  int64_t offset = at[0], length = at[1], count = at[3], width = at[4], type = at[5], size = component_size(type),
          stride = at[2] ? at[2] : size * width;
  *out = VS_FALSE;
  if (!size || width < 1 || width > 16 || offset > length ||
      (count > 0 && (length - offset < size * width || (length - offset - size * width) / stride < count - 1)))
    return VS_OK;
  VS_ROOTS(vm, r, 1);
  if (!vs_make_bytes(vm, (size_t)(8 * count * width), &r[0])) return VS_ERROR;
  for (int64_t i = 0; i < count; i++) {
    if (!vs_poll_turn(vm, (uint64_t)i, 8)) return VS_ERROR;
    for (int64_t k = 0; k < width; k++) {
      double d = component_at(vs_as_bytes(a[0])->at + offset + i * stride + k * size, type);
      memcpy(vs_as_bytes(r[0])->at + 8 * (i * width + k), &d, 8);
    }
  }
  *out = r[0];
  return VS_OK;
}

/* (%text-numbers text): returns the numbers in a text, separated by blanks or commas, or #f if the text contains
 * anything else. */
static vs_status text_numbers(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_text text, numbers;
  vs_text_open(vm, &text, 0);
  vs_text_open(vm, &numbers, 0);
  bool ok = vs_text_string(&text, a[0]) && vs_text_end(&text), right = true;
  const char *at = text.at;
  for (uint64_t i = 0; ok && right; i++) {
    while (isspace((unsigned char)*at) || *at == ',') at++;
    if (!*at) break;
    char *end;
    double d = memchr("+-.0123456789", *at, 13) ? strtod(at, &end) : NAN;
    right = isfinite(d) && (!*end || isspace((unsigned char)*end) || *end == ',');
    ok = vs_poll_turn(vm, i, 16) && vs_text_put(&numbers, (const char *)&d, sizeof d);
    if (right) at = end;
  }
  *out = VS_FALSE;
  ok = ok && (!right || bytes_of(vm, numbers.at, numbers.count, out));
  vs_text_close(&text);
  vs_text_close(&numbers);
  return ok;
}

/* (%numbers-times bytes k): returns the numbers in `bytes`, each multiplied by k. */
static vs_status numbers_times(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  size_t count = (size_t)vs_as_bytes(a[0])->length / 8;
  VS_ROOTS(vm, r, 1);
  if (!vs_poll(vm, count) || !vs_make_bytes(vm, 8 * count, &r[0])) return VS_ERROR;
  for (size_t i = 0; i < count; i++) {
    double d;
    memcpy(&d, vs_as_bytes(a[0])->at + 8 * i, 8);
    d *= vs_double(a[1]);
    memcpy(vs_as_bytes(r[0])->at + 8 * i, &d, 8);
  }
  *out = r[0];
  return VS_OK;
}

/* (%numbers-counted n): returns the numbers 0 to n - 1. */
static vs_status numbers_counted(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  int64_t count;
  if (!vs_arg_index(vm, a, 0, 0, (int64_t)1 << 32, &count)) return VS_ERROR;
  if (!vs_poll(vm, (uint64_t)count) || !vs_make_bytes(vm, 8 * (size_t)count, out)) return VS_ERROR;
  for (int64_t i = 0; i < count; i++) {
    double d = (double)i;
    memcpy(vs_as_bytes(*out)->at + 8 * i, &d, 8);
  }
  return VS_OK;
}

/* (%numbers->list bytes): returns a list of the numbers in `bytes`. */
static vs_status numbers_list(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  VS_ROOTS(vm, r, 1);
  r[0] = VS_NIL;
  for (size_t i = (size_t)vs_as_bytes(a[0])->length / 8; i-- > 0;) {
    double d;
    memcpy(&d, vs_as_bytes(a[0])->at + 8 * i, 8);
    if (!vs_poll_turn(vm, i, 4) || !vs_cons(vm, vs_flonum(d), r[0], &r[0])) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

typedef struct { double pid, place; size_t triangle; } painted;

static int compare_paints(const void *a, const void *b) {
  const painted *p = a, *q = b;
  if (p->pid != q->pid) return p->pid < q->pid ? -1 : 1;
  if (p->place != q->place) return p->place < q->place ? -1 : 1;
  return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

/* (%painted-triangles bytes): bytes has five numbers for each triangle: three corners v1 v2 v3, and pid p1, which
 * select its material in 3MF. Returns a list of (pid p1 . corners), one for each pair of pid and p1. */
static vs_status painted_triangles(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  size_t count = (size_t)vs_as_bytes(a[0])->length / 40;
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  painted *all = vs_mem(vm, NULL, 0, (count + 1) * sizeof *all);
  bool ok = all && vs_poll(vm, count);
  for (size_t i = 0; ok && i < count; i++) {
    double row[5];
    memcpy(row, vs_as_bytes(a[0])->at + 40 * i, 40);
    all[i] = (painted){ row[3], row[4], i };
  }
  if (ok) qsort(all, count, sizeof *all, compare_paints);
  for (size_t end = count, i; ok && end > 0; end = i) {
    for (i = end - 1; i > 0 && all[i - 1].pid == all[i].pid && all[i - 1].place == all[i].place;) i--;
    ok = vs_make_bytes(vm, 24 * (end - i), &r[1]);
    for (size_t k = i; ok && k < end; k++)
      memcpy(vs_as_bytes(r[1])->at + 24 * (k - i), vs_as_bytes(a[0])->at + 40 * all[k].triangle, 24);
    ok = ok && vs_poll(vm, end - i) && vs_cons(vm, vs_flonum(all[i].place), r[1], &r[1]) &&
         vs_cons(vm, vs_flonum(all[i].pid), r[1], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  }
  if (all) vs_mem(vm, all, (count + 1) * sizeof *all, 0);
  *out = r[0];
  return ok;
}

static const vs_native_def defs[] = {
  { "%load-model", "path part", load_model, 0, NULL }, /* errors show this name without the % */
  { "%glb-numbers", "bytes offset end stride count width type", glb_numbers, 0, NULL },
  { "%text-numbers", "text", text_numbers, 0, NULL },
  { "%numbers-times", "bytes factor", numbers_times, 0, NULL },
  { "%numbers-counted", "count", numbers_counted, 0, NULL },
  { "%numbers->list", "bytes", numbers_list, 0, NULL },
  { "%painted-triangles", "bytes", painted_triangles, 0, NULL },
  { 0 },
};
const vs_native_table vs_model_bytes_table = { "model_bytes", defs };
