/* Computes the layers of a picture with a ray for every pixel, because POV-Ray has no output of depth, normals or
 * names. The rays intersect the kernel's mesh of the drawing, through the camera of the picture. */
#include "backends/povray/povray_layers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/povray/povray.h"
#include "backends/view.h"
#include "backends/writer.h"
#include "geometry/measure/bounds.h"
#include "geometry/measure/openness.h"
#include "kernel/memory.h"
#include "kernel/threads.h"

enum { DEPTH, NX, NY, NZ, RED, GREEN, BLUE, ID, MATERIAL, OPEN, LAYERS };

typedef struct {
  vs_emitter *e;
  vs_look look;
  vs_solid solid;
  vs_ray_tree tree;
  uint32_t *id, *material; /* id[p], material[p]: numbers of the origin and the material of part p; 0: the part has
                            * none */
  uint32_t ground_material;
  vs_surrounding round; /* objects around a point that shade it, for ambient occlusion; round.ground: height of the
                         * ground, or -INFINITY if there is none */
  double hair;          /* distance from a surface at which a ray begins, so that it does not intersect the facet from
                         * which it starts */
  vs_exr *x;
  float *at[LAYERS];
  uint32_t columns, rows; /* size of the whole picture in pixels */
} layers;

/* Converts sRGB to linear light, IEC 61966-2-1. */
static float linear(double s) { return (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4)); }

static void put(const layers *l, size_t i, vs_vec3 n, const double paint[3],
                double diffuse) {
  l->at[NX][i] = (float)n.x, l->at[NY][i] = (float)n.y, l->at[NZ][i] = (float)n.z;
  for (int k = 0; k < 3; k++) l->at[RED + k][i] = linear(paint[k]) * (float)diffuse;
}

static void look_at(const layers *l, uint32_t column, uint32_t row) {
  /* bare: colour of parts without a material; earth: colour of the ground; as in povray_scene.c */
  static const double bare[3] = { 0.86, 0.85, 0.83 }, earth[3] = { 0.77, 0.76, 0.73 };
  const double earth_diffuse = 0.8;
  const vs_scene *scene = l->e->scene;
  const vs_mesh *m = &l->solid.mesh;
  size_t i = (size_t)row * l->x->columns + column;
  double below = INFINITY, at;
  const int *crop = l->e->options->crop;
  vs_look_line line =
      vs_look_ray(&l->look, l->columns, l->rows, column + (uint32_t)crop[0], row + (uint32_t)crop[1]);
  vs_vec3 from = line.from, direction = line.direction;
  if (scene->has_ground && direction.z != 0) below = (scene->ground_z - from.z) / direction.z;
  if (!(below > 0)) below = INFINITY;
  size_t hit = vs_ray_tree_meet(&l->tree, from, direction, below, false, &at);
  if (!isfinite(at)) {
    l->at[DEPTH][i] = INFINITY, l->at[OPEN][i] = 1;
    return;
  }
  l->at[DEPTH][i] = (float)(l->look.panorama ? at : at * vs_v3_dot(direction, l->look.forward));
  const vs_material *paint = scene->ground_material;
  vs_vec3 normal = vs_v3(0, 0, 1);
  l->at[MATERIAL][i] = (float)l->ground_material;
  if (hit < m->triangle_count) {
    const vs_vec3 *p[3];
    for (int k = 0; k < 3; k++) p[k] = &m->vertices[m->triangles[hit][k]];
    normal = vs_v3_unit(vs_v3_cross(vs_v3_sub(*p[1], *p[0]), vs_v3_sub(*p[2], *p[0])));
    uint32_t part = m->tags ? m->tags[hit] : 0;
    paint = l->solid.parts[part].material;
    l->at[ID][i] = (float)l->id[part], l->at[MATERIAL][i] = (float)l->material[part];
  }
  if (vs_v3_dot(normal, direction) > 0) normal = vs_v3_scale(normal, -1);
  const double *plain = hit < m->triangle_count ? bare : earth;
  double color[3] = { paint ? paint->red : plain[0], paint ? paint->green : plain[1], paint ? paint->blue : plain[2] };
  put(l, i, normal, color, plain == bare || paint ? vs_povray_diffuse(paint) : earth_diffuse);
  vs_vec3 place = vs_v3_add(vs_v3_add(from, vs_v3_scale(direction, at)), vs_v3_scale(normal, l->hair));
  vs_surrounding round = l->round;
  if (place.z < round.ground) round.ground = -INFINITY; /* the point is below the ground, as in a cellar; the ground
                                                         * must not shade it */
  l->at[OPEN][i] = (float)vs_openness(&round, place, normal, (row + (uint32_t)crop[1]) * l->columns + column +
                                      (uint32_t)crop[0]);
}

