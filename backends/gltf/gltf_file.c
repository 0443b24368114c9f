/* Writes the .glb file: a header, the scene as JSON, and the numbers as bytes (glTF 2.0, sections 3 and 4).
 *
 * The length of the JSON precedes the JSON in the file. The JSON is therefore written twice: once to measure its
 * length, and once to the file. In glTF, Y is up and lengths are in metres: the root node rotates and scales. Colours
 * are linear in glTF and sRGB in VisualScheme. */
#include "backends/gltf/gltf_file.h"

#include <math.h>
#include <string.h>

#include "backends/format_numbers.h"
#include "backends/gltf/gltf.h"
#include "backends/gltf/gltf_collect.h"
#include "backends/number_spelling.h"
#include "backends/shade.h"

typedef struct {
  vs_emitter *e;
  const uint32_t *order; /* indices of the nodes, sorted by layer */
  const size_t *starts;
  size_t views[5], view_count; /* views: offsets in bytes of the first five buffer views. view_count: number of all
                                * buffer views, including those of pictures */
} gltf_file;

enum { VIEW_POSITIONS, VIEW_NORMALS, VIEW_PLACES, VIEW_NARROW, VIEW_WIDE, VIEW_COUNT };
static const size_t none = (size_t)-1;

/* ---- small parts of JSON ---- */

static void json_text(vs_writer *w, const char *text) {
  vs_puts(w, "\"");
  vs_put_spelled(w, vs_spell_json, text);
  vs_puts(w, "\"");
}

static void json_between(vs_writer *w, size_t index) {
  if (index > 0) vs_puts(w, ",");
}

static char *json_write_triple(char *to, vs_vec3 v) {
  *to++ = '[';
  to = vs_number_write(to, v.x);
  *to++ = ',';
  to = vs_number_write(to, v.y);
  *to++ = ',';
  return vs_number_write(to, v.z);
}

static void json_vector(vs_writer *w, const char *name, vs_vec3 v) {
  vs_puts(w, ",\"");
  vs_puts(w, name);
  vs_puts(w, "\":");
  vs_put_triple(w, "[", v, ",", "]");
}

/* ---- parts of the file ---- */

static size_t padded(size_t n) { return (n + 3) & ~(size_t)3; }

/* Returns the number of the material's picture. Pictures are in the order of their materials. */
static size_t gltf_picture_number(const vs_emitter *e, size_t material) {
  size_t before = 0;
  for (size_t i = 1; i < material; i++) before += vs_emit_material_at(e, i)->pattern.picture != NULL;
  return before;
}
static size_t gltf_picture_bytes(const vs_emitter *e) {
  size_t bytes = 0;
  for (size_t i = 1; i <= vs_emit_material_count(e); i++) {
    const vs_picture *p = vs_emit_material_at(e, i)->pattern.picture;
    if (p != NULL) bytes += padded(p->size);
  }
  return bytes;
}

/* Writes the material with this number. lines: writes the copy of the material that lines use. These copies follow all
 * materials in the file. Lines need them because light cannot show the shape of a line. */
static void gltf_material(vs_emitter *e, vs_writer *w, size_t number, bool lines) {
  const vs_material *m = number > 0 ? vs_emit_material_at(e, number) : NULL;
  vs_vec3 color = m != NULL ? vs_v3(m->red, m->green, m->blue)
                  : lines   ? vs_v3(0.15, 0.18, 0.22)
                            : vs_v3(0.86, 0.85, 0.83);
  vs_puts(w, "{\"name\":");
  json_text(w, m != NULL ? m->name : "plain");
  vs_puts(w, ",\"pbrMetallicRoughness\":{");
  bool pictured = m != NULL && m->pattern.picture != NULL && !lines;
  if (pictured) vs_putf(w, "\"baseColorTexture\":{\"index\":%zu},", gltf_picture_number(e, number));
  vs_puts(w, "\"baseColorFactor\":");
  if (pictured) vs_puts(w, "[1,1,1,");
  else vs_put_triple(w, "[", vs_linear_color(color), ",", ",");
  vs_put_number(w, m != NULL ? 1 - 0.8 * m->transparency : 1);
  vs_puts(w, "],\"metallicFactor\":");
  vs_put_number(w, m != NULL ? m->metallic : 0);
  vs_puts(w, ",\"roughnessFactor\":");
  vs_put_number(w, m != NULL ? m->roughness : 0.9);
  vs_puts(w, "},\"doubleSided\":true"); /* open surfaces are visible from both sides */
  if (m != NULL && m->transparency > 0) vs_puts(w, ",\"alphaMode\":\"BLEND\"");
  if (lines) vs_puts(w, ",\"extensions\":{\"KHR_materials_unlit\":{}}");
  vs_puts(w, "}");
}

