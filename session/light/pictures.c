/* Implements the public functions on EXR pictures. Each reads a file, calls geometry/pictures/, and writes a file that
 * appears only when it is complete. */
#include "session/light/pictures.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "backends/povray/povray_plan.h"
#include "backends/publish.h"
#include "geometry/files/exr_read.h"
#include "geometry/files/png_read.h"
#include "geometry/files/png_write.h"
#include "geometry/pictures/denoise.h"
#include "geometry/pictures/false_color.h"
#include "geometry/pictures/illuminance.h"
#include "geometry/pictures/picture_difference.h"
#include "session/handles.h"
#include "session/report.h"
#include "session/session.h"

vs_tone vs_session_tone(const vs_development *d) {
  static const vs_tone_curve curves[] = {
      [VS_CURVE_NEUTRAL] = VS_TONE_NEUTRAL, [VS_CURVE_AGX] = VS_TONE_AGX, [VS_CURVE_FILMIC] = VS_TONE_FILMIC,
      [VS_CURVE_LINEAR] = VS_TONE_LINEAR };
  return (vs_tone){ .curve = curves[d->curve], .fixed = d->fixed, .stops = d->exposure, .dither = true };
}

/* ---- reading and writing files ---- */

static bool no_file(vs_error *e, const char *doing, const char *path) {
  if (errno == ENOMEM) return vs_error_memory(e, NULL);
  return vs_error_set(e, VS_ERROR_FILE, NULL, "cannot %s %s: %s", doing, path, strerror(errno));
}

static bool read_bytes(vs_session *s, const char *path, vs_made_bytes *out, vs_error *e) {
  vs_store *store = s->bind.store;
  struct stat info;
  int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return no_file(e, "read", path);
  bool ok = fstat(file, &info) == 0;
  if (ok && !S_ISREG(info.st_mode)) ok = false, errno = S_ISDIR(info.st_mode) ? EISDIR : EINVAL;
  if (!ok) no_file(e, "read", path);
  if (ok && !vs_known_files_add(&s->inputs, path, file, false)) ok = vs_error_memory(e, NULL);
  if (ok) {
    out->room = (size_t)info.st_size + 1;
    out->at = vs_store_realloc(store, NULL, 0, out->room);
    if (!out->at) ok = vs_error_memory(e, NULL);
  }
  while (ok && out->size < out->room) {
    ssize_t got = read(file, out->at + out->size, out->room - out->size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) ok = no_file(e, "read", path);
    if (got <= 0) break;
    out->size += (size_t)got;
  }
  close(file);
  return ok;
}

bool vs_session_write_bytes(const vs_session *s, const char *path, const unsigned char *at, size_t size, vs_error *e) {
  vs_publish p;
  if (vs_known_files_read(&s->inputs, path))
    return vs_error_set(e, VS_ERROR_FILE, NULL, "%.300s: " VS_INPUT_KEPT, path);
  if (!vs_publish_begin(&p, path, false)) return no_file(e, "write", path);
  bool ok = true;
  for (size_t sent = 0; ok && sent < size;) {
    ssize_t part = write(p.file, at + sent, size - sent);
    if (part < 0 && errno == EINTR) continue;
    ok = part > 0;
    if (ok) sent += (size_t)part;
  }
  int problem = ok ? 0 : errno;
  bool ended = vs_publish_end(&p, ok);
  if (!ok) errno = problem;
  return (ok && ended) || no_file(e, "write", path);
}

