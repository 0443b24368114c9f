/* Writes the formats of triangles: STL binary and ASCII, OFF, PLY, OBJ with its .mtl. Each contains the union of the
 * drawing's solids, which the kernel computes. PLY, OBJ and OFF also contain open faces; PLY and OBJ also contain lines
 * (loose.h).
 *
 * STL's numbers have 32 bits. If rounding makes two corners of a triangle equal, the triangle is omitted; a closed
 * surface remains closed. */
#include <stdlib.h>
#include <string.h>

#include "backends/backend.h"
#include "backends/mesh/loose.h"
#include "backends/number_spelling.h"
#include "backends/spans.h"
#include "model/store/array.h"

static bool mesh_begin(vs_emitter *e) { return !e->out->failed; }
static bool mesh_end(vs_emitter *e) { return !e->out->failed; }

#define MESH_OMIT(format)                                                                                              \
  .traits = VS_TURNS | VS_UNITS, .omit = { [VS_CURVE] = format " holds solids: curves are omitted", \
            [VS_REGION_CLASS] = format " holds solids: flat regions are omitted", \
            [VS_SURFACE] = format " holds solids: open surfaces are omitted" }

/* Returns the index of the solid's part to which the triangle belongs, or part_count if the triangle belongs to
 * none. */
static size_t mesh_part(const vs_solid *solid, size_t triangle) {
  size_t tag = solid->mesh.tags != NULL ? solid->mesh.tags[triangle] : 0;
  return tag < solid->part_count ? tag : solid->part_count;
}

static bool mesh_put(vs_emitter *e, size_t count, size_t most, vs_span_fn *fn, const void *context) {
  return vs_put_spans(e->out, count, most, fn, context) || (e->out->failed ? false : vs_emit_no_memory(e));
}

/* The greatest length in bytes of three numbers at the end of a line. */
enum { MESH_TRIPLE = 4 * VS_NUMBER_ROOM };
static char *mesh_triple(char *to, vs_vec3 v) {
  to = vs_number_write(to, v.x);
  *to++ = ' ';
  to = vs_number_write(to, v.y);
  *to++ = ' ';
  to = vs_number_write(to, v.z);
  *to++ = '\n';
  return to;
}

static char *mesh_numbers(char *to, const uint32_t t[3], uint32_t first) {
  for (int k = 0; k < 3; k++) {
    *to++ = ' ';
    to = vs_number_write(to, (double)first + t[k]);
  }
  *to++ = '\n';
  return to;
}

/* ---- STL ---- */

static bool stl_same(const float *p, const float *q) { return p[0] == q[0] && p[1] == q[1] && p[2] == q[2]; }

static bool stl_needle(const vs_mesh *m, const uint32_t t[3]) {
  float at[3][3];
  for (int k = 0; k < 3; k++) {
    const vs_vec3 *v = &m->vertices[t[k]];
    at[k][0] = (float)v->x, at[k][1] = (float)v->y, at[k][2] = (float)v->z;
  }
  return stl_same(at[0], at[1]) || stl_same(at[1], at[2]) || stl_same(at[2], at[0]);
}

static vs_vec3 stl_normal(const vs_mesh *m, const uint32_t t[3]) {
  vs_vec3 a = m->vertices[t[0]];
  return vs_v3_unit(vs_v3_cross(vs_v3_sub(m->vertices[t[1]], a), vs_v3_sub(m->vertices[t[2]], a)));
}

static unsigned char *stl_vector(unsigned char *to, vs_vec3 v) {
  return vs_le_float(vs_le_float(vs_le_float(to, v.x), v.y), v.z);
}

enum { STL_RECORD = 50, STL_WORDS = 12 * VS_NUMBER_ROOM + 96 };

static bool stl_stays(const void *context, size_t i) {
  const vs_mesh *m = context;
  return !stl_needle(m, m->triangles[i]);
}

