/* Implements vs_sun_study: shows as pictures and as numbers where sunlight reaches a model during a day.
 *
 * For each time step, rays are traced from points on the model towards the sun's position at the middle of the step. A
 * point is lit if no solid blocks its ray. POV-Ray renders the pictures of shadows. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "backends/view.h"
#include "bind/call/precision.h"
#include "geometry/files/exr_read.h"
#include "geometry/files/png_write.h"
#include "geometry/measure/ray_tree.h"
#include "geometry/pictures/false_color.h"
#include "geometry/sun_position.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/light/pictures.h"
#include "session/report.h"
#include "session/session.h"
#include "session/spine.h"
#include "solids/drawn_bounds.h"
#include "solids/solid_meshes.h"

enum { TIMES = 500, PATH_ROOM = 4096 };

typedef struct { double from, hours; /* from: beginning of the time step in hours of local mean time; hours: length of
                                      * the time step */ double azimuth,
    altitude; vs_vec3 towards; } sun;

typedef struct {
  vs_session *session;
  vs_store *store;
  const vs_sun_span *span;
  const char *folder;
  sun suns[TIMES];
  size_t count;
  vs_solid solid;
  vs_ray_tree tree;
  vs_bounds bounds;
  double diagonal, ground;
  vs_error error;
} study;

/* ---- positions of the sun ---- */

static double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

static bool make_suns(study *t) {
  const vs_sun_span *d = t->span;
  bool place = fabs(d->latitude) <= 90 && fabs(d->longitude) <= 180, day = vs_sun_is_day(d->year, d->month, d->day);
  bool hours = d->from >= 0 && d->to <= 24 && d->from < d->to && d->step > 0 && (d->to - d->from) / d->step <= TIMES;
  if (!place)
    return vs_error_set(&t->error, VS_ERROR_FILE, NULL,
                        "the place must be a latitude from -90 to 90 and a longitude from -180 to 180");
  if (!day) return vs_error_set(&t->error, VS_ERROR_FILE, NULL, "there is no day %04d-%02d-%02d", d->year, d->month,
      d->day);
  if (!hours)
    return vs_error_set(&t->error, VS_ERROR_FILE, NULL, "the hours must increase, from 0 to 24, in at most %d steps",
                        TIMES);
  for (double at = d->from; at < d->to - 1e-9; at = d->from + (double)t->count * d->step) {
    sun *s = &t->suns[t->count++];
    s->from = at, s->hours = fmin(d->step, d->to - at);
    vs_sun_moment middle = { d->latitude, d->longitude, d->year, d->month, d->day,
                             at + s->hours / 2 - d->longitude / 15 };
    vs_sun_direction sun_at = vs_sun_position(&middle);
    s->azimuth = sun_at.azimuth, s->altitude = sun_at.altitude;
    double a = radians(s->azimuth), h = radians(s->altitude);
    s->towards = vs_v3(cos(h) * sin(a), cos(h) * cos(a), sin(h));
  }
  return true;
}

/* ---- hours of sun, by rays ---- */

static double hours_at(const study *t, vs_vec3 place, vs_vec3 normal) {
  vs_vec3 from = vs_v3_add(place, vs_v3_scale(normal, 1e-6 * t->diagonal));
  double sum = 0, at;
  for (size_t i = 0; i < t->count; i++) {
    const sun *s = &t->suns[i];
    if (s->altitude <= 0 || vs_v3_dot(s->towards, normal) <= 1e-9) continue;
    size_t hit = vs_ray_tree_meet(&t->tree, from, s->towards, INFINITY, true, &at);
    if (hit == t->solid.mesh.triangle_count) sum += s->hours;
  }
  return sum;
}

static void corners_of(const vs_mesh *m, size_t triangle, vs_vec3 p[3]) {
  for (int k = 0; k < 3; k++) p[k] = m->vertices[m->triangles[triangle][k]];
}