static const char *bare(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* Reads the channels of an EXR file whose names are in `wanted`, or all channels if `wanted` is NULL. */
static bool take(vs_session *s, const char *path, const char *const *wanted, vs_exr *out, vs_error *e) {
  vs_store *store = s->bind.store;
  vs_made_bytes b = { 0 };
  *out = (vs_exr){ .store = store };
  bool ok = read_bytes(s, path, &b, e) &&
      vs_exr_read(store, &(vs_file_bytes){ bare(path), b.at, b.size }, wanted, out, e);
  if (b.at) vs_store_realloc(store, b.at, b.room, 0);
  return ok;
}

static const char *const colors[] = { "R", "G", "B", "Y", NULL };

/* Sets *out to the red, green and blue light of the picture. If the picture has only luminance, uses the luminance for
 * each of the three colours. */
static bool light_of(const vs_exr *x, const char *path, vs_light *out, vs_error *e) {
  const float *y = vs_exr_find(x, "Y");
  *out = (vs_light){ vs_exr_find(x, "R"), vs_exr_find(x, "G"), vs_exr_find(x, "B"), x->columns, x->rows };
  if (out->red && out->green && out->blue) return true;
  if (!y) return vs_error_set(e, VS_ERROR_MODEL, NULL, "%.100s: the EXR picture has neither R, G and B nor Y",
      bare(path));
  out->red = out->green = out->blue = y;
  return true;
}

static bool write_png(vs_session *s, const char *path, const vs_pixels *picture, vs_error *e) {
  vs_store *store = s->bind.store;
  vs_made_bytes png = { 0 };
  bool ok = vs_png_write(store, picture, &png, e) &&
            vs_session_write_bytes(s, path, png.at, png.size, e);
  if (png.at) vs_store_realloc(store, png.at, png.room, 0);
  return ok;
}

/* Writes an array with a number for each pixel as a PNG picture in false colours. */
static bool write_false(vs_session *s, const char *path, const float *at, const vs_exr *x, const vs_color_scale *scale,
                        vs_error *e) {
  vs_store *store = s->bind.store;
  vs_pixels p;
  bool ok = vs_false_color_picture(store, &(vs_pixel_numbers){ at, x->columns, x->rows }, scale, &p, e) &&
            write_png(s, path, &p, e);
  if (p.rgb) vs_store_realloc(store, p.rgb, (size_t)p.columns * p.rows * 3, 0);
  return ok;
}

static vs_outcome end(vs_session *s, bool ok, const vs_error *e) {
  return ok ? VS_OUTCOME_DONE : vs_session_report_error(s, e);
}

/* ---- the public functions ---- */

vs_outcome vs_picture_tone(vs_scheme *vm, const char *from, const char *to, const vs_development *how, double *stops) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_tone")) return VS_OUTCOME_USAGE;
  vs_store *store = s->bind.store;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  vs_light light;
  vs_tone tone = vs_session_tone(how ? how : &(vs_development){ 0 });
  unsigned char *rgb = NULL;
  bool ok = take(s, from, colors, &x, &e) && light_of(&x, from, &light, &e);
  if (ok && !(rgb = vs_store_realloc(store, NULL, 0, vs_light_pixels(&light) * 3))) ok = vs_error_memory(&e, NULL);
  if (ok) {
    double used = vs_tone_apply(&light, &tone, rgb);
    if (stops) *stops = used;
    ok = write_png(s, to, &(vs_pixels){ rgb, x.columns, x.rows }, &e);
  }
  if (rgb) vs_store_realloc(store, rgb, vs_light_pixels(&light) * 3, 0);
  vs_exr_free(&x);
  return end(s, ok, &e);
}

/* Numbers that a picture in false colours shows. at: one number for each pixel. unit: the unit of the numbers. least,
 * most: receive the ends of the colour scale, or are NULL. */
typedef struct { const float *at; const char *unit; double *least, *most; } quantity;

/* Writes the numbers q->at as a picture in false colours on a logarithmic scale, with a legend. Sets *q->least and
 * *q->most to the ends of the scale. */
static bool write_scaled(vs_session *s, vs_exr *x, const char *to, const quantity *q, vs_error *e) {
  vs_color_scale scale = vs_color_scale_of(q->at, (size_t)x->columns * x->rows, true, q->unit);
  if (q->least) *q->least = scale.least;
  if (q->most) *q->most = scale.most;
  return write_false(s, to, q->at, x, &scale, e);
}

vs_outcome vs_picture_false_color(vs_scheme *vm, const char *from, const char *to, double unit, double *least,
                                  double *most) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_false_color")) return VS_OUTCOME_USAGE;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  vs_light light;
  float *at = NULL;
  bool ok = take(s, from, colors, &x, &e) && light_of(&x, from, &light, &e);
  ok = ok && (at = vs_exr_add(&x, "luminance", VS_EXR_FLOAT, &e)) != NULL;
  for (size_t i = 0; ok && i < vs_light_pixels(&light); i++)
    at[i] = (float)(unit * (vs_raster_share[0] * (double)light.red[i] + vs_raster_share[1] * (double)light.green[i] +
                            vs_raster_share[2] * (double)light.blue[i]));
  ok = ok && write_scaled(s, &x, to, &(quantity){ at, "cd/m2", least, most }, &e);
  vs_exr_free(&x);
  return end(s, ok, &e);
}