static char *stl_records(const void *context, size_t begin, size_t end, char *at) {
  const vs_mesh *m = context;
  unsigned char *to = (unsigned char *)at;
  for (size_t i = begin; i < end; i++) {
    const uint32_t *t = m->triangles[i];
    if (stl_needle(m, t)) continue;
    to = stl_vector(to, stl_normal(m, t));
    for (int k = 0; k < 3; k++) to = stl_vector(to, m->vertices[t[k]]);
    *to++ = 0; /* writes the number of attribute bytes, which is 0 */
    *to++ = 0;
  }
  return (char *)to;
}

static bool stl_solid(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  unsigned char head[84] = "binary STL by VisualScheme, lengths in ";
  strncat((char *)head, e->scene->units != NULL ? e->scene->units : "m", 8);
  if (e->scene->units_set && e->options->units == NULL && strcmp(e->scene->units, "mm") != 0)
    vs_job_warn(e->job, NULL, "STL files have no unit, and most programs read millimetres: --units mm converts");
  size_t count;
  if (!vs_count_spans(m->triangle_count, stl_stays, m, &count)) return vs_emit_no_memory(e);
  if (count > UINT32_MAX)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more triangles than an STL file can hold");
  if (!vs_emit_triangles(e, count)) return false;
  vs_le_u32(head + 80, (uint32_t)count);
  return vs_put(e->out, head, sizeof head) && mesh_put(e, m->triangle_count, STL_RECORD, stl_records, m);
}

/* Writes triangles as ASCII STL. The numbers are rounded as in the binary form, so both files contain the same mesh. */
static char *stl_words(const void *context, size_t begin, size_t end, char *to) {
  const vs_mesh *m = context;
  for (size_t i = begin; i < end; i++) {
    const uint32_t *t = m->triangles[i];
    if (stl_needle(m, t)) continue;
    vs_vec3 n = stl_normal(m, t);
    VS_WRITE(to, "facet normal ");
    to = mesh_triple(to, vs_v3(vs_single(n.x), vs_single(n.y), vs_single(n.z)));
    VS_WRITE(to, "outer loop\n");
    for (int k = 0; k < 3; k++) {
      vs_vec3 v = m->vertices[t[k]];
      VS_WRITE(to, "vertex ");
      to = mesh_triple(to, vs_v3(vs_single(v.x), vs_single(v.y), vs_single(v.z)));
    }
    VS_WRITE(to, "endloop\nendfacet\n");
  }
  return to;
}

static bool stl_ascii_solid(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  size_t count;
  if (!vs_count_spans(m->triangle_count, stl_stays, m, &count)) return vs_emit_no_memory(e);
  return vs_emit_triangles(e, count) && vs_puts(e->out, "solid VisualScheme\n") &&
         mesh_put(e, m->triangle_count, STL_WORDS, stl_words, m) &&
         vs_puts(e->out, "endsolid VisualScheme\n");
}

const vs_backend vs_backend_stl_ascii = {
  .begin = mesh_begin, .end = mesh_end, .solid = stl_ascii_solid, .numbers = VS_NUMBERS_LOOSE, MESH_OMIT("STL")
};
const vs_backend vs_backend_stl = {
  .begin = mesh_begin, .end = mesh_end, .solid = stl_solid, .numbers = VS_NUMBERS_LOOSE, MESH_OMIT("STL")
};

/* ---- OFF ---- */

static char *off_corners(const void *context, size_t begin, size_t end, char *to) {
  const vs_mesh *m = context;
  for (size_t i = begin; i < end; i++) to = mesh_triple(to, m->vertices[i]);
  return to;
}

static char *off_faces(const void *context, size_t begin, size_t end, char *to) {
  const vs_mesh *m = context;
  for (size_t i = begin; i < end; i++) {
    *to++ = '3';
    to = mesh_numbers(to, m->triangles[i], 0);
  }
  return to;
}