/* Writes a texture, an image and a bufferView for each material with a picture. */
static void gltf_pictures(vs_writer *w, const gltf_file *f) {
  size_t count = 0;
  for (size_t i = 1; i <= vs_emit_material_count(f->e); i++) {
    const vs_picture *p = vs_emit_material_at(f->e, i)->pattern.picture;
    if (p == NULL) continue;
    vs_puts(w, count == 0 ? ",\"images\":[" : ",");
    vs_putf(w, "{\"bufferView\":%zu,\"mimeType\":\"image/%s\"}", f->view_count + count++, p->format);
  }
  if (count == 0) return;
  vs_puts(w, "],\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987}],\"textures\":[");
  for (size_t i = 0; i < count; i++) {
    json_between(w, i);
    vs_putf(w, "{\"sampler\":0,\"source\":%zu}", i);
  }
  vs_puts(w, "]");
}

/* A range of numbers in a buffer view, which an accessor of glTF describes. */
typedef struct {
  size_t view, offset, count;      /* offset: in bytes, in the buffer view; count: number of items */
  const vs_gltf_primitive *bounds; /* if the range contains the positions of a primitive, this primitive; otherwise
                                    * NULL */
} gltf_stretch;

static void gltf_accessor(vs_writer *w, const gltf_file *f, size_t *index, gltf_stretch s) {
  static const struct { int component; const char *type; } kinds[VIEW_COUNT] = {
    [VIEW_POSITIONS] = { 5126, "VEC3" }, [VIEW_NORMALS] = { 5126, "VEC3" }, [VIEW_PLACES] = { 5126, "VEC2" },
    [VIEW_NARROW] = { 5123, "SCALAR" },  [VIEW_WIDE] = { 5125, "SCALAR" },
  };
  const vs_gltf_primitive *bounds = s.bounds;
  json_between(w, (*index)++);
  vs_putf(w, "{\"bufferView\":%zu,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"",
          f->views[s.view], s.offset, kinds[s.view].component, s.count, kinds[s.view].type);
  if (bounds != NULL) {
    json_vector(w, "min", vs_v3(bounds->min[0], bounds->min[1], bounds->min[2]));
    json_vector(w, "max", vs_v3(bounds->max[0], bounds->max[1], bounds->max[2]));
  }
  vs_puts(w, "}");
}

static void gltf_accessors(vs_writer *w, const gltf_file *f, const vs_gltf *g) {
  size_t index = 0;
  vs_puts(w, ",\"accessors\":[");
  for (size_t i = 0; i < g->primitive_count && !w->failed; i++) { /* three accessors (descriptions of ranges of numbers)
                                                                   * for each primitive: numbers 3i to 3i + 2 */
    const vs_gltf_primitive *p = &g->primitives[i];
    size_t indices = p->wide ? VIEW_WIDE : VIEW_NARROW;
    gltf_accessor(w, f, &index, (gltf_stretch){ VIEW_POSITIONS, p->vertices, p->vertex_count, p });
    gltf_accessor(w, f, &index, (gltf_stretch){ VIEW_NORMALS, p->vertices, p->vertex_count, NULL });
    gltf_accessor(w, f, &index, (gltf_stretch){ indices, p->indices, p->index_count, NULL });
  }
  for (size_t i = 0; i < g->primitive_count && !w->failed; i++) { /* then the accessors of texture coordinates, which
                                                                   * few primitives have */
    const vs_gltf_primitive *p = &g->primitives[i];
    if (p->pictured)
      gltf_accessor(w, f, &index, (gltf_stretch){ VIEW_PLACES, p->places, p->vertex_count, NULL });
  }
  vs_puts(w, "]");
}

