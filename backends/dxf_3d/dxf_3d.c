/* Writes the model in space as .dxf (AutoCAD 2004, as text): 3DFACE for the faces of solids, surfaces and regions, LINE
 * and 3D POLYLINE for curves, a block for each template.
 *
 * 3DFACE is the only kind of face that every program reads. An edge between faces of one plane is invisible. An entity
 * has the colour of its material. Without a material it has the colour of its layer or, in a block, that of the block's
 * reference (BYBLOCK). The tables of layers and of blocks precede the entities in the file, so the entities are first
 * collected in memory. If a place of a template is sheared, INSERT cannot represent it, and the template's faces are
 * written there. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "backends/backend.h"
#include "backends/drawing/dxf_codes.h"
#include "geometry/nets/mesh_edges.h"
#include "model/store/array.h"

enum { NAME = 250, BY_BLOCK = 0 };

typedef struct {
  vs_emitter *e;
  vs_writer *w;                /* writes blocks and entities to the array `bytes` */
  char *bytes;
  size_t count, room;
  unsigned handle;             /* the next unused handle (number of an object in the file) */
  unsigned owner;              /* block record to which the entities belong */
  bool in_block;
  bool drawing;                /* whether the blocks are complete and the section of entities has begun */
  unsigned *blocks;            /* blocks[i]: handle of the block record of template i */
  size_t block_count, block_room;
  const vs_material *painted;  /* material of the last entity that has a material; colour: its index, cached because
                                * finding it is slow */
  int colour;
  const char **layers;         /* names of the layers in the order of first use */
  size_t layer_count, layer_room;
} dxf_3d;

static bool space_sink(void *context, const void *bytes, size_t count) {
  dxf_3d *d = context;
  if (!vs_emit_grow(d->e, &d->bytes, &d->room, d->count + count, 1)) return false;
  memcpy(d->bytes + d->count, bytes, count);
  d->count += count;
  return true;
}

static void section(vs_writer *w, const char *name) {
  code(w, 0, "SECTION");
  code(w, 2, name);
}

static bool space_begin(vs_emitter *e) {
  vs_store *store = e->scene->store;
  dxf_3d *d = vs_store_realloc(store, NULL, 0, sizeof *d);
  if (d == NULL) return vs_emit_no_memory(e);
  *d = (dxf_3d){ .e = e, .handle = FIRST_HANDLE, .owner = MODEL_SPACE };
  e->state = d;
  d->w = vs_store_realloc(store, NULL, 0, sizeof *d->w);
  if (d->w == NULL) return vs_emit_no_memory(e);
  vs_writer_init(d->w, space_sink, d);
  vs_emit_watch(e, d->w);
  if (e->scene->has_ground && !vs_emit_warn_once(e, NULL, "DXF: the ground is omitted")) return false;
  section(d->w, "BLOCKS");
  begin_block(d->w, "*Model_Space", MODEL_SPACE, 0x20);
  end_block(d->w, MODEL_SPACE, 0x21);
  begin_block(d->w, "*Paper_Space", PAPER_SPACE, 0x22);
  end_block(d->w, PAPER_SPACE, 0x23);
  return true;
}

static void space_close(vs_emitter *e) {
  dxf_3d *d = e->state;
  if (d == NULL) return;
  vs_emit_release(e, d->w, 1, sizeof *d->w);
  vs_emit_release(e, d->bytes, d->room, 1);
  vs_emit_release(e, d->blocks, d->block_room, sizeof *d->blocks);
  vs_emit_release(e, d->layers, d->layer_room, sizeof *d->layers);
  vs_emit_release(e, d, 1, sizeof *d);
  e->state = NULL;
}

/* ---- entities ---- */

/* Sets `name` to the name of a layer as DXF allows. NULL is layer 0, which in a block means the layer of the block's
 * reference. */
static const char *layer_name(char name[NAME], const char *layer) {
  if (layer == NULL) layer = "0";
  snprintf(name, NAME, "%.*s", (int)vs_character_cut(layer, NAME - 1), layer);
  return vs_dxf_name(name);
}

