/* Reads the mesh files and pictures that a program names. Also lists the names of the prefabs. */
#include "bind/constructors/files.h"

#include "bind/call/call.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "geometry/files/exr_read.h"
#include "geometry/light/ies.h"
#include "geometry/light/panorama_sun.h"
#include "geometry/light/radiance.h"
#include "geometry/pictures/photograph.h"

#include "vm/front/source.h"
#include "vm/library/port.h"
#include "vm/machine/activation.h"
#include "vm/values/heap.h"

/* Reads a file. Sets *shown to its name without folders, and *whole to its path; the store owns both. */
static vs_status file_of(vs_args *f, vs_value name, vs_value *bytes, const char **shown, const char **whole) {
  vs_scheme *vm = f->vm;
  vs_text path, own;
  vs_text_open(vm, &path, 0);
  vs_text_open(vm, &own, 0);
  /* Copies the name first, since an allocation on the heap may move the string. */
  bool ok = vs_text_string(&own, name) && vs_text_end(&own);
  ok = ok && vs_source_path(vm, name, vs_pos_file(vs_call_place(vm)), &path) && vs_text_end(&path) &&
       vs_io_read_file(vm, path.at, bytes);
  if (ok) {
    const char *slash = strrchr(own.at, '/');
    const char *last = slash ? slash + 1 : own.at;
    *shown = vs_store_text(f->store, last, strlen(last));
    *whole = vs_store_text(f->store, path.at, path.count);
    ok = (*shown && *whole) || vs_fail_memory(vm);
  }
  vs_text_close(&path);
  vs_text_close(&own);
  return ok ? VS_OK : VS_ERROR;
}

vs_status vs_bind_file(vs_args *f, const vs_arg *name, vs_value *bytes, const char **shown) {
  const char *whole;
  return file_of(f, name->value, bytes, shown, &whole);
}

/* Stores a picture in the store. `read` contains the picture's path and format, and its columns and rows if they are
 * known; `bytes` are the bytes of its file. */
static vs_status keep_picture(vs_args *f, vs_picture read, const vs_bytes *bytes, const vs_picture **out) {
  read.bytes = bytes->at, read.size = (size_t)bytes->length;
  *out = vs_store_picture(f->store, &read);
  return *out ? VS_OK : vs_fail_memory(f->vm);
}

vs_status vs_bind_picture(vs_args *f, vs_value name, const vs_picture **out, const char **shown, double mean[3]) {
  vs_error e = { 0 };
  vs_photograph read;
  const char *whole;
  VS_ROOTS(f->vm, r, 1);
  if (file_of(f, name, &r[0], shown, &whole) != VS_OK) return VS_ERROR;
  const vs_bytes *bytes = vs_as_bytes(r[0]);
  if (!vs_photograph_read(f->store, &(vs_file_bytes){ *shown, bytes->at, (size_t)bytes->length }, &read, &e))
    return vs_bind_error(f->vm, &e);
  for (int i = 0; i < 3; i++) mean[i] = read.mean[i];
  vs_picture kept = { .path = whole, .format = read.format, .columns = read.columns, .rows = read.rows };
  memcpy(kept.mean, mean, sizeof kept.mean);
  return keep_picture(f, kept, bytes, out);
}

/* Removes the sun from an EXR or HDR picture of a sky. Sets *out to the picture without the sun, or to NULL if the
 * picture shows no sun. */