/* Returns a vector normal to the triangle, whose length is twice the triangle's area. */
static vs_vec3 turned_area(const vs_vec3 p[3]) { return vs_v3_cross(vs_v3_sub(p[1], p[0]), vs_v3_sub(p[2], p[0])); }

/* ---- false colours ---- */

typedef struct { float *hours; vs_vec3 *normal; double *depth; uint32_t wide, high; } view;

/* Finds the surface that is visible in a pixel: the model, the ground below it, or none. Stores the results in v. */
static void see(const study *t, const vs_look *look, const view *v, uint32_t column, uint32_t row) {
  size_t i = (size_t)row * v->wide + column;
  vs_look_line line = vs_look_ray(look, v->wide, v->high, column, row);
  vs_vec3 from = line.from, direction = line.direction, p[3];
  double at, below = INFINITY;
  if (direction.z < 0 && from.z > t->ground) below = (t->ground - from.z) / direction.z;
  size_t hit = vs_ray_tree_meet(&t->tree, from, direction, below, false, &at);
  v->hours[i] = NAN, v->depth[i] = INFINITY, v->normal[i] = vs_v3(0, 0, 0);
  if (!isfinite(at)) return;
  vs_vec3 normal = vs_v3(0, 0, 1);
  if (hit < t->solid.mesh.triangle_count) {
    corners_of(&t->solid.mesh, hit, p);
    normal = vs_v3_unit(turned_area(p));
    if (vs_v3_dot(normal, direction) > 0) normal = vs_v3_scale(normal, -1);
  }
  v->depth[i] = at, v->normal[i] = normal;
  v->hours[i] = (float)hours_at(t, vs_v3_add(from, vs_v3_scale(direction, at)), normal);
}

/* Returns true if an edge of the model lies between pixels a and b, which are neighbours. */
static bool edge_between(const view *v, size_t a, size_t b) {
  if (isfinite(v->depth[a]) != isfinite(v->depth[b])) return true;
  if (!isfinite(v->depth[a])) return false;
  if (vs_v3_dot(v->normal[a], v->normal[b]) < 0.9) return true;
  return fabs(v->depth[a] - v->depth[b]) > 0.05 * fmin(v->depth[a], v->depth[b]) && v->normal[a].z < 0.99;
}

static void draw_edges(const view *v, const vs_pixels *to) {
  for (uint32_t y = 0; y + 1 < v->high; y++)
    for (uint32_t x = 0; x + 1 < v->wide; x++) {
      size_t i = (size_t)y * v->wide + x;
      if (!edge_between(v, i, i + 1) && !edge_between(v, i, i + v->wide)) continue;
      for (size_t k = 0; k < 3; k++) {
        unsigned char *c = &to->rgb[3 * ((size_t)y * to->columns + x) + k];
        *c = (unsigned char)(*c * 2 / 5);
      }
    }
}

static bool path_in(study *t, const char *name, char path[PATH_ROOM]) {
  int n = snprintf(path, PATH_ROOM, "%s/%s", t->folder, name);
  return (n > 0 && n < PATH_ROOM) || vs_error_set(&t->error, VS_ERROR_FILE, NULL, "%.200s: the name is too long",
      t->folder);
}

/* The output files of a study, without the picture of shadows for each position of the sun. */
typedef enum { HOURS, HOURS_PLAN, HOURS_MODEL, SHADOWS, NAMES } study_file;
static const char *const names[NAMES] = { [HOURS] = "hours.csv", [HOURS_PLAN] = "hours-plan.png",
                                          [HOURS_MODEL] = "hours-model.png", [SHADOWS] = "shadows.png" };
enum { NAME_ROOM = 40 };
static void name_shadow(size_t number, char name[NAME_ROOM]) {
  snprintf(name, NAME_ROOM, "shadow-%03zu.png", number + 1);
}