/* Computes the layers for a row of pixels, as a task of the threads. */
static bool look_along(vs_kernel *k, void *context, size_t row) {
  const layers *l = context;
  for (uint32_t column = 0; column < l->x->columns; column++) look_at(l, column, (uint32_t)row);
  return vs_kernel_report(k, (double)row / l->x->rows);
}

/* Writing of a text into the header of the EXR picture: its kind, and the error if it fails. */
typedef struct { vs_exr *x; vs_exr_text kind; vs_error *e; } words;

static bool say_more(void *to, const void *bytes, size_t count) {
  const words *t = to;
  return vs_exr_add_text(t->x, t->kind, bytes, count, t->e);
}

/* An entry of a hash table that maps an origin or a material to its number. Origins and materials are interned, so
 * their addresses identify them. The number of entries is a power of two, at least twice the number of stored items. */
typedef struct { const void *what; uint32_t number; } entry;
typedef struct { entry *at; size_t room; uint32_t count; words to; vs_writer text; } list;

static entry *find_entry(const list *t, const void *what) {
  size_t at = (size_t)(((uint64_t)(uintptr_t)what >> 4) * UINT64_C(0x9E3779B97F4A7C15) >> 20) & (t->room - 1);
  while (t->at[at].what && t->at[at].what != what) at = (at + 1) & (t->room - 1);
  return &t->at[at];
}

static bool begin_list(list *t, vs_exr *x, vs_exr_text kind, size_t most, vs_error *e) {
  *t = (list){ .room = 16, .to = { x, kind, e } };
  vs_writer_init(&t->text, say_more, &t->to);
  while (t->room < 2 * most) t->room *= 2;
  t->at = vs_store_realloc(x->store, NULL, 0, t->room * sizeof *t->at);
  if (!t->at) return vs_error_memory(e, NULL);
  memset(t->at, 0, t->room * sizeof *t->at);
  return true;
}

/* Returns the number of the origin or material. Sets *fresh to true if it gets its number now: the caller then writes
 * its line of the list. */
static uint32_t number_of(list *t, const void *what, bool *fresh) {
  entry *n = find_entry(t, what);
  *fresh = !n->what;
  if (*fresh) *n = (entry){ what, ++t->count };
  return n->number;
}

/* Writes a name, with line breaks escaped, because a line break would divide the name's line into two. */
static void put_name(vs_writer *w, const char *name) {
  vs_put_spelled(w, vs_spell_line, name);
}

static uint32_t number_of_material(list *t, const vs_material *m) {
  bool fresh = false;
  uint32_t n = m ? number_of(t, m, &fresh) : 0;
  if (fresh && *m->name) put_name(&t->text, m->name);
  else if (fresh)
    vs_putf(&t->text, "#%02x%02x%02x", (unsigned)lround(255 * m->red), (unsigned)lround(255 * m->green),
            (unsigned)lround(255 * m->blue));
  if (fresh) vs_puts(&t->text, "\n");
  return n;
}

static uint32_t number_of_place(list *t, const vs_origin *o) {
  bool fresh = false;
  uint32_t n = o ? number_of(t, o, &fresh) : 0;
  if (fresh) put_name(&t->text, o->file), vs_putf(&t->text, ":%u:%u\n", o->line, o->column);
  return n;
}

static bool end_list(list *t) {
  bool ok = t->at && vs_writer_flush(&t->text);
  if (t->at) vs_store_realloc(t->to.x->store, t->at, t->room * sizeof *t->at, 0);
  return ok;
}

/* Gives numbers to the origins and the materials of the parts, in the parts' order, and writes the lists of their
 * names. */
static bool number_parts(layers *l) {
  list places = { .at = NULL }, materials = { .at = NULL };
  size_t count = l->solid.part_count;
  vs_error *e = l->e->error;
  bool ok = begin_list(&places, l->x, VS_EXR_SOURCES, count, e) &&
            begin_list(&materials, l->x, VS_EXR_MATERIALS, count + 1, e);
  for (size_t i = 0; ok && i < count; i++) {
    l->id[i] = number_of_place(&places, l->solid.parts[i].leaf.origin);
    l->material[i] = number_of_material(&materials, l->solid.parts[i].material);
  }
  if (ok && l->e->scene->has_ground) l->ground_material = number_of_material(&materials, l->e->scene->ground_material);
  bool listed = end_list(&places), told = end_list(&materials);
  return ok && ((listed && told) || vs_emit_no_memory(l->e));
}

/* ---- texts in the picture's header ---- */

static void say_place(vs_writer *w, const char *what, vs_vec3 v) {
  vs_puts(w, what);
  vs_put_triple(w, " ", v, " ", "");
}
static void say_number(vs_writer *w, const char *what, double x) {
  vs_puts(w, what);
  vs_put_number(w, x);
}

