/* Writes the packed notation: the X3D tree as bytes, written while the driver walks the drawing. The viewer reads it
 * (backends/page/packed.js).
 *
 * The text begins with "VSX1" and is a sequence of entries, each a letter and its data:
 *   N name            opens a node             E                  closes it
 *   D number          names the open node      U number           uses the node of that number
 *   T name bytes      a field of text          B name number      a field with one whole number
 *   F name floats     a field of 32-bit floats G name doubles     one of 64-bit floats
 *   H name shorts     fractions of 32767       I width name words whole numbers of `width` bytes
 * Whole numbers outside of fields are in base 128, low digits first. Texts and arrays begin with their count. A name is
 * a number: 0 introduces a text that gets the next number from 1. Numbers of nodes: a template keeps its own, a
 * geometry has 2^30 and up.
 *
 * Additions to X3D's nodes: Shapes and Groups have `paint` (the number of a material; without it, that of the
 * surrounding node), `layer`, `origin` (an entry of the node Origins at the end) and `kind`; a Transform has
 * `translation` or a `matrix` of three rows.
 *
 * The notation x3d-steps shows the making of the drawing: a Group with the field `item` around each drawn object. A
 * difference or intersection is a Group with the field `operation`, in it the operands and then a Group with the field
 * `result`. A part that is subtracted has the field `cut`. Positions in the whole drawing are stored relative to the
 * drawing's centre, so that 32 bits suffice; all others have their own coordinates. */
#include "backends/lower.h"
#include "backends/x3d/packed.h"

#include <math.h>
#include <string.h>

#include "backends/shade.h"
#include "backends/shared_shapes.h"
#include "backends/view.h"
#include "geometry/sky_light.h"

enum { NAME_MAX_COUNT = 64, GEOMETRY_FIRST = 0x40000000 };

typedef struct { const char *layer; const vs_origin *origin; bool wrapped; } packed_open;

/* The geometry of a Shape: the triangles of a node that have the same material, layer and origin. */
typedef struct { uint32_t geometry, paint; const char *layer; const vs_origin *origin; bool lines; } packed_part;
typedef struct { size_t first, count; } packed_shape; /* first: index of the shape's first part; count: number of its
                                                       * parts */

typedef struct {
  const char *names[NAME_MAX_COUNT];
  size_t name_count;
  vs_nodemap origins;          /* maps an origin to the origin's number, from 1 */
  const vs_origin **origin_list;
  size_t origin_count, origin_room;
  vs_shared_shapes shapes;     /* shapes that are written once; the number of a shape is an index in `made` */
  packed_shape *made;
  size_t made_count, made_room;
  packed_part *parts;
  size_t part_count, part_room;
  packed_open *open;           /* operations around the current node */
  size_t open_count, open_room;
  vs_vec3 middle;              /* centre of the drawing; positions are written relative to it */
  bool inside;                 /* whether a template is being written, in coordinates of its own */
  bool steps;                  /* true if the notation is x3d-steps */
  bool result;                 /* whether the node now written is the result of an operation, not an operand */
  uint32_t geometry_count;
} packed;

/* ---- entries: the elements of the packed notation ---- */

static void packed_count(vs_writer *w, uint64_t x) {
  unsigned char bytes[10];
  size_t n = 0;
  do {
    bytes[n++] = (unsigned char)((x & 127) | (x > 127 ? 128 : 0));
    x >>= 7;
  } while (x > 0);
  vs_put(w, bytes, n);
}

static void packed_name(vs_emitter *e, const char *name) {
  packed *p = e->state;
  size_t i = 0;
  while (i < p->name_count && strcmp(p->names[i], name) != 0) i++;
  if (i < p->name_count) {
    packed_count(e->out, i + 1);
    return;
  }
  packed_count(e->out, 0);
  packed_count(e->out, strlen(name));
  vs_puts(e->out, name);
  if (p->name_count < NAME_MAX_COUNT) p->names[p->name_count++] = name;
}

static void packed_entry(vs_emitter *e, const char *letter, const char *name) {
  vs_put(e->out, letter, 1);
  packed_name(e, name);
}