static void put_layer_name(vs_writer *w, int number, const char *layer) {
  char name[NAME];
  vs_dxf_text(w, number, layer_name(name, layer));
}

/* Adds a layer to the table of layers, unless it has a layer of that name. DXF regards "a:b" and "A;b" as one name. */
static bool keep_layer(dxf_3d *d, const char *layer) {
  char name[NAME], other[NAME];
  for (size_t i = 0; i < d->layer_count; i++)
    if (d->layers[i] == layer) return true;
  if (layer == NULL || strcmp(layer_name(name, layer), "0") == 0) return true;
  for (size_t i = 0; i < d->layer_count; i++)
    if (strcasecmp(layer_name(other, d->layers[i]), name) == 0) return true;
  if (!vs_emit_grow(d->e, &d->layers, &d->layer_room, d->layer_count + 1, sizeof *d->layers)) return false;
  d->layers[d->layer_count++] = layer;
  return true;
}

/* Writes the beginning of an entity. Returns its handle. */
static unsigned entity(dxf_3d *d, const char *type, const char *layer, const vs_material *m) {
  vs_writer *w = d->w;
  if (!d->drawing && !d->in_block) {
    code(w, 0, "ENDSEC");
    section(w, "ENTITIES");
    d->drawing = true;
  }
  code(w, 0, type);
  code_handle(w, 5, d->handle);
  code_handle(w, 330, d->owner);
  code(w, 100, "AcDbEntity");
  put_layer_name(w, 8, layer);
  if (m != NULL) {
    if (m != d->painted) d->colour = vs_dxf_colour_index((const double[3]){ m->red, m->green, m->blue });
    d->painted = m;
    code_int(w, 62, d->colour);
    code_int(w, 420, lround(255 * m->red) << 16 | lround(255 * m->green) << 8 | lround(255 * m->blue));
  } else if (d->in_block) {
    code_int(w, 62, BY_BLOCK);
  }
  return d->handle++;
}

static void point(vs_writer *w, int number, vs_vec3 p) {
  code_real(w, number, p.x);
  code_real(w, number + 10, p.y);
  code_real(w, number + 20, p.z);
}

/* ---- faces ---- */

static vs_vec3 face_normal(const vs_mesh *m, uint32_t t) {
  vs_vec3 a = m->vertices[m->triangles[t][0]];
  return vs_v3_unit(
      vs_v3_cross(vs_v3_sub(m->vertices[m->triangles[t][1]], a), vs_v3_sub(m->vertices[m->triangles[t][2]], a)));
}

/* Returns true if the mesh has other edges with the same ends as edge i, because more than two triangles share it. */
static bool is_shared(const vs_mesh_edges *s, size_t i) {
  const vs_mesh_edge *at = &s->edges[i], *end = s->edges + s->edge_count;
  return (i > 0 && at[-1].a == at->a && at[-1].b == at->b) || (at + 1 < end && at[1].a == at->a && at[1].b == at->b);
}

/* Sets hidden[t] to flags for the sides of triangle t that are invisible: the neighbouring triangle has the same plane
 * and tag. hidden has an element for each triangle, all 0 before. Returns false when memory is out. */
static bool find_hidden(const vs_mesh *m, unsigned char *hidden) {
  static const unsigned char flags[3] = { 2, 8, 1 }; /* flags of DXF for the sides opposite to corners 0, 1, 2; the
                                                      * third side of a triangle is the fourth of a 3DFACE */
  vs_mesh_edges s;
  bool ok = vs_mesh_edges_make(&s, m);
  for (uint32_t t = 0; ok && t < m->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      const uint32_t *side = s.edges[s.of[t][k]].side, next = side[side[0] == t];
      if (next != VS_MESH_NONE && !is_shared(&s, s.of[t][k]) && (m->tags == NULL || m->tags[t] == m->tags[next]) &&
          vs_v3_dot(face_normal(m, t), face_normal(m, next)) > 1 - 1e-9)
        hidden[t] |= flags[k];
    }
  vs_mesh_edges_free(&s);
  return ok;
}