static void gltf_meshes(vs_writer *w, const gltf_file *f, const vs_gltf *g) {
  size_t materials = vs_emit_material_count(f->e) + 1;
  vs_puts(w, ",\"meshes\":[");
  for (size_t i = 0; i < g->mesh_count && !w->failed; i++) {
    const vs_gltf_geometry *made = &g->geometries[g->meshes[i].geometry];
    json_between(w, i);
    vs_puts(w, "{\"primitives\":[");
    for (size_t k = 0; k < made->count; k++) {
      const vs_gltf_primitive *p = &g->primitives[made->first + k];
      size_t paint = p->paint > 0 ? p->paint : g->meshes[i].paint, first = 3 * (made->first + k);
      json_between(w, k);
      if (p->lines)
        vs_putf(w, "{\"mode\":3,\"attributes\":{\"POSITION\":%zu},\"indices\":%zu,\"material\":%zu}", first, first + 2,
                materials + paint);
      else {
        vs_putf(w, "{\"attributes\":{\"POSITION\":%zu,\"NORMAL\":%zu", first, first + 1);
        if (p->pictured > 0) vs_putf(w, ",\"TEXCOORD_0\":%zu", 3 * g->primitive_count + p->pictured - 1);
        vs_putf(w, "},\"indices\":%zu,\"material\":%zu}", first + 2, paint);
      }
    }
    vs_puts(w, "]}");
  }
  vs_puts(w, "]");
}

/* Writes a node directly into the writer's buffer. A file may contain a million nodes. */
static void gltf_node(vs_writer *w, const vs_gltf_node *n) {
  vs_vec3 at, size;
  double turn[4];
  vs_affine_split(&n->place, &at, turn, &size);
  char *to = vs_writer_room(w, 12 * VS_NUMBER_ROOM + 80);
  if (to == NULL) return;
  VS_WRITE(to, ",{\"mesh\":");
  to = vs_number_write(to, n->mesh);
  if (at.x != 0 || at.y != 0 || at.z != 0) {
    VS_WRITE(to, ",\"translation\":");
    to = json_write_triple(to, at);
    *to++ = ']';
  }
  if (fabs(turn[0]) < 1) {
    VS_WRITE(to, ",\"rotation\":");
    to = json_write_triple(to, vs_v3(turn[1], turn[2], turn[3]));
    *to++ = ',';
    to = vs_number_write(to, turn[0]);
    *to++ = ']';
  }
  if (size.x != 1 || size.y != 1 || size.z != 1) {
    VS_WRITE(to, ",\"scale\":");
    to = json_write_triple(to, size);
    *to++ = ']';
  }
  *to++ = '}';
  vs_writer_filled(w, to);
}

static void gltf_child(vs_writer *w, size_t *count, size_t node) {
  vs_puts(w, (*count)++ > 0 ? "," : ",\"children\":[");
  vs_put_number(w, (double)node);
}