static void packed_end(vs_emitter *e) { vs_put(e->out, "E", 1); }
static void packed_def(vs_emitter *e, uint64_t number) {
  vs_put(e->out, "D", 1);
  packed_count(e->out, number);
}
static void packed_again(vs_emitter *e, uint64_t number) {
  vs_put(e->out, "U", 1);
  packed_count(e->out, number);
}
static void packed_text(vs_emitter *e, const char *name, const char *value) {
  packed_entry(e, "T", name);
  packed_count(e->out, strlen(value));
  vs_puts(e->out, value);
}
static void packed_number(vs_emitter *e, const char *name, uint64_t value) {
  packed_entry(e, "B", name);
  packed_count(e->out, value);
}
static void packed_float(vs_writer *w, double x) {
  unsigned char bytes[4];
  vs_le_float(bytes, x);
  vs_put(w, bytes, 4);
}
static void packed_vector(vs_writer *w, vs_vec3 v) {
  unsigned char bytes[12];
  vs_le_float(vs_le_float(vs_le_float(bytes, v.x), v.y), v.z);
  vs_put(w, bytes, 12);
}
static void packed_word(vs_writer *w, uint32_t x, int width) {
  unsigned char bytes[4];
  vs_le_u32(bytes, x);
  vs_put(w, bytes, (size_t)width);
}
static void packed_normal(vs_writer *w, vs_vec3 n) {
  const double xyz[] = { n.x, n.y, n.z };
  for (int c = 0; c < 3; c++) packed_word(w, (uint32_t)(int32_t)lround(32767 * fmax(-1, fmin(1, xyz[c]))), 2);
}
static void packed_doubles(vs_emitter *e, const char *name, const double *at, size_t count) {
  packed_entry(e, "G", name);
  packed_count(e->out, count);
  for (size_t i = 0; i < count; i++) {
    unsigned char bytes[8];
    vs_le_double(bytes, at[i]);
    vs_put(e->out, bytes, 8);
  }
}
static void packed_double(vs_emitter *e, const char *name, double x) { packed_doubles(e, name, &x, 1); }
static void packed_place_of(vs_emitter *e, const char *name, vs_vec3 v) {
  const double xyz[] = { v.x, v.y, v.z };
  packed_doubles(e, name, xyz, 3);
}

static void packed_words_begin(vs_emitter *e, const char *name, size_t count, int width) {
  vs_put(e->out, "I", 1);
  packed_count(e->out, (uint64_t)width);
  packed_name(e, name);
  packed_count(e->out, count);
}

/* ---- origins ---- */

/* Returns the number of an origin, from 1, or 0 if there is no origin or memory is out. The origin of a call in the
 * program gets a smaller number than those of the calls inside it. */
static uint32_t packed_origin(vs_emitter *e, const vs_origin *origin) {
  packed *p = e->state;
  while (origin != NULL) {
    const uint64_t *known = vs_nodemap_get(&p->origins, origin);
    if (known != NULL) return (uint32_t)*known;
    const vs_origin *outermost = origin;
    while (outermost->caller != NULL && vs_nodemap_get(&p->origins, outermost->caller) == NULL)
      outermost = outermost->caller;
    uint64_t *number = vs_nodemap_put(&p->origins, outermost, NULL);
    if (number == NULL ||
        !vs_emit_grow(e, &p->origin_list, &p->origin_room, p->origin_count + 1, sizeof *p->origin_list)) {
      vs_emit_no_memory(e);
      e->out->failed = true;
      return 0;
    }
    p->origin_list[p->origin_count++] = outermost;
    *number = p->origin_count;
  }
  return 0;
}