vs_outcome vs_picture_illuminance(vs_scheme *vm, const char *from, const char *to, double unit, double *least,
                                  double *most) {
  static const char *const wanted[] = { "R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "N.Z", NULL };
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_illuminance")) return VS_OUTCOME_USAGE;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  float *at = NULL;
  bool ok = take(s, from, wanted, &x, &e);
  vs_lit_surfaces lit = vs_lit_surfaces_of(&x);
  if (ok && !vs_lit_surfaces_are_known(&lit))
    ok = vs_error_set(&e, VS_ERROR_MODEL, NULL,
                      "%.100s: illuminance needs the layers albedo and normal; make the picture with --layers",
                      bare(from));
  ok = ok && (at = vs_exr_add(&x, "illuminance", VS_EXR_FLOAT, &e)) != NULL;
  size_t floors = 0;
  for (size_t i = 0; ok && i < (size_t)x.columns * x.rows; i++) {
    at[i] = vs_is_floor(&lit, i) ? (float)(unit * vs_illuminance_at(&lit, i)) : NAN;
    floors += isfinite(at[i]) != 0;
  }
  if (ok && !floors)
    ok = vs_error_set(&e, VS_ERROR_MODEL, NULL, "%.100s shows no floor: no surface in it faces up", bare(from));
  ok = ok && write_scaled(s, &x, to, &(quantity){ at, "lx", least, most }, &e);
  vs_exr_free(&x);
  return end(s, ok, &e);
}

/* Copies line n of the text, counted from 1, to `to`. Cuts the line if it is longer than `room` allows. */
static bool line_of(const char *text, size_t n, char *to, size_t room) {
  for (; text && n > 1; n--) {
    text = strchr(text, '\n');
    if (text) text++;
  }
  size_t length = text ? strcspn(text, "\n") : 0;
  if (length >= room) length = room - 1;
  memcpy(to, text ? text : "", length);
  to[length] = 0;
  return length > 0;
}

vs_outcome vs_picture_pick(vs_scheme *vm, const char *from, long column, long row, vs_picture_point *out) {
  static const char *const wanted[] = { "R", "G", "B", "Y", "Z", "N.X", "N.Y", "N.Z", "id", "material", "AO",
                                         "albedo.R", "albedo.G", "albedo.B", NULL };
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_pick")) return VS_OUTCOME_USAGE;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  vs_light light;
  *out = (vs_picture_point){ .id = -1, .depth = NAN, .openness = NAN, .illuminance = NAN };
  bool ok = take(s, from, wanted, &x, &e) && light_of(&x, from, &light, &e);
  if (ok && (column < 0 || row < 0 || column >= (long)x.columns || row >= (long)x.rows))
    ok = vs_error_set(&e, VS_ERROR_FILE, NULL, "%.100s has no pixel %ld %ld: its columns are 0 to %u, its rows 0 to %u",
                      bare(from), column, row, x.columns - 1, x.rows - 1);
  if (ok) {
    size_t i = (size_t)row * x.columns + (size_t)column;
    const float *depth = vs_exr_find(&x, "Z"), *id = vs_exr_find(&x, "id");
    const float *material = vs_exr_find(&x, "material"), *openness = vs_exr_find(&x, "AO");
    const float *normal[3] = { vs_exr_find(&x, "N.X"), vs_exr_find(&x, "N.Y"), vs_exr_find(&x, "N.Z") };
    out->color[0] = (double)light.red[i], out->color[1] = (double)light.green[i], out->color[2] = (double)light.blue[i];
    if (depth) out->depth = (double)depth[i];
    out->has_normal = normal[0] && normal[1] && normal[2];
    for (int k = 0; out->has_normal && k < 3; k++) out->normal[k] = (double)normal[k][i];
    vs_lit_surfaces lit = vs_lit_surfaces_of(&x);
    if (vs_lit_surfaces_are_known(&lit)) out->illuminance = vs_illuminance_at(&lit, i);
    if (openness) out->openness = (double)openness[i];
    if (material && material[i] > 0 && material[i] < 1e9f)
      line_of(x.texts[VS_EXR_MATERIALS].at, (size_t)material[i], out->material, sizeof out->material);
    if (id) out->id = id[i] > 0 && id[i] < 1e9f ? (long)id[i] : 0;
    if (out->id > 0) line_of(x.texts[VS_EXR_SOURCES].at, (size_t)out->id, out->place, sizeof out->place);
  }
  vs_exr_free(&x);
  return end(s, ok, &e);
}

vs_outcome vs_picture_compare(vs_scheme *vm, const char *a, const char *b, const char *to, vs_picture_difference *out) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_compare")) return VS_OUTCOME_USAGE;
  vs_store *store = s->bind.store;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x, y = { .store = store };
  vs_light one, two;
  vs_picture_gap gap = { 0 };
  float *each = NULL;
  bool ok = take(s, a, colors, &x, &e) && light_of(&x, a, &one, &e) && take(s, b, colors, &y, &e) &&
            light_of(&y, b, &two, &e);
  if (ok && (x.columns != y.columns || x.rows != y.rows))
    ok = vs_error_set(&e, VS_ERROR_MODEL, NULL, "%.100s has %u x %u pixels, %.100s %u x %u", bare(a), x.columns, x.rows,
                      bare(b), y.columns, y.rows);
  if (ok && to) ok = (each = vs_exr_add(&x, "difference", VS_EXR_FLOAT, &e)) != NULL;
  ok = ok && vs_picture_measure_gap(store, &one, &two, each, &gap, &e);
  if (ok) {
    *out = (vs_picture_difference){ .columns = x.columns, .rows = x.rows, .most = gap.most, .mean = gap.mean,
        .root_mean_square = gap.root, .psnr = gap.peak_ratio, .ssim = gap.similarity,
        .column = (long)(gap.worst % x.columns), .row = (long)(gap.worst / x.columns) };
    vs_color_scale scale = { .most = gap.most > 0 ? gap.most : 1, .unit = "" };
    ok = !to || write_false(s, to, each, &x, &scale, &e);
  }
  vs_exr_free(&x);
  vs_exr_free(&y);
  return end(s, ok, &e);
}