/* Writes the faces of solids, then open faces, which OFF also allows. */
static bool off_solid(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  const vs_loose *l = e->state;
  if (m->vertex_count + l->point_count > UINT32_MAX)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more points than an OFF file can hold");
  vs_mesh loose = { .vertices = l->points, .vertex_count = l->point_count };
  bool ok = vs_emit_triangles(e, m->triangle_count + vs_loose_triangles(l)) &&
            vs_putf(e->out, "OFF\n%lu %lu 0\n", (unsigned long)(m->vertex_count + l->point_count),
                    (unsigned long)(m->triangle_count + vs_loose_triangles(l))) &&
            mesh_put(e, m->vertex_count, MESH_TRIPLE, off_corners, m) &&
            mesh_put(e, loose.vertex_count, MESH_TRIPLE, off_corners, &loose) &&
            mesh_put(e, m->triangle_count, MESH_TRIPLE, off_faces, m);
  for (size_t k = 0; ok && k < l->corner_count && !e->out->failed; k += 3) {
    char text[MESH_TRIPLE] = "3", *end = text + 1;
    uint32_t corners[3];
    for (size_t i = 0; i < 3; i++) corners[i] = l->corners[k + i] + (uint32_t)m->vertex_count;
    end = mesh_numbers(end, corners, 0);
    ok = vs_put(e->out, text, (size_t)(end - text));
  }
  return ok && !e->out->failed;
}

const vs_backend vs_backend_off = {
  .begin = vs_loose_begin, .end = mesh_end, .solid = off_solid, .numbers = VS_NUMBERS_DIGITS,
  VS_LOOSE_FACES("OFF holds faces: curves are omitted")
};

/* ---- PLY: binary, little-endian, coordinates as doubles. Each face has its own colour. Many programs read only the
 * colours of vertices, so a vertex also has the colour of the last of its faces ---- */

static uint8_t ply_level(double x) { return (uint8_t)lround(255 * x); }

enum { PLY_CORNER = 28, PLY_FACE = 17 };

/* The vertices, and their colours, or NULL for `paints`. */
typedef struct { const vs_vec3 *at; const unsigned char (*paints)[4]; } ply_points;

static char *ply_corners(const void *context, size_t begin, size_t end, char *at) {
  const ply_points *p = context;
  unsigned char *to = (unsigned char *)at;
  for (size_t i = begin; i < end; i++) {
    vs_vec3 v = p->at[i];
    to = vs_le_double(vs_le_double(vs_le_double(to, v.x), v.y), v.z);
    if (p->paints == NULL) continue;
    memcpy(to, p->paints[i], sizeof p->paints[i]);
    to += sizeof p->paints[i];
  }
  return (char *)to;
}

static void ply_paint(const vs_material *m, unsigned char paint[4]) {
  vs_material p = m != NULL ? *m : vs_material_of_color(0.86, 0.85, 0.83);
  paint[0] = ply_level(p.red), paint[1] = ply_level(p.green), paint[2] = ply_level(p.blue);
  paint[3] = ply_level(1 - 0.8 * p.transparency);
}

static char *ply_faces(const void *context, size_t begin, size_t end, char *at) {
  const vs_solid *solid = context;
  const vs_mesh *m = &solid->mesh;
  unsigned char *to = (unsigned char *)at, paint[4];
  uint32_t painted = UINT32_MAX;
  for (size_t i = begin; i < end; i++) {
    uint32_t tag = m->tags != NULL ? m->tags[i] : 0;
    if (tag != painted || i == begin) {
      ply_paint(tag < solid->part_count ? solid->parts[tag].material : NULL, paint);
      painted = tag;
    }
    *to++ = 3;
    for (int k = 0; k < 3; k++) to = vs_le_u32(to, m->triangles[i][k]);
    memcpy(to, paint, sizeof paint);
    to += sizeof paint;
  }
  return (char *)to;
}

/* Writes the open faces after the faces of solids. Writes the segments of lines as edges. Each face and edge has a
 * colour of three bytes. */
static bool ply_loose(vs_emitter *e, uint32_t base, bool lines) {
  const vs_loose *l = e->state;
  for (size_t i = 0; i < l->run_count && !e->out->failed; i++) {
    const vs_loose_run *run = &l->runs[i];
    unsigned char record[PLY_FACE], paint[4];
    if (run->line != lines) continue;
    ply_paint(run->material, paint);
    for (size_t k = 0; k + 1 < run->count; k += lines ? 1 : 3) {
      unsigned char *to = record;
      const uint32_t *c = &l->corners[run->first + k];
      if (!lines) *to++ = 3;
      for (size_t n = 0; n < (lines ? 2u : 3u); n++) to = vs_le_u32(to, base + c[n]);
      memcpy(to, paint, sizeof paint);
      vs_put(e->out, record, (size_t)(to - record) + (lines ? 3 : 4));
    }
  }
  return !e->out->failed;
}