static void packed_origins(vs_emitter *e) {
  packed *p = e->state;
  vs_nodemap files = { .store = e->scene->store };
  uint64_t count = 0;
  packed_entry(e, "N", "Origins");
  packed_words_begin(e, "at", 4 * p->origin_count, 4);
  for (size_t i = 0; i < p->origin_count && !e->out->failed; i++) {
    const vs_origin *o = p->origin_list[i];
    bool found = false;
    uint64_t *file = vs_nodemap_put(&files, o->file, &found);
    const uint64_t *caller = o->caller != NULL ? vs_nodemap_get(&p->origins, o->caller) : NULL;
    if (file == NULL) {
      vs_emit_no_memory(e);
      e->out->failed = true;
      break;
    }
    if (!found) *file = count++;
    packed_word(e->out, (uint32_t)*file, 4);
    packed_word(e->out, o->line, 4);
    packed_word(e->out, o->column, 4);
    packed_word(e->out, caller != NULL ? (uint32_t)*caller : 0, 4);
  }
  /* Writes the files in the order of their numbers. */
  for (uint64_t next = 0, i = 0; i < p->origin_count && next < count && !e->out->failed; i++) {
    const uint64_t *file = vs_nodemap_get(&files, p->origin_list[i]->file);
    if (file == NULL || *file != next) continue;
    const char *path = p->origin_list[i]->file, *slash = strrchr(path, '/');
    /* Writes the file's name without its folder, so that a page does not reveal the folder in which it was made. */
    packed_text(e, "file", e->path != NULL && slash != NULL ? slash + 1 : path);
    next++;
  }
  vs_nodemap_free(&files);
  packed_end(e);
}

/* ---- the head ---- */

static void packed_material(vs_emitter *e, size_t number) {
  const vs_material *m = vs_emit_material_at(e, number);
  packed_entry(e, "N", "PhysicalMaterial");
  packed_text(e, "name", m->name);
  packed_place_of(e, "baseColor", vs_v3(m->red, m->green, m->blue));
  packed_double(e, "roughness", m->roughness);
  packed_double(e, "metallic", m->metallic);
  packed_double(e, "transparency", m->transparency);
  packed_double(e, "ior", m->ior);
  if (m->pattern.kind != VS_PATTERN_NONE) {
    packed_text(e, "pattern", vs_pattern_name(m->pattern.kind));
    if (m->pattern.picture != NULL) {
      const vs_picture *picture = m->pattern.picture;
      packed_text(e, "pictureType", picture->format);
      packed_double(e, "pictureHeight", vs_pattern_height(&m->pattern));
      packed_words_begin(e, "picture", picture->size, 1);
      vs_put(e->out, picture->bytes, picture->size);
    }
    packed_place_of(e, "patternColor", vs_v3(m->pattern.red, m->pattern.green, m->pattern.blue));
    packed_double(e, "patternSize", vs_pattern_size(&m->pattern));
    packed_double(e, "patternAngle", m->pattern.angle);
  }
  packed_end(e);
}

/* Writes the physical sky as light of linear sRGB, where 1 is 10,000 cd/m2: columns from the sun's side to the opposite
 * side, rows from the horizon to the zenith. Also writes the light that a white surface has from the sun and from the
 * sky. */
static void packed_daylight(vs_emitter *e, vs_vec3 sun) {
  enum { COLUMNS = 25, ROWS = 13 };
  const double pi = 3.14159265358979323846, per_candela = 1e-4, per_lux = per_candela / pi;
  vs_sky_light sky = vs_sky_light_of_scene(e->scene, sun);
  double side = atan2(sky.sun.y, sky.sun.x), table[ROWS * COLUMNS * 3];
  for (int row = 0; row < ROWS; row++)
    for (int column = 0; column < COLUMNS; column++) {
      double share = row / (ROWS - 1.), height = share * share * pi / 2, turn = side + pi * column / (COLUMNS - 1.);
      vs_vec3 d = vs_v3(cos(height) * cos(turn), cos(height) * sin(turn), sin(height)), c = vs_sky_light_at(&sky, d);
      double *at = &table[3 * (row * COLUMNS + column)];
      at[0] = per_candela * c.x, at[1] = per_candela * c.y, at[2] = per_candela * c.z;
    }
  packed_entry(e, "N", "Background");
  packed_number(e, "columns", COLUMNS);
  packed_number(e, "rows", ROWS);
  packed_doubles(e, "table", table, ROWS * COLUMNS * 3);
  packed_place_of(e, "sun", vs_v3_scale(vs_sky_light_sun_of_scene(e->scene, sun), per_lux));
  packed_place_of(e, "level", vs_v3_scale(vs_sky_light_level(&sky), per_lux));
  packed_end(e);
}