/* Writes the triangles of a solid, mapped by `place`. m: the material of triangles that have none. */
static bool put_faces(dxf_3d *d, const vs_solid *solid, const vs_affine *place, const vs_material *m) {
  const vs_mesh *mesh = &solid->mesh;
  vs_writer *w = d->w;
  bool mirrored = vs_affine_determinant(place) < 0;
  unsigned char *hidden = vs_zeros(mesh->triangle_count + 1, 1);
  bool ok = hidden != NULL && find_hidden(mesh, hidden);
  if (!ok) vs_emit_no_memory(d->e);
  ok = ok && vs_emit_triangles(d->e, mesh->triangle_count);
  for (size_t i = 0; ok && i < mesh->triangle_count && !w->failed; i++) {
    static const int forth[4] = { 0, 1, 2, 2 }, back[4] = { 1, 0, 2, 2 };
    uint32_t tag = mesh->tags != NULL ? mesh->tags[i] : 0;
    const vs_solid_part *part = tag < solid->part_count ? &solid->parts[tag] : NULL;
    const char *layer = part != NULL && part->layer != NULL ? part->layer : d->e->layer;
    ok = keep_layer(d, layer) && vs_emit_going(d->e, i);
    entity(d, "3DFACE", layer, part != NULL && part->material != NULL ? part->material : m);
    code(w, 100, "AcDbFace");
    for (int k = 0; k < 4; k++)
      point(w, 10 + k, vs_affine_point(place, mesh->vertices[mesh->triangles[i][mirrored ? back[k] : forth[k]]]));
    int flags = hidden[i];
    if (mirrored) flags = (flags & 1) | (flags & 2 ? 8 : 0) | (flags & 8 ? 2 : 0);
    if (flags != 0) code_int(w, 70, flags);
  }
  free(hidden);
  return ok && !w->failed;
}

static vs_emit_status space_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const vs_solid *m = vs_emit_mesh(e, ref);
  return m != NULL && put_faces(e->state, m, &e->placement, e->material) ? VS_EMITTED : VS_FAILED;
}

static vs_emit_status space_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return space_leaf(e, ref, phase) == VS_EMITTED ? VS_WHOLE : VS_FAILED;
}

/* ---- curves ---- */

static vs_emit_status space_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  dxf_3d *d = e->state;
  vs_writer *w = d->w;
  const struct vs_line *l = VS_AS(line, ref->node);
  const char *layer = d->e->layer;
  uint32_t count = l->points->count;
  if (count < 2) return VS_EMITTED;
  if (!keep_layer(d, layer)) return VS_FAILED;
  if (count == 2) {
    entity(d, "LINE", layer, e->material);
    code(w, 100, "AcDbLine");
    for (int i = 0; i < 2; i++) point(w, 10 + i, vs_affine_point(&e->placement, l->points->at[i]));
    return w->failed ? VS_FAILED : VS_EMITTED;
  }
  unsigned owner = d->owner, line = entity(d, "POLYLINE", layer, e->material);
  code(w, 100, "AcDb3dPolyline");
  code_int(w, 66, 1);
  point(w, 10, vs_v3(0, 0, 0));
  code_int(w, 70, 8 | (l->closed ? 1 : 0));
  d->owner = line;
  for (uint32_t i = 0; i < count && !w->failed; i++) {
    entity(d, "VERTEX", layer, e->material);
    code(w, 100, "AcDbVertex");
    code(w, 100, "AcDb3dPolylineVertex");
    point(w, 10, vs_affine_point(&e->placement, l->points->at[i]));
    code_int(w, 70, 32);
  }
  entity(d, "SEQEND", layer, e->material);
  d->owner = owner;
  return w->failed ? VS_FAILED : VS_EMITTED;
}

/* Does nothing for placements, paint and layers, because the emitter keeps them for the shapes below. */
static vs_emit_status space_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)e, (void)ref, (void)phase;
  return VS_EMITTED;
}