/* Checks all output files before any is written. Returns false if the model has read one of them. */
static bool may_write_all(study *t) {
  char name[NAME_ROOM], path[PATH_ROOM];
  size_t days = 0;
  for (size_t i = 0; i < t->count; i++) days += t->suns[i].altitude > 0;
  for (size_t i = 0; i < NAMES + days; i++) {
    if (i >= NAMES) name_shadow(i - NAMES, name);
    if (!path_in(t, i < NAMES ? names[i] : name, path)) return false;
    if (vs_known_files_read(&t->session->inputs, path))
      return vs_error_set(&t->error, VS_ERROR_FILE, NULL, "%.300s: " VS_INPUT_KEPT, path);
  }
  return true;
}

static bool write_png(study *t, const char *name, const vs_pixels *picture) {
  char path[PATH_ROOM];
  vs_made_bytes png = { NULL, 0, 0 };
  bool ok = path_in(t, name, path) && vs_png_write(t->store, picture, &png, &t->error) &&
            vs_session_write_bytes(t->session, path, png.at, png.size, &t->error);
  if (png.at) vs_store_realloc(t->store, png.at, png.room, 0);
  return ok;
}

static bool write_hours(study *t, const vs_look *look, uint32_t wide, uint32_t high, const char *name) {
  size_t n = (size_t)wide * high, bytes = n * (sizeof(float) + sizeof(vs_vec3) + sizeof(double));
  char *room = vs_store_realloc(t->store, NULL, 0, bytes);
  if (!room) return vs_error_memory(&t->error, NULL);
  view v = { .wide = wide, .high = high };
  v.normal = (vs_vec3 *)(void *)room, v.depth = (double *)(void *)(room + n * sizeof(vs_vec3));
  v.hours = (float *)(void *)(room + n * (sizeof(vs_vec3) + sizeof(double)));
  bool ok = true;
  for (uint32_t y = 0; ok && y < high; y++) {
    for (uint32_t x = 0; x < wide; x++) see(t, look, &v, x, y);
    ok = vs_store_going(t->store, wide * (uint32_t)(t->count + 1) * 1000, &t->error);
  }
  double most = 0;
  for (size_t i = 0; i < t->count; i++) most += t->suns[i].altitude > 0 ? t->suns[i].hours : 0;
  vs_color_scale scale = { .most = most > 0 ? most : 1, .unit = "h" };
  vs_pixels p = { NULL, 0, 0 };
  ok = ok && vs_false_color_picture(t->store, &(vs_pixel_numbers){ v.hours, wide, high }, &scale, &p, &t->error);
  if (ok) draw_edges(&v, &p);
  ok = ok && write_png(t, name, &p);
  if (p.rgb) vs_store_realloc(t->store, p.rgb, (size_t)p.columns * p.rows * 3, 0);
  vs_store_realloc(t->store, room, bytes, 0);
  return ok;
}

/* Returns the camera that shows the model from above, with north at the top and room for the shadows around the
 * model. */
static vs_look plan_look(const study *t, uint32_t wide, uint32_t high) {
  vs_vec3 size = vs_v3_sub(t->bounds.max, t->bounds.min), middle = vs_v3_scale(vs_v3_add(t->bounds.min,
      t->bounds.max), 0.5);
  vs_look l = { .parallel = true, .right = vs_v3(1, 0, 0), .up = vs_v3(0, 1, 0), .forward = vs_v3(0, 0, -1) };
  l.eye = vs_v3(middle.x, middle.y, t->bounds.max.z + t->diagonal);
  l.width = 1.3 * fmax(size.x, size.y * wide / high);
  return l;
}

/* ---- hours of sun for each face ---- */

/* Sort key of a triangle: the plane and the part that contain it. After sorting, the triangles of a face are
 * neighbours. */
typedef struct { int64_t plane[4]; uint32_t part, triangle; } key;