static void packed_head(vs_emitter *e) {
  packed *p = e->state;
  const vs_scene *s = e->scene;
  double aspect =
      e->options->width > 0 && e->options->height > 0 ? (double)e->options->width / e->options->height : 4.0 / 3;
  vs_look look = vs_look_find(s, &e->bounds, e->boxes, e->box_count, aspect);
  vs_put(e->out, "VSX1", 4);
  packed_entry(e, "N", "WorldInfo");
  packed_text(e, "title", s->title);
  packed_text(e, "units", s->units != NULL ? s->units : "m");
  packed_place_of(e, "middle", p->middle);
  packed_place_of(e, "min", e->bounds.min);
  packed_place_of(e, "max", e->bounds.max);
  packed_end(e);
  packed_entry(e, "N", "Viewpoint");
  packed_place_of(e, "eye", look.eye);
  packed_place_of(e, "target", look.target);
  packed_place_of(e, "up", look.up);
  packed_number(e, "given", s->view == VS_VIEW_CAMERA || s->view == VS_VIEW_PANORAMA);
  packed_number(e, "parallel", look.parallel);
  packed_double(e, "width", look.width);
  packed_double(e, "angle", look.angle);
  packed_double(e, "aspect", aspect);
  packed_end(e);
  packed_entry(e, "N", "DirectionalLight");
  packed_place_of(e, "direction", vs_v3_scale(vs_look_sun(s, &look), -1));
  packed_number(e, "given", s->has_sun);
  packed_number(e, "off", s->no_sun);
  packed_end(e);
  if (s->sky_kind != VS_SKY_PLAIN) packed_daylight(e, vs_look_sun(s, &look));
  else if (s->has_sky) {
    packed_entry(e, "N", "Background");
    packed_doubles(e, "skyColor", s->sky, 3);
    packed_end(e);
  }
  for (size_t i = 1; i <= vs_emit_material_count(e); i++) packed_material(e, i);
  if (s->has_ground) {
    packed_entry(e, "N", "Ground");
    packed_double(e, "z", s->ground_z);
    if (s->ground_material != NULL) packed_number(e, "paint", vs_emit_material_number(e, s->ground_material));
    packed_end(e);
  }
}

/* Returns a point near the centre of the bounds, on a coarse grid. A small change of the model then usually changes
 * neither this point nor the written coordinates. */
static vs_vec3 packed_middle(const vs_bounds *b) {
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5);
  double diagonal = vs_v3_length(vs_v3_sub(b->max, b->min));
  if (!(diagonal > 0)) return middle;
  double step = ldexp(1, (int)ceil(log2(diagonal)));
  return vs_v3(step * round(middle.x / step), step * round(middle.y / step), step * round(middle.z / step));
}

bool vs_packed_open(vs_emitter *e) {
  packed *p = vs_store_realloc(e->scene->store, NULL, 0, sizeof *p);
  if (p == NULL) return vs_emit_no_memory(e);
  memset(p, 0, sizeof *p);
  p->shapes.nodes.store = p->origins.store = e->scene->store;
  p->middle = packed_middle(&e->bounds);
  e->state = p;
  if (e->scene->sky_image != NULL &&
      !vs_emit_warn_once(e, NULL, "only POV-Ray shows the image of a sky: in this format the sky has one colour"))
    return false;
  if (e->scene->lamp_count > 0 &&
      !vs_emit_warn_once(e, NULL, "only POV-Ray shows the light of lamps: in this format lamps give no light"))
    return false;
  packed_head(e);
  return !e->out->failed;
}

bool vs_packed_finish(vs_emitter *e) {
  packed_origins(e);
  return !e->out->failed;
}