/* ---- templates ---- */

static void block_name(char name[24], uint32_t id) { snprintf(name, 24, "T%lu", (unsigned long)id); }

static bool space_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  dxf_3d *d = e->state;
  char name[24];
  (void)ref;
  if (!open) {
    end_block(d->w, d->owner, d->handle++);
    d->owner = MODEL_SPACE, d->in_block = false;
    return !d->w->failed;
  }
  if (!vs_emit_grow(e, &d->blocks, &d->block_room, id, sizeof *d->blocks)) return false;
  while (d->block_count < id) d->blocks[d->block_count++] = d->handle++;
  d->owner = d->blocks[id - 1], d->in_block = true;
  block_name(name, id);
  begin_block(d->w, name, d->owner, d->handle++);
  return !d->w->failed;
}

/* Writes an INSERT, the placed block of a template. The normal of its plane is z. DXF derives the block's X axis from
 * the normal (arbitrary axis algorithm), and an angle rotates the block about z from there. */
static void put_insert(dxf_3d *d, uint32_t id, const vs_affine *place) {
  vs_writer *w = d->w;
  char name[24];
  vs_vec3 x = vs_affine_column(place, 0), y = vs_affine_column(place, 1), z = vs_affine_column(place, 2);
  double size[3] = { vs_v3_length(x), vs_v3_length(y), vs_v3_length(z) };
  if (vs_affine_determinant(place) < 0) size[2] = -size[2];
  vs_vec3 normal = vs_v3_scale(z, 1 / size[2]), at = vs_affine_column(place, 3);
  bool near_z = fabs(normal.x) < 1.0 / 64 && fabs(normal.y) < 1.0 / 64;
  vs_vec3 across = vs_v3_unit(vs_v3_cross(near_z ? vs_v3(0, 1, 0) : vs_v3(0, 0, 1), normal)),
          up = vs_v3_unit(vs_v3_cross(normal, across));
  entity(d, "INSERT", d->e->layer, d->e->material);
  code(w, 100, "AcDbBlockReference");
  block_name(name, id);
  code(w, 2, name);
  point(w, 10, vs_v3(vs_v3_dot(at, across), vs_v3_dot(at, up), vs_v3_dot(at, normal)));
  for (int i = 0; i < 3; i++) code_real(w, 41 + i, size[i]);
  code_real(w, 50, atan2(vs_v3_dot(x, up), vs_v3_dot(x, across)) * (180 / acos(-1)));
  point(w, 210, normal);
}

static bool space_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  dxf_3d *d = e->state;
  if (!keep_layer(d, d->e->layer)) return false;
  if (vs_affine_is_placement(&e->placement)) {
    put_insert(d, id, &e->placement);
    return !d->w->failed;
  }
  vs_class class_ = ref->node->class_;
  if (class_ == VS_CURVE || class_ == VS_MIXED)
    return vs_emit_warn_once(e, ref, "DXF places no sheared blocks: sheared copies of curves are omitted");
  const vs_solid *m = vs_emit_mesh(e, ref);
  return m != NULL && put_faces(d, m, &e->placement, e->material);
}

/* ---- the file ---- */

static void space_header(const dxf_3d *d, vs_writer *w) {
  section(w, "HEADER");
  code(w, 9, "$ACADVER");
  code(w, 1, "AC1018");
  code(w, 9, "$DWGCODEPAGE");
  code(w, 3, "ANSI_1252");
  code(w, 9, "$INSUNITS");
  code_int(w, 70, vs_dxf_unit(d->e->scene->units));
  code(w, 9, "$HANDSEED");
  code_handle(w, 5, d->handle + (unsigned)d->layer_count + 1);
  code(w, 0, "ENDSEC");
}

static void layer_row(vs_writer *w, unsigned handle, const char *layer, const vs_scene_pen *pen) {
  code(w, 0, "LAYER");
  code_handle(w, 5, handle);
  code_handle(w, 330, 0x2);
  code(w, 100, "AcDbSymbolTableRecord");
  code(w, 100, "AcDbLayerTableRecord");
  put_layer_name(w, 2, layer);
  code_int(w, 70, 0);
  code_int(w, 62, pen != NULL && pen->colored ? vs_dxf_colour_index(pen->color) : 7);
  code(w, 6, "CONTINUOUS");
  code_handle(w, 390, 0xf);
}

