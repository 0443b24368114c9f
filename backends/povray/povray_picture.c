/* Owns what becomes of POV-Ray's picture before it is handed on.
 *
 * POV-Ray always renders an EXR, linear light in half floats. Its header has the date, its version and the platform in
 * it: an .exr is written anew by OpenEXR's library, the same numbers with what was seen from where in what sun. A PNG
 * is made of the light here (geometry/pictures/tone.c): POV-Ray would cut off what is brighter than white. */
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
#include "model/store/array.h"

typedef struct { unsigned char *at; size_t count; } picture_bytes;

static bool picture_read(vs_emitter *e, const char *path, picture_bytes *out) {
  struct stat info;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray made no picture");
  bool ok = fstat(file, &info) == 0;
  size_t size = ok ? (size_t)info.st_size : 0;
  out->at = ok ? vs_fresh(size + 1, 1) : NULL;
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

/* Of a part POV-Ray makes a picture of the whole's size, black elsewhere. */
static bool picture_part(vs_emitter *e, vs_exr *x) {
  const int *c = e->options->crop;
  if (c[2] && (x->columns < (uint32_t)(c[0] + c[2]) || x->rows < (uint32_t)(c[1] + c[3])))
    return vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray's picture has another size");
  return !c[2] || vs_exr_crop(x, (uint32_t)c[0], (uint32_t)c[1], (uint32_t)c[2], (uint32_t)c[3], e->error);
}

/* The light, written anew: all of it or a part, with the layers if they are wanted. */
bool vs_povray_take_picture(vs_emitter *e, const char *from, const char *to) {
  vs_store *store = e->scene->store;
  picture_bytes p = { NULL, 0 };
  vs_exr x = { .store = store };
  vs_made_bytes exr = { NULL, 0, 0 };
  bool ok = picture_read(e, from, &p) &&
      vs_exr_read(store, &(vs_file_bytes){ "POV-Ray's picture", p.at, p.count }, NULL, &x, e->error);
  free(p.at);
  uint32_t columns = x.columns, rows = x.rows;
  ok = ok && picture_part(e, &x) && vs_povray_say_view(e, &x, columns, rows) &&
       (!e->options->layers || vs_povray_layers(e, &x, columns, rows)) &&
       vs_exr_write(&x, &exr, e->error) && picture_write(e, to, &(picture_bytes){ exr.at, exr.size });
  if (exr.at) vs_store_realloc(store, exr.at, exr.room, 0);
  vs_exr_free(&x);
  return ok;
}

bool vs_povray_develop_picture(vs_emitter *e, const char *from, const char *to) {
  static const char *const wanted[] = { "R", "G", "B", NULL };
  vs_store *store = e->scene->store;
  picture_bytes p = { NULL, 0 };
  vs_exr x = { .store = store };
  bool ok = picture_read(e, from, &p) &&
      vs_exr_read(store, &(vs_file_bytes){ "POV-Ray's picture", p.at, p.count }, wanted, &x, e->error);
  free(p.at);
  ok = ok && picture_part(e, &x);
  vs_light light = { vs_exr_find(&x, "R"), vs_exr_find(&x, "G"), vs_exr_find(&x, "B"), x.columns, x.rows };
  if (ok && (!light.red || !light.green || !light.blue))
    ok = vs_error_set(e->error, VS_ERROR_WORKER, NULL, "POV-Ray's picture has no colours");
  unsigned char *rgb = ok ? vs_store_realloc(store, NULL, 0, vs_light_pixels(&light) * 3) : NULL;
  vs_made_bytes png = { NULL, 0, 0 };
  if (ok && !rgb) ok = vs_emit_no_memory(e);
  if (ok) vs_tone_apply(&light, &e->options->tone, rgb);
  ok = ok && vs_png_write(store, &(vs_pixels){ rgb, x.columns, x.rows }, &png, e->error);
  if (rgb) vs_store_realloc(store, rgb, vs_light_pixels(&light) * 3, 0);
  vs_exr_free(&x);
  ok = ok && picture_write(e, to, &(picture_bytes){ png.at, png.size });
  if (png.at) vs_store_realloc(store, png.at, png.room, 0);
  return ok;
}