void vs_packed_close(vs_emitter *e) {
  packed *p = e->state;
  if (p == NULL) return;
  vs_emit_release(e, p->made, p->made_room, sizeof *p->made);
  vs_emit_release(e, p->parts, p->part_room, sizeof *p->parts);
  vs_emit_release(e, p->open, p->open_room, sizeof *p->open);
  vs_emit_release(e, p->origin_list, p->origin_room, sizeof *p->origin_list);
  vs_nodemap_free(&p->origins);
  vs_shared_free(e, &p->shapes);
  vs_emit_release(e, p, 1, sizeof *p);
  e->state = NULL;
}

/* ---- geometries ---- */

/* A solid that becomes geometries, one for each part with its own material, layer or origin. */
typedef struct {
  vs_shaded_solid shaded;
  uint32_t *same;              /* same[t]: the first tag with the same material, layer and origin as tag t */
  uint32_t *used;              /* used[p]: number of triangles in part p */
  size_t parts;                /* number of parts, at least 1 */
} packed_making;

/* Returns the part with which triangle i is written. */
static uint32_t packed_part_of(const packed_making *from, size_t i) {
  const vs_solid *m = from->shaded.solid;
  return m->mesh.tags != NULL && m->part_count > 0 ? from->same[m->mesh.tags[i]] : 0;
}

/* Writes the points of the part's vertices, or their normals. Vertices have numbers in the order of first use, which is
 * the same in each walk. */
static void packed_vertices(vs_emitter *e, const packed_making *from, uint32_t part, uint32_t count, bool normals) {
  const vs_shaded_solid *s = &from->shaded;
  uint32_t next = 0;
  packed_entry(e, normals ? "H" : "F", normals ? "vector" : "point");
  packed_count(e->out, 3 * (uint64_t)count);
  for (size_t i = 0; i < s->solid->mesh.triangle_count && !e->out->failed; i++) {
    if (packed_part_of(from, i) != part) continue;
    for (int k = 0; k < 3; k++) {
      if (*vs_shaded_vertex(s, i, k) != next) continue;
      next++;
      if (normals) packed_normal(e->out, vs_shaded_normal(s, i, k));
      else packed_vector(e->out, vs_shaded_point(s, i, k));
    }
  }
}

/* Writes the triangles of a part. closed: true if they enclose a solid. */
static void packed_triangles(vs_emitter *e, packed_making *from, uint32_t part, bool closed) {
  const vs_shaded_solid *s = &from->shaded;
  const vs_mesh *mesh = &s->solid->mesh;
  packed *p = e->state;
  vs_writer *w = e->out;
  uint32_t vertices = 0;
  vs_shaded_begin_part(&from->shaded);
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    if (packed_part_of(from, i) != part) continue;
    for (int k = 0; k < 3; k++)
      if (*vs_shaded_vertex(s, i, k) == VS_SHADED_NEW) *vs_shaded_vertex(s, i, k) = vertices++;
  }
  if (!vs_emit_triangles(e, from->used[part])) w->failed = true;
  int width = vertices <= 256 ? 1 : vertices <= 65536 ? 2 : 4;
  packed_entry(e, "N", "IndexedTriangleSet");
  packed_def(e, (uint64_t)GEOMETRY_FIRST + p->geometry_count++);
  if (closed) packed_number(e, "solid", 1);
  packed_words_begin(e, "index", 3 * (size_t)from->used[part], width);
  for (size_t i = 0; i < mesh->triangle_count && !w->failed; i++) {
    if (packed_part_of(from, i) != part) continue;
    for (int k = 0; k < 3; k++) packed_word(w, *vs_shaded_vertex(s, i, k), width);
  }
  if (!w->failed) packed_vertices(e, from, part, vertices, false);
  if (!w->failed) packed_vertices(e, from, part, vertices, true);
  packed_end(e);
}

/* Sets same[t] to the first tag with the same material, layer and origin as tag t. */
static void packed_same(const vs_solid *m, uint32_t *same) {
  for (size_t i = 0; i < m->part_count; i++) {
    const vs_solid_part *a = &m->parts[i];
    size_t first = 0, most = i < 256 ? i : 0; /* compares only the first 256 parts of a shape with earlier parts */
    while (first < most) {
      const vs_solid_part *b = &m->parts[first];
      if (a->material == b->material && a->layer == b->layer && a->leaf.origin == b->leaf.origin) break;
      first++;
    }
    same[i] = (uint32_t)(first < most ? first : i);
  }
}