static int by_face(const void *a, const void *b) {
  const key *x = a, *y = b;
  if (x->part != y->part) return x->part < y->part ? -1 : 1;
  for (int i = 0; i < 4; i++)
    if (x->plane[i] != y->plane[i]) return x->plane[i] < y->plane[i] ? -1 : 1;
  return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

/* Returns the mean hours of sunlight on the triangle p, sampled at the centres of smaller triangles. share: the
 * triangle's area divided by the area of all triangles; a larger share leads to more samples. */
static double hours_on(const study *t, const vs_vec3 p[3], vs_vec3 normal, double share) {
  int n = (int)fmin(fmax(ceil(sqrt(share * 4000)), 1), 12);
  double sum = 0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < 2 * (n - i) - 1; k++) {
      double a = (i + (k % 2 ? 2. / 3 : 1. / 3)) / n, b = (k / 2 + (k % 2 ? 2. / 3 : 1. / 3)) / n;
      vs_vec3 at = vs_v3_add(vs_v3_scale(p[0], 1 - a - b), vs_v3_add(vs_v3_scale(p[1], a), vs_v3_scale(p[2], b)));
      sum += hours_at(t, at, normal);
    }
  return sum / (n * n);
}

typedef struct { vs_vec3 normal, middle; double area, hours; uint32_t part; } face;

static bool put_face(const study *t, FILE *to, const face *f) {
  const vs_origin *o = t->solid.parts[f->part].leaf.origin;
  double azimuth = atan2(f->normal.x, f->normal.y) * (180 / 3.14159265358979323846);
  double tilt = acos(fmin(fmax(f->normal.z, -1), 1)) * (180 / 3.14159265358979323846);
  vs_vec3 m = vs_v3_scale(f->middle, 1 / f->area);
  fputc('"', to);
  for (const char *c = o ? o->file : ""; *c; c++) fputs(*c == '"' ? "\"\"" : (char[]){ *c, 0 }, to);
  if (o) fprintf(to, ":%u:%u", o->line, o->column);
  bool level = fabs(f->normal.z) > 1 - 1e-9; /* level: whether the face is horizontal and so has no compass direction */
  return fprintf(to,
      "\",%.1f,%.1f,%.6g,%.6g,%.6g,%.6g,%.3f\n", level ? 0 : azimuth < -1e-9 ? azimuth + 360 : fabs(azimuth),
                 tilt, m.x + 0.0, m.y + 0.0, m.z + 0.0, f->area, f->hours / f->area) > 0;
}

static bool put_faces(study *t, FILE *to, key *keys, size_t *faces) {
  const vs_mesh *m = &t->solid.mesh;
  double whole = vs_mesh_area(m);
  face f = { .area = 0 };
  bool ok = fputs("place,facing,tilt,x,y,z,area,hours\n", to) >= 0;
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    vs_vec3 p[3];
    corners_of(m, keys[i].triangle, p);
    vs_vec3 area = turned_area(p);
    double size = vs_v3_length(area) / 2;
    if (size > 0) {
      vs_vec3 normal = vs_v3_unit(area);
      f.normal = normal, f.part = keys[i].part, f.area += size;
      f.middle = vs_v3_add(f.middle, vs_v3_scale(vs_v3_add(p[0], vs_v3_add(p[1], p[2])), size / 3));
      f.hours += size * hours_on(t, p, normal, size / whole);
    }
    bool last = i + 1 == m->triangle_count || keys[i].part != keys[i + 1].part ||
                memcmp(keys[i].plane, keys[i + 1].plane, sizeof keys[i].plane) != 0;
    if (last && f.area > 0) ok = put_face(t, to, &f), ++*faces;
    if (last) f = (face){ .area = 0 };
    ok = ok && vs_store_going(t->store, (uint32_t)t->count * 2000, &t->error);
  }
  return ok;
}