/* Writes the nodes. Node 0 is the root. The layers and parts follow, then the placed meshes in f->order. */
static void gltf_nodes(vs_writer *w, const gltf_file *f, const vs_gltf *g) {
  size_t first = 1 + g->layer_count;
  double unit = vs_scene_metres(f->e->scene);
  vs_puts(w, ",\"nodes\":[{\"name\":");
  json_text(w, f->e->scene->title);
  vs_puts(w, ",\"rotation\":[-0.70710678118655,0,0,0.70710678118655]");
  if (unit != 1) json_vector(w, "scale", vs_v3(unit, unit, unit));
  for (size_t layer = 0; layer <= g->layer_count && !w->failed; layer++) {
    if (layer > 0) {
      vs_puts(w, ",{\"name\":");
      json_text(w, g->layers[layer - 1].name);
      if (g->layers[layer - 1].part) vs_puts(w, ",\"extras\":{\"part\":true}");
    }
    size_t count = 0;
    bool around = layer == 0 || g->layers[layer - 1].part;
    for (size_t i = 1; around && i <= g->layer_count; i++)
      if (g->layers[i - 1].above == layer) gltf_child(w, &count, i);
    for (size_t i = f->starts[layer]; i < f->starts[layer + 1] && !w->failed; i++) gltf_child(w, &count, first + i);
    vs_puts(w, count > 0 ? "]}" : "}");
  }
  for (size_t i = 0; i < g->node_count && !w->failed; i++) {
    gltf_node(w, &g->nodes[f->order[i]]);
    if ((i & 0xfff) == 0 && !vs_emit_progress(f->e, "writing", -1)) w->failed = true;
  }
  vs_puts(w, "]");
}

static void gltf_json(vs_writer *w, const gltf_file *f) {
  vs_emitter *e = f->e;
  const vs_gltf *g = e->state;
  const size_t lengths[VIEW_COUNT] = { g->positions.count, g->normals.count, g->places.count, g->narrow.count,
                                       g->wide.count };
  bool lines = false;
  for (size_t i = 0; i < g->primitive_count; i++) lines |= g->primitives[i].lines;
  vs_puts(w, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"VisualScheme\"}");
  if (lines) vs_puts(w, ",\"extensionsUsed\":[\"KHR_materials_unlit\"]");
  vs_puts(w, ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"materials\":[");
  for (size_t i = 0; i <= vs_emit_material_count(e); i++) {
    json_between(w, i);
    gltf_material(e, w, i, false);
  }
  for (size_t i = 0; lines && i <= vs_emit_material_count(e); i++) {
    vs_puts(w, ",");
    gltf_material(e, w, i, true);
  }
  vs_puts(w, "]");
  gltf_pictures(w, f);
  vs_puts(w, ",\"buffers\":[{\"byteLength\":");
  size_t total = gltf_picture_bytes(e), offset = 0, count = 0;
  for (int i = 0; i < VIEW_COUNT; i++) total += padded(lengths[i]);
  vs_putf(w, "%zu}],\"bufferViews\":[", total);
  for (size_t i = 0; i < VIEW_COUNT; offset += padded(lengths[i++])) {
    if (f->views[i] == none) continue;
    json_between(w, count++);
    vs_putf(w, "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,%s}", offset, lengths[i],
            i <= VIEW_NORMALS  ? "\"byteStride\":12,\"target\":34962"
            : i == VIEW_PLACES ? "\"byteStride\":8,\"target\":34962"
                               : "\"target\":34963");
  }
  for (size_t i = 1; i <= vs_emit_material_count(e); i++) {
    const vs_picture *picture = vs_emit_material_at(e, i)->pattern.picture;
    if (picture == NULL) continue;
    json_between(w, count++);
    vs_putf(w, "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", offset, picture->size);
    offset += padded(picture->size);
  }
  vs_puts(w, "]");
  gltf_accessors(w, f, g);
  gltf_meshes(w, f, g);
  gltf_nodes(w, f, g);
  vs_puts(w, "}");
}

/* ---- the file ---- */

static bool discard(void *context, const void *bytes, size_t count) {
  (void)context, (void)bytes, (void)count;
  return true;
}

/* Returns the length of the JSON in bytes, or 0 on failure. */
static uint64_t gltf_measure(const gltf_file *f) {
  vs_store *store = f->e->scene->store;
  vs_writer *w = vs_store_realloc(store, NULL, 0, sizeof *w);
  if (w == NULL) return vs_emit_no_memory(f->e), 0;
  vs_writer_init(w, discard, NULL);
  gltf_json(w, f);
  uint64_t bytes = w->failed ? 0 : w->bytes;
  vs_store_realloc(store, w, sizeof *w, 0);
  return bytes;
}