vs_outcome vs_picture_denoise(vs_scheme *vm, const char *from, const char *to, bool *layers) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_denoise")) return VS_OUTCOME_USAGE;
  vs_store *store = s->bind.store;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  vs_made_bytes exr = { 0 };
  bool guided = false;
  bool ok = take(s, from, NULL, &x, &e) && vs_exr_smooth(&x, &guided, &e) &&
            vs_exr_write(&x, &exr, &e) && vs_session_write_bytes(s, to, exr.at, exr.size, &e);
  if (layers) *layers = guided;
  if (exr.at) vs_store_realloc(store, exr.at, exr.room, 0);
  vs_exr_free(&x);
  return end(s, ok, &e);
}

/* ---- joining tiles ---- */

/* A picture that is joined from tiles. */
typedef struct {
  vs_session *session;
  const char *const *tiles;
  size_t columns, rows; /* numbers of columns and rows of tiles */
  bool light;           /* whether the tiles are EXR pictures, otherwise PNG */
  vs_exr x;             /* the joined picture, if the tiles are EXR pictures */
  vs_pixels p;          /* the joined picture, if the tiles are PNG pictures; its width and height are set for EXR
                         * tiles, too */
  uint32_t left, top;   /* position of the current tile's upper left corner in the joined picture, in pixels */
} joint;

/* A tile that was read: x for an EXR picture, p for a PNG picture. */
typedef struct { const char *path; vs_exr x; vs_png_pixels p; uint32_t columns, rows; } tile;

static bool unfit(const tile *t, vs_error *e) {
  return vs_error_set(e, VS_ERROR_FILE, NULL, "%.200s: this picture does not fit the other tiles", bare(t->path));
}

static void free_tile(joint *j, tile *t) {
  vs_exr_free(&t->x);
  if (t->p.rows) vs_store_realloc(j->session->bind.store, t->p.rows, t->p.room, 0);
}

/* Reads tile i. The caller frees the tile with free_tile, even after a failure. */
static bool take_tile(joint *j, size_t i, tile *t, vs_error *e) {
  vs_store *store = j->session->bind.store;
  vs_made_bytes b = { 0 };
  *t = (tile){ .path = j->tiles[i], .x = { .store = store } };
  bool ok = j->light ? take(j->session, t->path, NULL, &t->x, e)
                     : read_bytes(j->session, t->path, &b, e) &&
                           vs_png_read(store, &(vs_file_bytes){ bare(t->path), b.at, b.size }, &t->p, e);
  if (b.at) vs_store_realloc(store, b.at, b.room, 0);
  if (ok && !j->light && (t->p.deep || t->p.channels != 3)) ok = unfit(t, e);
  t->columns = j->light ? t->x.columns : t->p.columns, t->rows = j->light ? t->x.rows : t->p.high;
  return ok;
}

/* Computes the size of the joined picture from the tiles of the first row and of the first column. */
static bool measure_tiles(joint *j, vs_error *e) {
  uint64_t columns = 0, rows = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < j->columns * j->rows; i++) {
    tile t;
    if (i >= j->columns && i % j->columns != 0) continue;
    ok = take_tile(j, i, &t, e);
    if (i < j->columns) columns += t.columns;
    if (i % j->columns == 0) rows += t.rows;
    if (ok && (columns > INT32_MAX || rows > INT32_MAX)) ok = unfit(&t, e);
    free_tile(j, &t);
  }
  j->p.columns = (uint32_t)columns, j->p.rows = (uint32_t)rows;
  return ok;
}