/* Writes hours.csv, with one line for each face. */
static bool write_faces(study *t, size_t *faces) {
  const vs_mesh *m = &t->solid.mesh;
  size_t bytes = (m->triangle_count + 1) * sizeof(key);
  key *keys = vs_store_realloc(t->store, NULL, 0, bytes);
  char path[PATH_ROOM], *text = NULL;
  size_t length = 0;
  FILE *to = open_memstream(&text, &length);
  bool ok = keys && to;
  for (size_t i = 0; ok && i < m->triangle_count; i++) {
    vs_vec3 p[3];
    corners_of(m, i, p);
    vs_vec3 n = vs_v3_unit(turned_area(p));
    keys[i] = (key){ { llround(n.x * 1e4), llround(n.y * 1e4), llround(n.z * 1e4),
                       llround(vs_v3_dot(n, p[0]) / t->diagonal * 1e5) }, m->tags ? m->tags[i] : 0, (uint32_t)i };
  }
  if (!ok) vs_error_memory(&t->error, NULL);
  if (ok) qsort(keys, m->triangle_count, sizeof *keys, by_face);
  ok = ok && put_faces(t, to, keys, faces);
  if (to && fclose(to) != 0) ok = false;
  ok = ok && path_in(t, names[HOURS], path) &&
       vs_session_write_bytes(t->session, path, (unsigned char *)text, length, &t->error);
  free(text);
  if (keys) vs_store_realloc(t->store, keys, bytes, 0);
  return ok || (t->error.kind == VS_ERROR_NONE && vs_error_memory(&t->error, NULL));
}

/* ---- pictures of shadows ---- */

typedef struct { vs_store *store; unsigned char *at; size_t size, room; } memory;

static bool to_memory(void *context, const void *bytes, size_t count) {
  memory *m = context;
  if (!vs_store_grow(m->store, &m->at, &m->room, m->size + count, 1)) return false;
  memcpy(m->at + m->size, bytes, count);
  m->size += count;
  return true;
}

typedef struct { vs_pixels picture; uint32_t columns, cell_wide, cell_high; size_t bytes; } sheet;
enum { GAP = 6, CAPTION = 14 };

static bool begin_sheet(study *t, sheet *s, size_t pictures) {
  s->columns = (uint32_t)ceil(sqrt((double)pictures));
  uint32_t rows = (uint32_t)((pictures + s->columns - 1) / s->columns);
  s->picture.columns = s->columns * (s->cell_wide + GAP) + GAP;
  s->picture.rows = rows * (s->cell_high + GAP + CAPTION) + GAP;
  s->bytes = (size_t)s->picture.columns * s->picture.rows * 3;
  s->picture.rgb = vs_store_realloc(t->store, NULL, 0, s->bytes);
  if (!s->picture.rgb) return vs_error_memory(&t->error, NULL);
  memset(s->picture.rgb, 244, s->bytes);
  return true;
}

static void put_picture(const sheet *s, size_t number, const unsigned char *rgb, const char *caption) {
  uint32_t x = GAP + (uint32_t)(number % s->columns) * (s->cell_wide + GAP);
  uint32_t y = GAP + (uint32_t)(number / s->columns) * (s->cell_high + GAP + CAPTION);
  for (uint32_t row = 0; row < s->cell_high; row++)
    memcpy(s->picture.rgb + 3 * ((size_t)(y + row) * s->picture.columns + x), rgb + 3 * (size_t)row * s->cell_wide,
        3 * (size_t)s->cell_wide);
  vs_picture_text(&s->picture, x, y + s->cell_high + 4, caption);
}

/* Renders the model with one position of the sun, applies the tone curve, and writes shadow-NNN.png. Also copies the
 * picture to the contact sheet. */