static bool gltf_chunks(const gltf_file *f) {
  const vs_gltf *g = f->e->state;
  vs_writer *w = f->e->out;
  const vs_gltf_bytes *parts[VIEW_COUNT] = { &g->positions, &g->normals, &g->places, &g->narrow, &g->wide };
  uint64_t json = gltf_measure(f), spaces = (4 - json % 4) % 4, binary = 0;
  if (json == 0) return false;
  for (int i = 0; i < VIEW_COUNT; i++) binary += padded(parts[i]->count);
  binary += gltf_picture_bytes(f->e);
  uint64_t total = 12 + 8 + json + spaces + 8 + binary;
  if (total > UINT32_MAX)
    return vs_error_set(f->e->error, VS_ERROR_MODEL, NULL, "the drawing is larger than the 4 GB of a .glb file");
  unsigned char head[20];
  memcpy(head, "glTF", 4);
  vs_le_u32(vs_le_u32(vs_le_u32(head + 4, 2), (uint32_t)total), (uint32_t)(json + spaces));
  memcpy(head + 16, "JSON", 4);
  vs_put(w, head, sizeof head);
  gltf_json(w, f);
  vs_put_spaces(w, (size_t)spaces);
  vs_le_u32(head, (uint32_t)binary);
  memcpy(head + 4, "BIN", 4);
  vs_put(w, head, 8);
  static const unsigned char zeros[4] = { 0 };
  for (int i = 0; i < VIEW_COUNT; i++) {
    vs_put(w, parts[i]->at, parts[i]->count);
    vs_put(w, zeros, padded(parts[i]->count) - parts[i]->count);
  }
  for (size_t i = 1; i <= vs_emit_material_count(f->e); i++) {
    const vs_picture *p = vs_emit_material_at(f->e, i)->pattern.picture;
    if (p == NULL) continue;
    vs_put(w, p->bytes, p->size);
    vs_put(w, zeros, padded(p->size) - p->size);
  }
  return !w->failed;
}

bool vs_gltf_write(vs_emitter *e) {
  const vs_gltf *g = e->state;
  vs_store *store = e->scene->store;
  if (!vs_emit_rounded(e, &g->settled)) return false;
  const size_t lengths[VIEW_COUNT] = { g->positions.count, g->normals.count, g->places.count, g->narrow.count,
                                       g->wide.count };
  size_t layers = g->layer_count + 1, room = (g->node_count + 1) * sizeof(uint32_t),
         starts_room = (layers + 1) * sizeof(size_t);
  uint32_t *order = vs_store_realloc(store, NULL, 0, room);
  size_t *starts = vs_store_realloc(store, NULL, 0, starts_room);
  bool ok = (order != NULL && starts != NULL) || vs_emit_no_memory(e);
  if (ok) { /* sorts the nodes by layer, and otherwise keeps their order */
    memset(starts, 0, starts_room);
    for (size_t i = 0; i < g->node_count; i++) starts[g->nodes[i].layer + 1]++;
    for (size_t i = 1; i <= layers; i++) starts[i] += starts[i - 1];
    for (size_t i = 0; i < g->node_count; i++) order[starts[g->nodes[i].layer]++] = (uint32_t)i;
    for (size_t i = layers; i > 0; i--) starts[i] = starts[i - 1];
    starts[0] = 0;
    gltf_file f = { .e = e, .order = order, .starts = starts };
    for (int i = 0; i < VIEW_COUNT; i++) f.views[i] = lengths[i] > 0 ? f.view_count++ : none;
    ok = gltf_chunks(&f);
  }
  if (order != NULL) vs_store_realloc(store, order, room, 0);
  if (starts != NULL) vs_store_realloc(store, starts, starts_room, 0);
  return ok;
}

/* The back-end has no .numbers, which would round all shapes together: each shape is rounded separately, relative to
 * its own centre. */
const vs_backend vs_backend_glb = { .begin = vs_gltf_open, .end = vs_gltf_write, .close = vs_gltf_close,
                                    .traits = VS_NAMES,
                                    VS_EMIT_SHAPES(vs_gltf_leaf, vs_gltf_line, vs_gltf_through, vs_gltf_boolean) };