/* Sets the colours of all vertices: those of solids, then those of open faces and lines. */
static void ply_paints(const vs_solid *solid, const vs_loose *l, unsigned char (*paints)[4]) {
  const vs_mesh *m = &solid->mesh;
  for (size_t i = 0; i < m->triangle_count; i++) {
    size_t part = mesh_part(solid, i);
    unsigned char paint[4];
    ply_paint(part < solid->part_count ? solid->parts[part].material : NULL, paint);
    for (int k = 0; k < 3; k++) memcpy(paints[m->triangles[i][k]], paint, sizeof paint);
  }
  for (size_t i = 0; i < l->run_count; i++) {
    unsigned char paint[4];
    ply_paint(l->runs[i].material, paint);
    for (size_t k = 0; k < l->runs[i].count; k++)
      memcpy(paints[m->vertex_count + l->corners[l->runs[i].first + k]], paint, sizeof paint);
  }
}

/* Writes the vertices. coloured: whether their colours are written, too. */
static bool ply_vertices(vs_emitter *e, const vs_solid *solid, bool coloured) {
  const vs_loose *l = e->state;
  size_t own = solid->mesh.vertex_count, count = own + l->point_count;
  unsigned char (*paints)[4] = coloured ? vs_zeros(count + 1, sizeof *paints) : NULL;
  if (coloured && paints == NULL) return vs_emit_no_memory(e);
  if (coloured) ply_paints(solid, l, paints);
  const unsigned char (*painted)[4] = (const unsigned char (*)[4])paints;
  ply_points solids = { solid->mesh.vertices, painted }, loose = { l->points, painted != NULL ? painted + own : NULL };
  bool ok = mesh_put(e, own, PLY_CORNER, ply_corners, &solids) &&
            (l->point_count == 0 || mesh_put(e, l->point_count, PLY_CORNER, ply_corners, &loose));
  free(paints);
  return ok;
}

#define PLY_COLOUR "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"

