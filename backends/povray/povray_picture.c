/* Owns what becomes of POV-Ray's picture before it is handed on: it is copied without what differs from one run to the
 * next.
 *
 * POV-Ray always renders an EXR, linear light in half floats. It writes the date, its version and the platform into
 * attributes of the header, which are left out; the table behind it holds where in the file each block of lines begins,
 * so these numbers go down by as much as the header becomes shorter. All else is copied byte by byte. A PNG is made of
 * the light here (geometry/pictures/tone.c): POV-Ray would cut off what is brighter than white. */
#include "backends/povray/povray_picture.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "backends/povray/povray_layers.h"
#include "geometry/files/exr_read.h"
#include "geometry/files/png_write.h"

typedef struct { unsigned char *at; size_t count; } picture_bytes;

static bool picture_read(vs_emitter *e, const char *path, picture_bytes *out) {
  struct stat info;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray made no picture");
  bool ok = fstat(file, &info) == 0;
  size_t size = ok ? (size_t)info.st_size : 0;
  out->at = ok ? malloc(size + 1) : NULL;
  while (ok && out->at && out->count < size) {
    ssize_t count = read(file, out->at + out->count, size - out->count);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    out->count += (size_t)count;
  }
  close(file);
  if (ok && !out->at) return vs_emit_no_memory(e);
  return (ok && out->count == size) ||
         vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray's picture cannot be read");
}

static bool picture_write(vs_emitter *e, const char *path, const picture_bytes *p) {
  int file = open(path, O_WRONLY | O_TRUNC | O_CLOEXEC);
  bool ok = file >= 0;
  for (size_t sent = 0; ok && sent < p->count;) {
    ssize_t part = write(file, p->at + sent, p->count - sent);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) ok = false;
    else sent += (size_t)part;
  }
  int problem = errno;
  if (file >= 0 && close(file) != 0 && ok) ok = false, problem = errno;
  return ok || vs_error_set(e->error, VS_ERROR_FILE, NULL, "the picture could not be written: %s",
                            problem == ENOSPC ? "the disk is full" : strerror(problem));
}

/* Takes `count` bytes out of the picture. */
static void picture_cut(picture_bytes *p, size_t from, size_t count) {
  memmove(p->at + from, p->at + from + count, p->count - from - count);
  p->count -= count;
}

static uint64_t picture_little(const unsigned char *at, int bytes) {
  uint64_t x = 0;
  while (bytes-- > 0) x = x << 8 | at[bytes];
  return x;
}

/* An attribute is its name, its type, both ending in a zero, the count of its bytes in four, and the bytes. Returns its
 * size; 0: there is none, or it is cut off. */
static size_t picture_attribute(const unsigned char *at, size_t left) {
  const unsigned char *name = memchr(at, 0, left);
  if (!name || name == at) return 0;
  const unsigned char *type = memchr(name + 1, 0, left - (size_t)(name + 1 - at));
  size_t head = type ? (size_t)(type + 5 - at) : left + 1;
  if (head > left) return 0;
  size_t whole = head + (size_t)picture_little(type + 1, 4);
  return whole <= left ? whole : 0;
}

static void picture_plain_exr(picture_bytes *p) {
  static const char *const dated[] = { "creation", "comments", "software" };
  size_t at = 8, less = 0, size;
  while ((size = picture_attribute(p->at + at, p->count - at)) > 0) {
    bool cut = false;
    for (size_t i = 0; i < sizeof dated / sizeof *dated; i++)
      cut = cut || strcmp((const char *)p->at + at, dated[i]) == 0;
    if (cut) picture_cut(p, at, size), less += size;
    else at += size;
  }
  if (++at + 8 > p->count || less == 0) return;
  uint64_t first = picture_little(p->at + at, 8) - less; /* the first block follows the table */
  for (size_t entry = at; entry + 8 <= first && entry + 8 <= p->count; entry += 8) {
    uint64_t where = picture_little(p->at + entry, 8) - less;
    for (int i = 0; i < 8; i++) p->at[entry + (size_t)i] = (unsigned char)(where >> (8 * i));
  }
}

/* Of a part POV-Ray makes a picture of the whole's size, black elsewhere. */
static bool picture_part(vs_emitter *e, vs_exr *x) {
  const int *c = e->options->crop;
  if (c[2] && (x->columns < (uint32_t)(c[0] + c[2]) || x->rows < (uint32_t)(c[1] + c[3])))
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray's picture has another size");
  return !c[2] || vs_exr_crop(x, (uint32_t)c[0], (uint32_t)c[1], (uint32_t)c[2], (uint32_t)c[3], e->error);
}

/* The light, a part of it or with the layers, written anew. */
static bool picture_anew(vs_emitter *e, const char *from, const char *to) {
  vs_store *store = e->scene->store;
  picture_bytes p = { NULL, 0 };
  vs_exr x = { .store = store };
  unsigned char *exr = NULL;
  size_t size = 0, room = 0;
  bool ok = picture_read(e, from, &p) && vs_exr_read(store, "POV-Ray's picture", p.at, p.count, NULL, &x, e->error);
  free(p.at);
  uint32_t columns = x.columns, rows = x.rows;
  ok = ok && picture_part(e, &x) && (!e->options->layers || vs_povray_layers(e, &x, columns, rows)) &&
       vs_exr_write(&x, &exr, &size, &room, e->error) && picture_write(e, to, &(picture_bytes){ exr, size });
  if (exr) vs_store_realloc(store, exr, room, 0);
  vs_exr_free(&x);
  return ok;
}

bool vs_povray_take_picture(vs_emitter *e, const char *from, const char *to) {
  static const unsigned char exr[] = { 0x76, 0x2F, 0x31, 0x01 };
  picture_bytes p = { NULL, 0 };
  if (e->options->layers || e->options->crop[2]) return picture_anew(e, from, to);
  bool ok = picture_read(e, from, &p);
  if (ok && p.count > 8 && memcmp(p.at, exr, sizeof exr) == 0) picture_plain_exr(&p);
  ok = ok && picture_write(e, to, &p);
  free(p.at);
  return ok;
}

bool vs_povray_develop_picture(vs_emitter *e, const char *from, const char *to) {
  static const char *const wanted[] = { "R", "G", "B", NULL };
  vs_store *store = e->scene->store;
  picture_bytes p = { NULL, 0 };
  vs_exr x = { .store = store };
  bool ok = picture_read(e, from, &p) && vs_exr_read(store, "POV-Ray's picture", p.at, p.count, wanted, &x, e->error);
  free(p.at);
  ok = ok && picture_part(e, &x);
  vs_light light = { vs_exr_find(&x, "R"), vs_exr_find(&x, "G"), vs_exr_find(&x, "B"), (size_t)x.columns * x.rows };
  if (ok && (!light.red || !light.green || !light.blue))
    ok = vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray's picture has no colours");
  unsigned char *rgb = ok ? vs_store_realloc(store, NULL, 0, light.count * 3) : NULL, *png = NULL;
  size_t size = 0, room = 0;
  if (ok && !rgb) ok = vs_emit_no_memory(e);
  if (ok) vs_tone_apply(&light, &e->options->tone, rgb);
  ok = ok && vs_png_write(store, rgb, x.columns, x.rows, &png, &size, &room, e->error);
  if (rgb) vs_store_realloc(store, rgb, light.count * 3, 0);
  vs_exr_free(&x);
  ok = ok && picture_write(e, to, &(picture_bytes){ png, size });
  if (png) vs_store_realloc(store, png, room, 0);
  return ok;
}