static bool packed_add_part(vs_emitter *e, packed_part part) {
  packed *p = e->state;
  if (!vs_emit_grow(e, &p->parts, &p->part_room, p->part_count + 1, sizeof *p->parts)) return false;
  p->parts[p->part_count++] = part;
  p->made[p->made_count - 1].count++;
  return true;
}

static bool packed_add_shape(vs_emitter *e) {
  packed *p = e->state;
  if (!vs_emit_grow(e, &p->made, &p->made_room, p->made_count + 1, sizeof *p->made)) return false;
  p->made[p->made_count++] = (packed_shape){ .first = p->part_count };
  return true;
}

static bool packed_count_parts(vs_emitter *e, packed_making *from) {
  const vs_solid *m = from->shaded.solid;
  from->parts = m->part_count > 0 ? m->part_count : 1;
  from->same = vs_store_realloc(e->scene->store, NULL, 0, 2 * from->parts * sizeof *from->same);
  if (from->same == NULL) return vs_emit_no_memory(e);
  from->used = from->same + from->parts;
  memset(from->same, 0, 2 * from->parts * sizeof *from->same);
  packed_same(m, from->same);
  for (size_t i = 0; i < m->mesh.triangle_count; i++) from->used[packed_part_of(from, i)]++;
  return true;
}

/* Writes the geometries of a solid into Groups that viewers do not draw; later Shapes use them. */
static bool packed_add_solid(vs_emitter *e, const vs_solid *m, const vs_affine *home, double crease, bool closed) {
  const packed *p = e->state;
  packed_making from = { .parts = 0 };
  if (!packed_add_shape(e)) return false;
  if (m->mesh.triangle_count > UINT32_MAX / 3)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more triangles than the viewer can number");
  bool ok = vs_shaded_make(e, m, home, crease, &from.shaded) && packed_count_parts(e, &from);
  for (uint32_t k = 0; ok && k < from.parts; k++) {
    if (from.used[k] == 0) continue;
    packed_part made = { .geometry = p->geometry_count };
    const vs_solid_part *part = m->part_count > 0 ? &m->parts[k] : NULL;
    if (part != NULL) {
      made.paint = (uint32_t)vs_emit_material_number(e, part->material);
      made.layer = part->layer, made.origin = part->leaf.origin;
    }
    ok = packed_add_part(e, made);
    if (ok) packed_triangles(e, &from, k, closed);
  }
  vs_emit_release(e, from.same, 2 * from.parts, sizeof *from.same);
  vs_shaded_free(e, &from.shaded);
  return ok && !e->out->failed;
}

/* Writes a unit form (such as a sphere of radius 1) in its own coordinates. */
static bool packed_add_form(vs_emitter *e, const vs_solid *form, double crease, uint32_t *number) {
  const packed *p = e->state;
  vs_affine here = vs_affine_identity();
  *number = (uint32_t)p->made_count;
  return packed_add_solid(e, form, &here, crease, true);
}

/* ---- places ---- */

/* Begins a Transform for objects in coordinates of their own, at `place`. */
static void packed_transform(vs_emitter *e, const vs_affine *place) {
  const packed *p = e->state;
  vs_vec3 at = vs_v3(place->m[0][3], place->m[1][3], place->m[2][3]);
  if (!p->inside) at = vs_v3_sub(at, p->middle);
  bool turned = false;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) turned |= place->m[i][k] != (i == k);
  packed_entry(e, "N", "Transform");
  packed_entry(e, "F", turned ? "matrix" : "translation");
  packed_count(e->out, turned ? 12 : 3);
  if (!turned) {
    packed_vector(e->out, at);
    return;
  }
  const double xyz[] = { at.x, at.y, at.z };
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) packed_float(e->out, place->m[i][k]);
    packed_float(e->out, xyz[i]);
  }
}