static void line_type(vs_writer *w, unsigned handle, const char *name, const char *shown) {
  row(w, "LTYPE", handle, 0x5, "AcDbLinetypeTableRecord", name);
  code_int(w, 70, 0);
  code(w, 3, shown);
  code_int(w, 72, 65);
  code_int(w, 73, 0);
  code_real(w, 40, 0);
}

static void empty_table(vs_writer *w, const char *name, unsigned handle) {
  table(w, name, handle, 0);
  if (strcmp(name, "DIMSTYLE") == 0) code(w, 100, "AcDbDimStyleTable");
  end_table(w);
}

static void space_tables(const dxf_3d *d, vs_writer *w) {
  section(w, "TABLES");
  empty_table(w, "VPORT", 0x8);
  table(w, "LTYPE", 0x5, 3);
  line_type(w, 0x14, "BYBLOCK", "");
  line_type(w, 0x15, "BYLAYER", "");
  line_type(w, 0x16, "CONTINUOUS", "Solid line");
  end_table(w);
  table(w, "LAYER", 0x2, 1 + (long)d->layer_count);
  layer_row(w, 0x60, NULL, NULL);
  for (size_t i = 0; i < d->layer_count; i++)
    layer_row(w, d->handle + (unsigned)i, d->layers[i], vs_scene_find_pen(d->e->scene, d->layers[i]));
  end_table(w);
  static const struct { const char *name; unsigned handle; } empty[] = { { "STYLE", 0x3 }, { "VIEW", 0x6 },
                                                                         { "UCS", 0x7 } };
  for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) empty_table(w, empty[i].name, empty[i].handle);
  table(w, "APPID", 0x9, 1);
  row(w, "APPID", 0x12, 0x9, "AcDbRegAppTableRecord", "ACAD");
  code_int(w, 70, 0);
  end_table(w);
  empty_table(w, "DIMSTYLE", 0xa);
  table(w, "BLOCK_RECORD", 0x1, 2 + (long)d->block_count);
  row(w, "BLOCK_RECORD", MODEL_SPACE, 0x1, "AcDbBlockTableRecord", "*Model_Space");
  row(w, "BLOCK_RECORD", PAPER_SPACE, 0x1, "AcDbBlockTableRecord", "*Paper_Space");
  for (size_t i = 0; i < d->block_count; i++) {
    char name[24];
    block_name(name, (uint32_t)i + 1);
    row(w, "BLOCK_RECORD", d->blocks[i], 0x1, "AcDbBlockTableRecord", name);
  }
  end_table(w);
  code(w, 0, "ENDSEC");
}

static bool space_end(vs_emitter *e) {
  dxf_3d *d = e->state;
  vs_writer *w = e->out;
  if (!d->drawing) {
    code(d->w, 0, "ENDSEC");
    section(d->w, "ENTITIES");
  }
  code(d->w, 0, "ENDSEC");
  if (!vs_writer_flush(d->w)) return false;
  space_header(d, w);
  space_tables(d, w);
  vs_put(w, d->bytes, d->count);
  section(w, "OBJECTS");
  dictionary(w, ROOT, 0);
  code(w, 3, "ACAD_GROUP");
  code_handle(w, 350, GROUPS);
  dictionary(w, GROUPS, ROOT);
  code(w, 0, "ENDSEC");
  code(w, 0, "EOF");
  return !w->failed;
}

const vs_backend vs_backend_dxf_3d = { .begin = space_begin, .end = space_end, .close = space_close,
                                       .define = space_define, .use = space_use,
                                       .traits = VS_TURNS | VS_UNITS | VS_NAMES,
                                       VS_EMIT_SHAPES(space_leaf, space_line, space_through, space_boolean) };