static vs_status take_sun(vs_args *f, const char *shown, const char *whole, const vs_bytes *bytes, bool exr,
                          const vs_picture **out, vs_panorama_sun *sun) {
  static const char *const wanted[] = { "R", "G", "B", NULL };
  vs_store *store = f->store;
  vs_error e = { 0 };
  vs_exr x = { .store = store };
  vs_made_bytes left = { NULL, 0, 0 };
  vs_file_bytes file = { shown, bytes->at, (size_t)bytes->length };
  if (!(exr ? vs_exr_read(store, &file, wanted, &x, &e) : vs_radiance_read(store, &file, &x, &e)))
    return vs_bind_error(f->vm, &e);
  bool found = vs_panorama_take_sun(&x, sun), ok = !found || vs_exr_write(&x, &left, &e);
  if (ok && found) {
    const vs_picture kept = { whole, "exr", left.at, left.size, x.columns, x.rows, 0, { 0 }, NULL };
    *out = vs_store_picture(store, &kept);
    if (!*out) ok = vs_error_memory(&e, NULL);
  }
  if (left.at) vs_store_realloc(store, left.at, left.room, 0);
  vs_exr_free(&x);
  return ok ? VS_OK : vs_bind_error(f->vm, &e);
}

/* The first bytes determine the file format. */
vs_status vs_bind_sky_picture(vs_args *f, vs_value name, const vs_picture **out, const vs_picture **sunless,
                              vs_panorama_sun *sun) {
  static const struct { const char *format; unsigned char bytes[4]; size_t count;
  } kinds[] = {
    { "png", { 0x89, 'P', 'N', 'G' }, 4 },
    { "jpeg", { 0xFF, 0xD8, 0xFF, 0 }, 3 },
    { "exr", { 0x76, 0x2F, 0x31, 0x01 }, 4 },
    { "hdr", { '#', '?', 'R', 'A' }, 4 },
  };
  const char *shown, *whole, *format = NULL;
  VS_ROOTS(f->vm, r, 1);
  if (file_of(f, name, &r[0], &shown, &whole) != VS_OK) return VS_ERROR;
  const vs_bytes *bytes = vs_as_bytes(r[0]);
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    if ((size_t)bytes->length > 16 && !memcmp(bytes->at, kinds[i].bytes, kinds[i].count)) format = kinds[i].format;
  *sunless = NULL;
  if (!format) return vs_bind_refuse(f, "image", "a PNG, JPEG, EXR or HDR file", name);
  bool exr = !strcmp(format, "exr");
  if ((exr || !strcmp(format, "hdr")) && take_sun(f, shown, whole, bytes, exr, sunless, sun) != VS_OK) return VS_ERROR;
  return keep_picture(f, (vs_picture){ .path = whole, .format = format }, vs_as_bytes(r[0]), out);
}

vs_status vs_bind_lamp_file(vs_args *f, vs_value name, const vs_picture **out) {
  const char *shown, *whole;
  vs_error e = { 0 };
  vs_ies read;
  VS_ROOTS(f->vm, r, 1);
  if (file_of(f, name, &r[0], &shown, &whole) != VS_OK) return VS_ERROR;
  const vs_bytes *bytes = vs_as_bytes(r[0]);
  if (!vs_ies_read(f->store, shown, (const char *)bytes->at, (size_t)bytes->length, &read, &e))
    return vs_bind_error(f->vm, &e);
  vs_ies_free(&read);
  return keep_picture(f, (vs_picture){ .path = whole, .format = "ies" }, bytes, out);
}

/* ---- names of the prefabs, whose files prefabs.scm runs ---- */

/* (prefab-names): returns the names of the prefabs in alphabetical order, the order in which their files are stored. */
vs_status vs_p_prefab_names(vs_args *f, vs_value *out) {
  static const char folder[] = "prefabs/", ending[] = ".vs";
  const size_t before = sizeof folder - 1, after = sizeof ending - 1;
  size_t count = 0;
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (const vs_shipped *s = f->vm->config.shipped; s && s->name; s++) count++;
  while (count-- > 0) {
    const char *name = f->vm->config.shipped[count].name;
    size_t length = strlen(name);
    if (strncmp(name, folder, before) || length <= before + after || strcmp(name + length - after, ending)) continue;
    if (!vs_string_from_utf8(f->vm, name + before, length - before - after, &r[1]) ||
        !vs_cons(f->vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}