/* Allocates the joined picture, with the channels and texts of its first tile. */
static bool begin_whole(joint *j, const tile *first, vs_error *e) {
  vs_exr *x = &j->x;
  size_t bytes = 3 * (size_t)j->p.columns * j->p.rows;
  if (!j->light) {
    j->p.rgb = vs_store_realloc(j->session->bind.store, NULL, 0, bytes);
    return j->p.rgb || vs_error_memory(e, NULL);
  }
  x->columns = j->p.columns, x->rows = j->p.rows;
  bool ok = true;
  for (size_t i = 0; ok && i < first->x.count; i++)
    ok = vs_exr_add(x, first->x.channels[i].name, first->x.channels[i].type, e) != NULL;
  for (vs_exr_text k = 0; ok && k < VS_EXR_TEXTS; k++)
    if (first->x.texts[k].at) ok = vs_exr_add_text(x, k, first->x.texts[k].at, strlen(first->x.texts[k].at), e);
  return ok;
}

/* Copies `rows` rows of `bytes` bytes each into a picture whose rows begin `stride` bytes apart. */
static void put_rows(void *to, size_t stride, const void *from, size_t bytes, uint32_t rows) {
  for (uint32_t row = 0; row < rows; row++)
    memcpy((char *)to + row * stride, (const char *)from + row * bytes, bytes);
}

/* Copies the tile to its position in the joined picture. */
static bool put_tile(joint *j, const tile *t, vs_error *e) {
  size_t at = (size_t)j->top * j->p.columns + j->left;
  if (t->columns > j->p.columns - j->left || t->rows > j->p.rows - j->top || t->x.count != j->x.count)
    return unfit(t, e);
  if (!j->light) put_rows(j->p.rgb + 3 * at, 3 * (size_t)j->p.columns, t->p.rows, 3 * (size_t)t->columns, t->rows);
  for (size_t i = 0; i < t->x.count; i++) {
    float *to = vs_exr_find(&j->x, t->x.channels[i].name);
    if (!to) return unfit(t, e);
    put_rows(to + at, j->p.columns * sizeof *to, t->x.channels[i].at, t->columns * sizeof *to, t->rows);
  }
  return true;
}

/* Copies all tiles into the joined picture, row by row. */
static bool put_tiles(joint *j, vs_error *e) {
  uint32_t high = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < j->columns * j->rows; i++) {
    tile t;
    ok = take_tile(j, i, &t, e);
    if (ok && i == 0) ok = begin_whole(j, &t, e);
    if (i % j->columns == 0) j->top += high, j->left = 0, high = t.rows;
    if (ok && t.rows != high) ok = unfit(&t, e);
    ok = ok && put_tile(j, &t, e);
    j->left += t.columns;
    free_tile(j, &t);
  }
  return ok;
}

static bool is_light(const char *path) {
  const char *dot = strrchr(path, '.');
  return dot && !strcmp(dot, ".exr");
}

int vs_picture_tile_top(int width, int height, int tiles, int number) {
  if (width < 1 || height < 1 || tiles < 1 || tiles > height || number < 0 || number > tiles) return 0;
  return (int)vs_povray_tile_top((uint32_t)width, (uint32_t)height, (uint32_t)tiles, (uint32_t)number);
}

vs_outcome vs_picture_join(vs_scheme *vm, const char *const *tiles, size_t columns, size_t rows, const char *to) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_picture_join")) return VS_OUTCOME_USAGE;
  vs_store *store = s->bind.store;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_made_bytes exr = { 0 };
  joint j = { .session = s, .tiles = tiles, .columns = columns, .rows = rows, .light = is_light(to),
              .x = { .store = store } };
  bool ok = measure_tiles(&j, &e) && put_tiles(&j, &e);
  if (ok && !j.light) ok = write_png(s, to, &j.p, &e);
  else if (ok) ok = vs_exr_write(&j.x, &exr, &e) && vs_session_write_bytes(s, to, exr.at, exr.size, &e);
  if (exr.at) vs_store_realloc(store, exr.at, exr.room, 0);
  if (j.p.rgb) vs_store_realloc(store, j.p.rgb, 3 * (size_t)j.p.columns * j.p.rows, 0);
  vs_exr_free(&j.x);
  return end(s, ok, &e);
}
