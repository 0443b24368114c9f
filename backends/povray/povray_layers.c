/* Owns the look at every pixel by a ray of our own: POV-Ray has no output of depth, normals or names. The kernel's
 * mesh of the drawing is looked at, through the same camera. */
#include "backends/povray/povray_layers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/view.h"
#include "geometry/measure/ray_tree.h"

enum { DEPTH, NX, NY, NZ, RED, GREEN, BLUE, ID, LAYERS };

typedef struct {
  vs_emitter *e;
  vs_look look;
  vs_solid solid;
  vs_ray_tree tree;
  uint32_t *id;         /* of each part; 0: not known where it was made */
  float *at[LAYERS];
  uint32_t columns, rows; /* of the whole picture */
} layers;

/* IEC 61966-2-1. */
static float linear(double s) { return (float)(s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4)); }

static void put(layers *l, size_t i, double depth, vs_vec3 n, const double paint[3], uint32_t id) {
  l->at[DEPTH][i] = (float)depth;
  l->at[NX][i] = (float)n.x, l->at[NY][i] = (float)n.y, l->at[NZ][i] = (float)n.z;
  for (int k = 0; k < 3; k++) l->at[RED + k][i] = linear(paint[k]);
  l->at[ID][i] = (float)id;
}

static void look_at(layers *l, const vs_exr *x, uint32_t column, uint32_t row) {
  static const double bare[3] = { 0.86, 0.85, 0.83 }, earth[3] = { 0.77, 0.76, 0.73 }; /* as povray_scene.c has them */
  const vs_scene *scene = l->e->scene;
  const vs_mesh *m = &l->solid.mesh;
  size_t i = (size_t)row * x->columns + column;
  vs_vec3 from, direction;
  double below = INFINITY, at;
  const int *crop = l->e->options->crop;
  vs_look_ray(&l->look, l->columns, l->rows, column + (uint32_t)crop[0], row + (uint32_t)crop[1], &from, &direction);
  if (scene->has_ground && direction.z != 0) below = (scene->ground_z - from.z) / direction.z;
  if (!(below > 0)) below = INFINITY;
  size_t hit = vs_ray_tree_meet(&l->tree, from, direction, below, false, &at);
  if (!isfinite(at)) {
    l->at[DEPTH][i] = INFINITY;
    return;
  }
  double depth = at * vs_v3_dot(direction, l->look.forward);
  const vs_material *paint = scene->ground_material;
  vs_vec3 normal = vs_v3(0, 0, 1);
  uint32_t id = 0;
  if (hit < m->triangle_count) {
    const vs_vec3 *p[3];
    for (int k = 0; k < 3; k++) p[k] = &m->vertices[m->triangles[hit][k]];
    normal = vs_v3_unit(vs_v3_cross(vs_v3_sub(*p[1], *p[0]), vs_v3_sub(*p[2], *p[0])));
    uint32_t part = m->tags ? m->tags[hit] : 0;
    paint = l->solid.parts[part].material, id = l->id[part];
  }
  if (vs_v3_dot(normal, direction) > 0) normal = vs_v3_scale(normal, -1);
  const double *plain = hit < m->triangle_count ? bare : earth;
  double color[3] = { paint ? paint->red : plain[0], paint ? paint->green : plain[1], paint ? paint->blue : plain[2] };
  put(l, i, depth, normal, color, id);
}

/* A place in the program by its address, since they are interned; in a table with room for twice as many, a power of
 * two. */
typedef struct { const vs_origin *origin; uint32_t id; } place;

static place *find_place(place *table, size_t room, const vs_origin *o) {
  size_t at = (size_t)(((uint64_t)(uintptr_t)o >> 4) * UINT64_C(0x9E3779B97F4A7C15) >> 20) & (room - 1);
  while (table[at].origin && table[at].origin != o) at = (at + 1) & (room - 1);
  return &table[at];
}

/* Numbers the places in the order of the parts, and lists them. */
static bool number_places(layers *l, vs_exr *x) {
  size_t count = l->solid.part_count, room = 16, length = 1;
  while (room < 2 * count) room *= 2;
  place *table = vs_store_realloc(x->store, NULL, 0, room * sizeof *table);
  if (!table) return vs_emit_no_memory(l->e);
  memset(table, 0, room * sizeof *table);
  uint32_t places = 0;
  for (size_t i = 0; i < count; i++) {
    const vs_origin *o = l->solid.parts[i].leaf.origin;
    place *p = o ? find_place(table, room, o) : NULL;
    if (p && !p->origin) *p = (place){ o, ++places }, length += strlen(o->file) + 32;
    l->id[i] = p ? p->id : 0;
  }
  vs_store_realloc(x->store, table, room * sizeof *table, 0);
  x->sources = vs_store_realloc(x->store, NULL, 0, length);
  if (!x->sources) return vs_emit_no_memory(l->e);
  x->sources_room = length;
  char *to = x->sources;
  *to = 0;
  uint32_t next = 1;
  for (size_t i = 0; i < count; i++) {
    const vs_origin *o = l->solid.parts[i].leaf.origin;
    if (!o || l->id[i] != next) continue;
    next++;
    to += snprintf(to, length - (size_t)(to - x->sources), "%s:%u:%u\n", o->file, o->line, o->column);
  }
  return true;
}

static bool keep_going(void *emitter, double done) { return vs_emit_progress(emitter, "meshing", done); }

bool vs_povray_layers(vs_emitter *e, vs_exr *x, uint32_t columns, uint32_t rows) {
  static const struct { const char *name; vs_exr_type type; } channels[LAYERS] = {
      [DEPTH] = { "Z", VS_EXR_FLOAT }, [NX] = { "N.X", VS_EXR_HALF }, [NY] = { "N.Y", VS_EXR_HALF },
      [NZ] = { "N.Z", VS_EXR_HALF }, [RED] = { "albedo.R", VS_EXR_HALF }, [GREEN] = { "albedo.G", VS_EXR_HALF },
      [BLUE] = { "albedo.B", VS_EXR_HALF }, [ID] = { "id", VS_EXR_WHOLE } };
  const vs_scene *scene = e->scene;
  vs_kernel_options options = { .progress = keep_going, .context = e };
  layers l = { .e = e, .columns = columns, .rows = rows };
  bool ok = vs_solid_evaluate(scene->drawn, scene->drawn_count, &e->drawing_facets, &options, &l.solid, e->error);
  size_t bytes = (l.solid.part_count + 1) * sizeof *l.id;
  if (ok && !(l.id = vs_store_realloc(scene->store, NULL, 0, bytes))) ok = vs_emit_no_memory(e);
  ok = ok && number_places(&l, x) && vs_ray_tree_make(&l.tree, scene->store, &l.solid.mesh, e->error);
  for (int k = 0; ok && k < LAYERS; k++) ok = (l.at[k] = vs_exr_add(x, channels[k].name, channels[k].type,
      e->error)) != NULL;
  l.look = vs_look_find(scene, &e->framed, e->boxes, e->box_count, (double)columns / rows);
  for (uint32_t row = 0; ok && row < x->rows; row++) {
    for (uint32_t column = 0; column < x->columns; column++) look_at(&l, x, column, row);
    ok = vs_emit_progress(e, "layers", (double)row / x->rows);
  }
  vs_ray_tree_free(&l.tree);
  if (l.id) vs_store_realloc(scene->store, l.id, bytes, 0);
  vs_solid_free(&l.solid);
  return ok;
}
