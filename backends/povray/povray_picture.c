/* Processes POV-Ray's picture: joins its parts, and writes the whole as .exr or .png.
 *
 * POV-Ray always renders an EXR of linear light in half floats. The header of this file contains the date, POV-Ray's
 * version and the platform. OpenEXR's library therefore writes a new .exr: the same numbers, with texts for the camera
 * and the sun. geometry/pictures/tone.c computes a PNG from the light, because POV-Ray would cut off colours brighter
 * than white. */
#include "backends/povray/povray_picture.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "backends/povray/povray_layers.h"
#include "backends/povray/povray_sky.h"
#include "geometry/files/exr_read.h"
#include "geometry/files/png_write.h"
#include "model/store/array.h"

enum { POV_PATH = 4200 };

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

/* Divides the light of the picture by the gain, the factor by which the scene's lights were multiplied. */
static void picture_remove_gain(vs_exr *x, double gain) {
  float share = (float)(1 / gain);
  for (size_t k = 0; share < 1 && k < x->count; k++)
    for (size_t i = 0; i < (size_t)x->columns * x->rows; i++) x->channels[k].at[i] *= share;
}

/* Copies the parts of the picture that the jobs have rendered into an empty picture of the size `wanted`. Pictures of
 * the night become floats, because half floats have few digits for dark colours. */
static bool picture_join(vs_emitter *e, const char *folder, const vs_povray_job *jobs, size_t count,
                         const vs_exr_part *wanted, vs_exr *x) {
  static const char *const channels[] = { "B", "G", "R" };
  double gain = vs_povray_gain(e->scene);
  bool ok = true;
  x->columns = wanted->columns, x->rows = wanted->rows;
  for (size_t i = 0; ok && i < sizeof channels / sizeof *channels; i++)
    ok = vs_exr_add(x, channels[i], gain > 1 ? VS_EXR_FLOAT : VS_EXR_HALF, e->error) != NULL;
  for (size_t i = 0; ok && i < count; i++) {
    const vs_exr_part *p = &jobs[i].part;
    uint32_t left = p->left > wanted->left ? p->left : wanted->left, top = p->top > wanted->top ? p->top : wanted->top;
    uint32_t right = wanted->left + wanted->columns, bottom = wanted->top + wanted->rows;
    if (p->left + p->columns < right) right = p->left + p->columns;
    if (p->top + p->rows < bottom) bottom = p->top + p->rows;
    if (right <= left || bottom <= top) continue;
    vs_exr_cut cut = { jobs[i].columns, jobs[i].rows, { left, top, right - left, bottom - top },
                       left - wanted->left, top - wanted->top };
    char path[POV_PATH];
    picture_bytes b = { NULL, 0 };
    snprintf(path, sizeof path, "%s/%s.exr", folder, jobs[i].name);
    ok = picture_read(e, path, &b) &&
         vs_exr_read_cut(&(vs_file_bytes){ "POV-Ray's picture", b.at, b.count }, &cut, x, e->error);
    free(b.at);
  }
  if (ok) picture_remove_gain(x, gain);
  return ok;
}

/* Joins the pictures of the plan's jobs, except those of the first pass, in *x. *x becomes the part of the picture that
 * `part` selects. */
static bool picture_take(vs_emitter *e, const vs_povray_result *r, const vs_exr_part *part, vs_exr *x) {
  const vs_povray_plan *p = r->plan;
  return picture_join(e, r->folder, p->jobs + p->pass_count, p->count - p->pass_count, part, x);
}

static vs_light picture_light(const vs_exr *x) {
  return (vs_light){ vs_exr_find(x, "R"), vs_exr_find(x, "G"), vs_exr_find(x, "B"), x->columns, x->rows };
}

bool vs_povray_meter(vs_emitter *e, const char *folder, const vs_povray_plan *plan, vs_tone_curve curve,
                     double *stops) {
  vs_exr x = { .store = e->scene->store };
  vs_exr_part all = { 0, 0, plan->jobs[0].columns, plan->jobs[0].rows };
  bool ok = picture_join(e, folder, plan->jobs, plan->pass_count, &all, &x);
  vs_light light = picture_light(&x);
  if (ok) *stops = vs_tone_exposure(&light, curve);
  vs_exr_free(&x);
  return ok;
}

/* Writes the light as a new EXR: the entire picture or a part, with layers if the options select them. */
bool vs_povray_take_picture(vs_emitter *e, const vs_povray_result *r, const char *to) {
  vs_store *store = e->scene->store;
  vs_exr x = { .store = store };
  vs_made_bytes exr = { NULL, 0, 0 };
  uint32_t columns = r->plan->columns, rows = r->plan->rows;
  bool ok = picture_take(e, r, &r->plan->wanted, &x) && vs_povray_say_view(e, &x, columns, rows) &&
            (!e->options->layers || vs_povray_layers(e, &x, columns, rows)) &&
            vs_exr_write(&x, &exr, e->error) && picture_write(e, to, &(picture_bytes){ exr.at, exr.size });
  if (exr.at) vs_store_realloc(store, exr.at, exr.room, 0);
  vs_exr_free(&x);
  return ok;
}

bool vs_povray_develop_picture(vs_emitter *e, const vs_povray_result *r, const char *to) {
  vs_store *store = e->scene->store;
  const vs_povray_plan *p = r->plan;
  const vs_exr_part *wanted = &p->wanted;
  vs_exr x = { .store = store };
  /* An exposure that is computed from the picture depends on the entire picture, so all parts are joined. */
  vs_exr_part all = { 0, 0, p->columns, p->rows };
  vs_tone tone = *r->tone;
  tone.dither = true, tone.left = wanted->left, tone.top = wanted->top;
  bool ok = picture_take(e, r, tone.fixed ? wanted : &all, &x);
  vs_light light = picture_light(&x);
  if (ok && !tone.fixed) {
    tone.fixed = true, tone.stops += vs_tone_exposure(&light, tone.curve);
    ok = vs_exr_crop(&x, wanted->left, wanted->top, wanted->columns, wanted->rows, e->error);
    light = picture_light(&x);
  }
  unsigned char *rgb = ok ? vs_store_realloc(store, NULL, 0, vs_light_pixels(&light) * 3) : NULL;
  vs_made_bytes png = { NULL, 0, 0 };
  if (ok && !rgb) ok = vs_emit_no_memory(e);
  if (ok) vs_tone_apply(&light, &tone, rgb);
  ok = ok && vs_png_write(store, &(vs_pixels){ rgb, x.columns, x.rows }, &png, e->error);
  if (rgb) vs_store_realloc(store, rgb, vs_light_pixels(&light) * 3, 0);
  vs_exr_free(&x);
  ok = ok && picture_write(e, to, &(picture_bytes){ png.at, png.size });
  if (png.at) vs_store_realloc(store, png.at, png.room, 0);
  return ok;
}