static vs_outcome shade(study *t, const vs_output_options *o, const sun *s, size_t number, vs_tone *tone,
    const sheet *to) {
  static const char *const wanted[] = { "R", "G", "B", NULL };
  vs_output_options how = *o;
  memory m = { .store = t->store };
  vs_exr x = { .store = t->store };
  char name[NAME_ROOM], caption[40];
  how.has_sun = true, how.sun[0] = s->azimuth, how.sun[1] = s->altitude;
  vs_outcome outcome = vs_session_write(t->session, NULL, vs_export_format_find("exr"), &how,
      &(vs_byte_sink){ to_memory, &m });
  bool ok = outcome == VS_OUTCOME_DONE && 
            vs_exr_read(t->store, &(vs_file_bytes){ "picture", m.at, m.size }, wanted, &x, &t->error);
  vs_light light = { vs_exr_find(&x, "R"), vs_exr_find(&x, "G"), vs_exr_find(&x, "B"), x.columns, x.rows };
  unsigned char *rgb = ok && light.red ? vs_store_realloc(t->store, NULL, 0, vs_light_pixels(&light) * 3) : NULL;
  if (ok && !rgb) ok = vs_error_memory(&t->error, NULL);
  if (ok) {
    double stops = vs_tone_apply(&light, tone, rgb), at = s->from + s->hours / 2;
    if (!tone->fixed) *tone = (vs_tone){ .curve = tone->curve, .fixed = true, .stops = stops };
    int minutes = (int)lround(at * 60);
    snprintf(caption, sizeof caption, "%02d:%02d", minutes / 60, minutes % 60);
    name_shadow(number, name);
    put_picture(to, number, rgb, caption);
    ok = write_png(t, name, &(vs_pixels){ rgb, x.columns, x.rows });
  }
  if (rgb) vs_store_realloc(t->store, rgb, vs_light_pixels(&light) * 3, 0);
  vs_exr_free(&x);
  if (m.at) vs_store_realloc(t->store, m.at, m.room, 0);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  return ok ? VS_OUTCOME_DONE : vs_session_report_error(t->session, &t->error);
}

static vs_outcome shade_all(study *t, const vs_output_options *options, size_t *pictures) {
  vs_output_options o = *options;
  if (o.quality != VS_QUALITY_FINAL) o.quality = VS_QUALITY_DRAFT;
  if (!o.width) o.width = 320;
  memset(o.crop, 0, sizeof o.crop); /* the pictures for the contact sheet are not cropped */
  if (!o.height) o.height = (o.width * 3 + 2) / 4;
  sheet s = { .cell_wide = (uint32_t)o.width, .cell_high = (uint32_t)o.height };
  vs_tone tone = vs_session_tone(&o.development);
  size_t days = 0;
  for (size_t i = 0; i < t->count; i++) days += t->suns[i].altitude > 0;
  if (!days) return VS_OUTCOME_DONE;
  if (!begin_sheet(t, &s, days)) return vs_session_report_error(t->session, &t->error);
  /* Begins with the highest position of the sun. The exposure of its picture is used for all pictures, so that they can
   * be compared. */
  size_t number[TIMES], high = 0, n = 0;
  for (size_t i = 0; i < t->count; i++) {
    number[i] = n;
    n += t->suns[i].altitude > 0;
    if (t->suns[i].altitude > t->suns[high].altitude) high = i;
  }
  vs_outcome outcome = shade(t, &o, &t->suns[high], number[high], &tone, &s);
  *pictures += outcome == VS_OUTCOME_DONE;
  for (size_t i = 0; outcome == VS_OUTCOME_DONE && i < t->count; i++)
    if (i != high && t->suns[i].altitude > 0) {
      outcome = shade(t, &o, &t->suns[i], number[i], &tone, &s);
      *pictures += outcome == VS_OUTCOME_DONE;
    }
  if (outcome == VS_OUTCOME_DONE && !write_png(t, names[SHADOWS], &s.picture))
    outcome = vs_session_report_error(t->session, &t->error);
  vs_store_realloc(t->store, s.picture.rgb, s.bytes, 0);
  return outcome;
}

/* ---- running a study ---- */