/* Returns true if the current node is a subtracted operand. */
static bool packed_is_cut(const vs_emitter *e) {
  const packed *p = e->state;
  return p->steps && !p->result && e->parent != NULL && e->parent->kind == VS_DIFFERENCE && e->child_index > 0;
}

static void packed_marks(vs_emitter *e, const vs_ref *ref, uint32_t paint, const char *layer, const vs_origin *origin) {
  uint32_t number = packed_origin(e, origin);
  if (packed_is_cut(e)) packed_number(e, "cut", 1);
  if (paint > 0) packed_number(e, "paint", paint);
  if (layer != NULL) packed_text(e, "layer", layer);
  if (number > 0) packed_number(e, "origin", number);
  if (ref != NULL) packed_text(e, "kind", vs_kind_get(ref->node->kind)->name);
}

/* Writes a use of shape `number`, which was already written, mapped by `place` and then by e->placement. */
static bool packed_put(vs_emitter *e, const vs_ref *ref, size_t number, const vs_affine *place) {
  const packed *p = e->state;
  const packed_shape shape = p->made[number];
  if (shape.count == 0) return true;
  uint32_t paint = (uint32_t)vs_emit_material_number(e, e->material);
  packed_transform(e, place);
  for (size_t i = 0; i < shape.count; i++) {
    packed_part part = p->parts[shape.first + i];
    packed_entry(e, "N", "Shape");
    packed_marks(e, ref, part.paint > 0 ? part.paint : paint, part.layer,
                 part.origin != NULL ? part.origin : ref->origin);
    packed_again(e, (uint64_t)GEOMETRY_FIRST + part.geometry);
    packed_end(e);
  }
  packed_end(e);
  return !e->out->failed;
}

/* Writes triangles relative to the centre of their bounds. The triangles of a node are written once for all its
 * places. */
static bool packed_shape_of(vs_emitter *e, const vs_ref *ref, double crease) {
  packed *p = e->state;
  vs_shared_place at;
  if (!vs_shared_find(e, &p->shapes, ref->node, vs_affine_is_placement(&e->placement), &at)) return false;
  if (!at.written) {
    const vs_solid *m = vs_emit_mesh(e, ref);
    uint32_t number = (uint32_t)p->made_count;
    if (m == NULL || !packed_add_solid(e, m, &at.home, crease, ref->node->class_ == VS_SOLID) ||
        !vs_shared_keep(e, &p->shapes, ref->node, &at, number))
      return false;
  }
  return packed_put(e, ref, at.number, &at.there);
}

/* ---- emit functions ---- */

vs_emit_status vs_packed_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  packed *p = e->state;
  vs_unit_copy copy;
  uint32_t number;
  if (vs_unit_of(ref->node, &e->facets, &copy)) {
    vs_affine place = vs_affine_multiply(&e->placement, &copy.place);
    if (vs_affine_is_placement(&place))
      return vs_shared_unit(e, &p->shapes, &copy, packed_add_form, &number) && packed_put(e, ref, number, &place)
                 ? VS_EMITTED
                 : VS_FAILED;
  }
  return packed_shape_of(e, ref, vs_shade_crease(vs_lower_is_round(ref->node))) ? VS_EMITTED : VS_FAILED;
}

vs_emit_status vs_packed_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return packed_shape_of(e, ref, vs_shade_crease(true)) ? VS_WHOLE : VS_FAILED;
}

vs_emit_status vs_packed_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  packed *p = e->state;
  const struct vs_line *l = VS_AS(line, ref->node);
  uint32_t count = l->points->count;
  if (count < 2) return VS_EMITTED;
  vs_vec3 middle = vs_shared_line_middle(e, l);
  if (!packed_add_shape(e) || !packed_add_part(e, (packed_part){ p->geometry_count, 0, NULL, NULL, true }))
    return VS_FAILED;
  packed_entry(e, "N", "LineSet");
  packed_def(e, (uint64_t)GEOMETRY_FIRST + p->geometry_count++);
  packed_entry(e, "F", "point");
  packed_count(e->out, 3 * ((uint64_t)count + (l->closed ? 1 : 0)));
  for (uint32_t i = 0; i < count + (l->closed ? 1 : 0) && !e->out->failed; i++)
    packed_vector(e->out, vs_v3_sub(vs_affine_point(&e->placement, l->points->at[i % count]), middle));
  packed_end(e);
  vs_affine there = vs_affine_translation(middle);
  return packed_put(e, ref, p->made_count - 1, &there) ? VS_EMITTED : VS_FAILED;
}