static void say_camera(vs_writer *w, const vs_scene *s, const vs_look *l) {
  vs_puts(w, l->panorama ? "panorama" : l->parallel ? "parallel" : l->upright ? "upright" : "perspective");
  say_place(w, " eye", l->eye);
  if (l->parallel || l->panorama) say_place(w, " forward", l->forward), say_place(w, " up", l->up);
  else say_place(w, " target", l->target), say_number(w, " lens ", 18 / tan(l->angle / 2));
  if (l->parallel) say_number(w, " width ", l->width);
  if (s->view == VS_VIEW_CAMERA && s->aperture > 0) say_number(w, " f-number ", s->aperture);
  vs_puts(w, " units ");
  vs_puts(w, s->units);
}

bool vs_povray_say_view(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows) {
  const double degree = 3.14159265358979323846 / 180;
  vs_look look = vs_look_find(e->scene, &e->framed, e->boxes, e->box_count, (double)columns / rows);
  vs_vec3 sun = vs_look_sun(e->scene, &look);
  double azimuth = atan2(sun.x, sun.y) / degree;
  words to = { x, VS_EXR_CAMERA, e->error };
  vs_writer w;
  vs_writer_init(&w, say_more, &to);
  say_camera(&w, e->scene, &look);
  bool ok = vs_writer_flush(&w);
  to.kind = VS_EXR_SUN;
  say_number(&w, "azimuth ", azimuth < 0 ? azimuth + 360 : azimuth);
  say_number(&w, " altitude ", asin(fmax(fmin(sun.z, 1), -1)) / degree);
  if (e->scene->sky_kind == VS_SKY_CLEAR) say_number(&w, " turbidity ", e->scene->turbidity);
  return ok && vs_writer_flush(&w);
}

/* ---- the layers ---- */

bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows) {
  static const struct { const char *name; vs_exr_type type; } channels[LAYERS] = {
      [DEPTH] = { "Z", VS_EXR_FLOAT }, [NX] = { "N.X", VS_EXR_HALF }, [NY] = { "N.Y", VS_EXR_HALF },
      [NZ] = { "N.Z", VS_EXR_HALF }, [RED] = { "albedo.R", VS_EXR_HALF }, [GREEN] = { "albedo.G", VS_EXR_HALF },
      [BLUE] = { "albedo.B", VS_EXR_HALF }, [ID] = { "id", VS_EXR_WHOLE }, [MATERIAL] = { "material", VS_EXR_WHOLE },
      [OPEN] = { "AO", VS_EXR_HALF } };
  const vs_scene *scene = e->scene;
  vs_kernel_options options = { .job = e->job };
  layers l = { .e = e, .columns = columns, .rows = rows, .x = x };
  bool ok = vs_solid_evaluate(scene->drawn, scene->drawn_count, &e->drawing_facets, &options, &l.solid, e->error);
  size_t bytes = 2 * (l.solid.part_count + 1) * sizeof *l.id;
  if (ok && !(l.id = vs_store_realloc(scene->store, NULL, 0, bytes))) ok = vs_emit_no_memory(e);
  if (ok) l.material = l.id + l.solid.part_count + 1;
  ok = ok && number_parts(&l) && vs_ray_tree_make(&l.tree, scene->store, &l.solid.mesh, e->error);
  for (int k = 0; ok && k < LAYERS; k++) ok = (l.at[k] = vs_exr_add(x, channels[k].name, channels[k].type,
      e->error)) != NULL;
  l.look = vs_look_find(scene, &e->framed, e->boxes, e->box_count, (double)columns / rows);
  double diagonal = vs_bounds_diagonal(&e->framed);
  l.hair = 1e-6 * diagonal;
  l.round = (vs_surrounding){ &l.tree, scene->has_ground ? scene->ground_z : -INFINITY, diagonal / 10 };
  vs_kernel_error problem = { VS_KERNEL_FINE, 0, "" };
  vs_job_stage(e->job, "layers");
  vs_kernel k = { .options = &options, .error = &problem, .threads = vs_kernel_threads(&options), .share = 1 };
  if (ok && !vs_kernel_run(&k, x->rows, look_along, &l))
    ok = problem.status == VS_KERNEL_INTERRUPTED ? vs_error_set(e->error, VS_ERROR_INTERRUPT, NULL, "interrupted")
         : e->error->kind == VS_ERROR_NONE && vs_emit_no_memory(e);
  vs_ray_tree_free(&l.tree);
  if (l.id) vs_store_realloc(scene->store, l.id, bytes, 0);
  vs_solid_free(&l.solid);
  return ok;
}