/* Computes the mesh of the drawn objects, and a tree of the mesh's triangles for ray tracing. */
static bool take_model(study *t, const vs_ref *refs, size_t count) {
  const vs_scene *scene = &t->session->bind.scene;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(t->session->bind.vm), .segments = scene->segments };
  vs_kernel_options options = { .job = &t->session->job };
  vs_bounds all;
  size_t budget = VS_DRAWN_BOUNDS_MOST;
  vs_drawn_search search = { .facets = &facets, .options = &options, .budget = &budget };
  if (!vs_drawn_bounds_all(refs, count, &search, &all, &t->error)) return false;
  if (facets.tolerance <= 0) facets.tolerance = vs_fineness_tolerance(&all);
  if (!vs_solid_evaluate(refs, count, &facets, &options, &t->solid, &t->error)) return false;
  if (!t->solid.mesh.triangle_count)
    return vs_error_set(&t->error, VS_ERROR_MODEL, NULL, "the model has no solids for the sun to shine on");
  t->bounds = vs_mesh_bounds(&t->solid.mesh);
  t->diagonal = vs_v3_length(vs_v3_sub(t->bounds.max, t->bounds.min));
  t->ground = scene->has_ground ? scene->ground_z : t->bounds.min.z;
  return vs_ray_tree_make(&t->tree, t->store, &t->solid.mesh, &t->error);
}

static bool count_hours(study *t, const vs_output_options *o, size_t *faces) {
  uint32_t wide = o->width > 0 ? (uint32_t)o->width : 320, high = o->height > 0 ? (uint32_t)o->height
      : (wide * 3 + 2) / 4;
  vs_scene scene = t->session->bind.scene;
  const vs_scene_view *named = o->view ? vs_scene_find_view(&scene, o->view) : NULL;
  if (o->view && !named)
    return vs_error_set(&t->error, VS_ERROR_FILE, NULL, "the model has no view \"%.100s\"", o->view);
  if (!named) named = vs_scene_own_view(&scene);
  if (named) vs_scene_look(&scene, named);
  vs_session_aim(o, &scene);
  vs_look plan = plan_look(t, wide, high), look = vs_look_find(&scene, &t->bounds, &t->bounds, 1, (double)wide / high);
  return write_faces(t, faces) && write_hours(t, &plan, wide, high, names[HOURS_PLAN]) &&
         write_hours(t, &look, wide, high, names[HOURS_MODEL]);
}

vs_outcome vs_sun_study(vs_scheme *vm, const vs_sun_span *span, const char *folder, const vs_output_options *options,
                        vs_sun_summary *out) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_sun_study")) return VS_OUTCOME_USAGE;
  vs_output_options own = vs_output_options_default();
  const vs_output_options *o = &own;
  vs_session_take_options(&own, sizeof own, VS_FIRST_OUTPUT_OPTIONS, options);
  vs_ref *refs = NULL;
  size_t count = 0;
  *out = (vs_sun_summary){ 0 };
  study *t = vs_store_realloc(s->bind.store, NULL, 0, sizeof *t);
  if (!t) return vs_session_out_of_memory(s);
  *t = (study){ .session = s, .store = s->bind.store, .span = span, .folder = folder };
  bool ok = make_suns(t);
  for (size_t i = 0; ok && i < t->count; i++) out->dark += t->suns[i].altitude <= 0;
  struct stat info;
  if (ok && mkdir(folder, 0777) != 0 && (errno != EEXIST || stat(folder, &info) != 0 || !S_ISDIR(info.st_mode)))
    ok = vs_error_set(&t->error, VS_ERROR_FILE, NULL, "cannot make the folder %.200s: %s", folder,
                      strerror(errno == EEXIST ? ENOTDIR : errno));
  vs_outcome outcome = ok ? vs_session_take(s, &refs, &count) : vs_session_report_error(s, &t->error);
  if (outcome == VS_OUTCOME_DONE &&
      (!may_write_all(t) || !take_model(t, refs, count) || !count_hours(t, o, &out->faces)))
    outcome = vs_session_report_error(s, &t->error);
  vs_ray_tree_free(&t->tree);
  vs_solid_free(&t->solid);
  for (size_t i = 0; i < count; i++) vs_node_release(refs[i].node);
  if (refs) vs_store_realloc(s->bind.store, refs, (count + 1) * sizeof *refs, 0);
  if (outcome == VS_OUTCOME_DONE) outcome = shade_all(t, o, &out->pictures);
  vs_store_realloc(s->bind.store, t, sizeof *t, 0);
  return outcome;
}