static vs_emit_status packed_close_group(vs_emitter *e) {
  packed *p = e->state;
  if (p->open[--p->open_count].wrapped) packed_end(e);
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

/* Writes an operation with its operands, and then its result. */
static vs_emit_status packed_operation(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  packed *p = e->state;
  if (phase == VS_PHASE_LEAVE) {
    packed_entry(e, "N", "Group");
    packed_number(e, "result", 1);
    p->result = true;
    bool ok = packed_shape_of(e, ref, vs_shade_crease(true));
    p->result = false;
    packed_end(e);
    return packed_close_group(e) == VS_EMITTED && ok ? VS_EMITTED : VS_FAILED;
  }
  if (!vs_emit_grow(e, &p->open, &p->open_room, p->open_count + 1, sizeof *p->open)) return VS_FAILED;
  p->open[p->open_count++] = (packed_open){ NULL, ref->origin, true };
  packed_entry(e, "N", "Group");
  packed_marks(e, ref, 0, NULL, ref->origin);
  packed_number(e, "operation", 1);
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

/* Writes nothing for a placement or paint, because the emitter contains them while shapes are written. An operation
 * becomes a Group if it adds a layer or has its own origin. */
vs_emit_status vs_packed_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  packed *p = e->state;
  if (phase == VS_PHASE_LEAVE) return packed_close_group(e);
  if (!vs_emit_grow(e, &p->open, &p->open_room, p->open_count + 1, sizeof *p->open)) return VS_FAILED;
  const vs_origin *round = p->open_count > 0 ? p->open[p->open_count - 1].origin : NULL;
  const char *layer = ref->node->kind == VS_LAYER ? VS_AS(layer, ref->node)->name : NULL;
  bool wrapped = packed_is_cut(e) || layer != NULL || (ref->origin != NULL && ref->origin != round);
  p->open[p->open_count++] = (packed_open){ layer, ref->origin != NULL ? ref->origin : round, wrapped };
  if (wrapped) {
    packed_entry(e, "N", "Group");
    packed_marks(e, ref, 0, layer, ref->origin);
  }
  return e->out->failed ? VS_FAILED : VS_EMITTED;
}

bool vs_packed_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  packed *p = e->state;
  (void)ref;
  p->inside = open;
  p->open_count = 0;
  if (open) {
    packed_entry(e, "N", "Template");
    packed_def(e, id);
  } else {
    packed_end(e);
  }
  return !e->out->failed;
}

bool vs_packed_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  packed_transform(e, &e->placement);
  packed_marks(e, ref, (uint32_t)vs_emit_material_number(e, e->material), NULL, ref->origin);
  packed_again(e, id);
  packed_end(e);
  return !e->out->failed;
}

static bool packed_begin(vs_emitter *e) { return vs_packed_open(e); }
static bool packed_finish(vs_emitter *e) { return vs_packed_finish(e); }

const vs_backend vs_backend_x3d_packed = { VS_PACKED_BACKEND(packed_begin, packed_finish, vs_packed_close,
                                                             vs_packed_boolean) };

/* ---- the notation x3d-steps, which shows how the drawing is made ---- */

static bool steps_begin(vs_emitter *e) {
  if (!vs_packed_open(e)) return false;
  packed *p = e->state;
  p->steps = true;
  return true;
}

static bool steps_item(vs_emitter *e, size_t index, bool end) {
  if (!end) packed_entry(e, "N", "Group");
  if (!end) packed_number(e, "item", (uint64_t)index + 1);
  else packed_end(e);
  return !e->out->failed;
}

const vs_backend vs_backend_x3d_steps = {
  VS_PACKED_BACKEND(steps_begin, packed_finish, vs_packed_close, packed_operation), .item = steps_item
};