static bool ply_solid(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  vs_writer *w = e->out;
  const vs_loose *l = e->state;
  if (m->vertex_count + l->point_count > UINT32_MAX)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more points than a PLY file can hold");
  if (!vs_emit_triangles(e, m->triangle_count + vs_loose_triangles(l))) return false;
  vs_puts(w, "ply\nformat binary_little_endian 1.0\ncomment made by VisualScheme; ");
  vs_puts(w, e->options->up_y ? "Y" : "Z");
  vs_puts(w, " is up, lengths in ");
  vs_puts(w, e->scene->units);
  vs_putf(w, "\nelement vertex %lu\nproperty double x\nproperty double y\nproperty double z\n",
      (unsigned long)(m->vertex_count + l->point_count));
  bool coloured = vs_emit_material_count(e) > 0;
  if (coloured) vs_puts(w, PLY_COLOUR);
  vs_putf(w, "element face %lu\nproperty list uchar uint vertex_indices\n",
      (unsigned long)(m->triangle_count + vs_loose_triangles(l)));
  vs_puts(w, PLY_COLOUR);
  if (vs_loose_pieces(l) > 0) {
    vs_putf(w, "element edge %lu\nproperty int vertex1\nproperty int vertex2\n", (unsigned long)vs_loose_pieces(l));
    vs_puts(w, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  }
  uint32_t base = (uint32_t)m->vertex_count;
  return vs_puts(w, "end_header\n") && ply_vertices(e, solid, coloured) &&
         mesh_put(e, m->triangle_count, PLY_FACE, ply_faces, solid) && ply_loose(e, base, false) &&
         ply_loose(e, base, true);
}

const vs_backend vs_backend_ply = {
  .begin = vs_loose_begin, .end = mesh_end, .solid = ply_solid, VS_LOOSE_SHAPES(VS_TURNS | VS_UNITS)
};

/* ---- OBJ ---- */

/* Writes a material's name as a single word: its number and the letters and digits of its name. Therefore no name
 * contains a line break, and no two names are equal. */
static void obj_material_name(vs_emitter *e, const vs_material *m) {
  if (m == NULL) {
    vs_puts(e->out, "plain");
    return;
  }
  vs_putf(e->out, "m%lu", (unsigned long)vs_emit_material_number(e, m));
  if (m->name[0] != '\0') vs_puts(e->out, "_");
  for (const char *c = m->name; *c != '\0'; c++)
    vs_put(e->out, (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ? c : "_", 1);
}

/* Returns the name of the .mtl beside the file. The .obj refers to it on a line of text, so a character that a line
 * cannot contain becomes _. The caller frees the name. Returns NULL if memory is out. */
static char *obj_library(const char *path) {
  size_t length = strlen(path);
  char *name = vs_fresh(length + 5, 1);
  if (name == NULL) return NULL;
  memcpy(name, path, length + 1);
  char *dot = strrchr(name, '.'), *slash = strrchr(name, '/');
  if (dot == NULL || (slash != NULL && dot < slash)) dot = name + length;
  memcpy(dot, ".mtl", 5);
  for (char *at = slash != NULL ? slash + 1 : name, *end = dot + 4; at < end;) {
    uint32_t code = 0;
    size_t count = vs_character_read(at, (size_t)(end - at), &code);
    bool fits = count > 0 && !vs_character_is_control(code) && (code == ' ' || !vs_character_is_blank(code));
    if (!fits) memset(at, '_', count > 0 ? count : 1);
    at += count > 0 ? count : 1;
  }
  return name;
}

/* The names of a group of faces or lines; NULL: no part, no layer. */
typedef struct { const char *part, *layer; } obj_names;

/* Writes the line of a name: "o " of a part, "g " of a layer. The name becomes a single word. */
static void obj_name(vs_writer *w, const char *head, const char *name) {
  vs_puts(w, head);
  vs_put_spelled(w, vs_spell_word, name != NULL ? name : "default");
  vs_puts(w, "\n");
}

/* Writes the names that differ from the last ones. */
static void obj_group(vs_writer *w, obj_names last, obj_names now) {
  if (now.part != last.part) obj_name(w, "o ", now.part);
  if (now.layer != last.layer || now.part != last.part) obj_name(w, "g ", now.layer);
}

/* The triangles, sorted by part and layer, then by material. All of them are in the order of first use. */
typedef struct {
  obj_names *layers; /* names of the parts and their layers; the first has neither */
  size_t layer_count, layer_room;
  uint32_t *keys, *order;  /* keys[p]: key of part p; it combines layer and material. order: indices of the triangles,
                            * sorted by the key of their part */
  size_t *starts;      /* starts[k]: position in `order` of the first triangle with key k. A key is layer * (number of
                        * materials + 1) + material number */
  size_t key_count;
} obj_groups;

static void obj_groups_free(vs_emitter *e, obj_groups *g, const vs_solid *solid) {
  vs_emit_release(e, g->layers, g->layer_room, sizeof *g->layers);
  vs_emit_release(e, g->keys, solid->part_count + 1, sizeof *g->keys);
  vs_emit_release(e, g->order, solid->mesh.triangle_count + 1, sizeof *g->order);
  vs_emit_release(e, g->starts, g->key_count + 2, sizeof *g->starts);
}

static bool obj_layer(vs_emitter *e, obj_groups *g, obj_names name, size_t *number) {
  for (*number = 0; *number < g->layer_count; (*number)++)
    if (g->layers[*number].part == name.part && g->layers[*number].layer == name.layer) return true;
  if (!vs_emit_grow(e, &g->layers, &g->layer_room, g->layer_count + 1, sizeof *g->layers)) return false;
  g->layers[g->layer_count++] = name;
  return true;
}

static obj_names obj_names_of(const vs_solid_part *p) { return (obj_names){ p->part, p->layer }; }

static bool obj_groups_make(vs_emitter *e, const vs_solid *solid, obj_groups *g) {
  const vs_mesh *m = &solid->mesh;
  vs_store *store = e->scene->store;
  size_t paints = vs_emit_material_count(e) + 1, layer;
  if (!obj_layer(e, g, (obj_names){ NULL, NULL }, &layer)) return false;
  for (size_t i = 0; i < solid->part_count; i++)
    if (!obj_layer(e, g, obj_names_of(&solid->parts[i]), &layer)) return false;
  g->keys = vs_store_realloc(store, NULL, 0, (solid->part_count + 1) * sizeof *g->keys);
  g->order = vs_store_realloc(store, NULL, 0, (m->triangle_count + 1) * sizeof *g->order);
  g->key_count = g->layer_count * paints;
  g->starts = vs_store_realloc(store, NULL, 0, (g->key_count + 2) * sizeof *g->starts);
  if (g->keys == NULL || g->order == NULL || g->starts == NULL) return vs_emit_no_memory(e);
  for (size_t i = 0; i < solid->part_count; i++) {
    if (!obj_layer(e, g, obj_names_of(&solid->parts[i]), &layer)) return false;
    g->keys[i] = (uint32_t)(layer * paints + vs_emit_material_number(e, solid->parts[i].material));
  }
  g->keys[solid->part_count] = 0; /* key of the triangles that belong to no part */
  memset(g->starts, 0, (g->key_count + 2) * sizeof *g->starts);
  for (size_t i = 0; i < m->triangle_count; i++) g->starts[g->keys[mesh_part(solid, i)] + 2]++;
  for (size_t i = 2; i < g->key_count + 2; i++) g->starts[i] += g->starts[i - 1];
  for (size_t i = 0; i < m->triangle_count; i++) g->order[g->starts[g->keys[mesh_part(solid, i)] + 1]++] = (uint32_t)i;
  return true;
}

typedef struct { const vs_mesh *m; const uint32_t *order; } obj_run;
static char *obj_some(const void *context, size_t begin, size_t end, char *to) {
  const obj_run *run = context;
  for (size_t i = begin; i < end; i++) {
    *to++ = 'f';
    to = mesh_numbers(to, run->m->triangles[run->order[i]], 1);
  }
  return to;
}

static char *obj_corners(const void *context, size_t begin, size_t end, char *to) {
  const vs_mesh *m = context;
  for (size_t i = begin; i < end; i++) {
    VS_WRITE(to, "v ");
    to = mesh_triple(to, m->vertices[i]);
  }
  return to;
}

/* Writes the faces. Sets *last to the part and layer names of the last face. */
static bool obj_faces(vs_emitter *e, const vs_solid *solid, const obj_groups *g, obj_names *last) {
  size_t paints = vs_emit_material_count(e) + 1, last_layer = 0;
  vs_writer *w = e->out;
  for (size_t key = 0; key < g->key_count && !w->failed; key++) {
    if (g->starts[key] == g->starts[key + 1]) continue;
    obj_group(w, g->layers[last_layer], g->layers[key / paints]);
    last_layer = key / paints;
    *last = g->layers[last_layer];
    if (e->path != NULL) {
      vs_puts(w, "usemtl ");
      obj_material_name(e, key % paints > 0 ? vs_emit_material_at(e, key % paints) : NULL);
      vs_puts(w, "\n");
    }
    if (!mesh_put(e, g->starts[key + 1] - g->starts[key], MESH_TRIPLE, obj_some,
                  &(obj_run){ &solid->mesh, g->order + g->starts[key] }))
      return false;
  }
  return !w->failed;
}

/* Writes lines and open faces after the solids. base: number of vertices written before; last: names of the part and
 * layer of the last face before. */
static bool obj_loose(vs_emitter *e, uint32_t base, const obj_names *last) {
  const vs_loose *l = e->state;
  vs_writer *w = e->out;
  obj_names names = { NULL, NULL };
  const vs_material *paint = NULL;
  if (l->run_count == 0) return !w->failed;
  vs_puts(w, "# curves as lines, regions and open surfaces as open faces\n");
  vs_mesh points = { .vertices = l->points, .vertex_count = l->point_count };
  if (!mesh_put(e, l->point_count, MESH_TRIPLE, obj_corners, &points)) return false;
  for (size_t i = 0; i < l->run_count && !w->failed; i++) {
    const vs_loose_run *run = &l->runs[i];
    obj_names own = { run->part, run->layer };
    if (i == 0) names = *last, names.layer = run->layer == NULL ? "" : NULL; /* the first run always has a line "g" */
    obj_group(w, names, own);
    if (e->path != NULL && (i == 0 || run->material != paint)) {
      vs_puts(w, "usemtl ");
      obj_material_name(e, run->material);
      vs_puts(w, "\n");
    }
    names = own, paint = run->material;
    for (size_t k = 0; k < run->count; k++) {
      if (k == 0 || (!run->line && k % 3 == 0)) vs_puts(w, run->line ? "l" : "f");
      vs_puts(w, " ");
      vs_put_u32(w, base + l->corners[run->first + k] + 1);
      if (run->line ? k + 1 == run->count : k % 3 == 2) vs_puts(w, "\n");
    }
  }
  return !w->failed;
}

static bool obj_solid(vs_emitter *e, const vs_solid *solid) {
  const vs_mesh *m = &solid->mesh;
  vs_writer *w = e->out;
  if (!vs_emit_triangles(e, m->triangle_count + vs_loose_triangles(e->state))) return false;
  vs_puts(w, e->options->up_y ? "# made by VisualScheme; Y is up\n" : "# made by VisualScheme; Z is up\n");
  if (e->path != NULL) {
    char *library = obj_library(e->path);
    if (library == NULL) return vs_emit_no_memory(e);
    const char *slash = strrchr(library, '/');
    vs_puts(w, "mtllib ");
    vs_puts(w, slash != NULL ? slash + 1 : library);
    vs_puts(w, "\n");
    free(library);
  }
  if (!mesh_put(e, m->vertex_count, MESH_TRIPLE, obj_corners, m)) return false;
  obj_groups groups = { .key_count = 0 };
  obj_names last = { NULL, NULL };
  bool ok = obj_groups_make(e, solid, &groups) && obj_faces(e, solid, &groups, &last) &&
            obj_loose(e, (uint32_t)m->vertex_count, &last);
  obj_groups_free(e, &groups, solid);
  return ok;
}

static bool obj_fill_library(vs_emitter *e) {
  vs_writer *w = e->out;
  for (size_t i = 0; i <= vs_emit_material_count(e); i++) {
    const vs_material *m = i > 0 ? vs_emit_material_at(e, i) : NULL;
    vs_puts(w, "newmtl ");
    obj_material_name(e, m);
    vs_puts(w, "\nKd ");
    vs_put_triple(w, "", m != NULL ? vs_v3(m->red, m->green, m->blue) : vs_v3(0.86, 0.85, 0.83), " ", "\nKs ");
    double gloss = m != NULL ? 0.5 * (1 - m->roughness) : 0.1;
    vs_put_triple(w, "", vs_v3(gloss, gloss, gloss), " ", "\nNs ");
    vs_put_number(w, m != NULL ? 2 + 198 * (1 - m->roughness) * (1 - m->roughness) : 10);
    vs_puts(w, "\nd ");
    vs_put_number(w, m != NULL ? 1 - 0.8 * m->transparency : 1);
    vs_puts(w, "\nillum 2\n");
  }
  return !w->failed;
}

static bool obj_beside(vs_emitter *e) {
  char *library = obj_library(e->path);
  if (library == NULL) return vs_emit_no_memory(e);
  bool ok = vs_emit_file(e, library, obj_fill_library);
  free(library);
  return ok;
}

const vs_backend vs_backend_obj = {
  .begin = vs_loose_begin, .end = mesh_end, .solid = obj_solid, .numbers = VS_NUMBERS_DIGITS, .beside = obj_beside,
  VS_LOOSE_SHAPES(VS_TURNS | VS_UNITS | VS_NAMES)
};
