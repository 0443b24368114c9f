/* Implements the meshes for a host (vs_mesh_next). A back-end without an output file keeps one mesh, and the
 * placements, of each distinct shape. It compares these shapes with the meshes that the host already has.
 *
 * The id of a shape is a hash of its node, its material and the tolerances of the mesh. A shape that the host already
 * has is therefore recognised before its mesh is computed. All memory is allocated by the session, so that the user's
 * memory limit applies. */
#include "session/host_meshes.h"

#include <string.h>

#include "backends/backend.h"
#include "backends/lower.h"
#include "backends/shade.h"
#include "geometry/shapes/unit_forms.h"
#include "model/store/hashes.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"
#include "session/spine.h"

typedef struct {
  uint64_t id, places_hash;
  size_t place_count, place_room;
  double (*places)[3][4];
  bool made;               /* whether the host does not have this shape yet, so that its mesh must be made */
  vs_mesh mesh;            /* the mesh, whose arrays are allocated by the session */
  vs_shading shading;      /* the unit normals of the mesh, whose arrays are allocated by the session */
  vs_mesh_part *parts;
  size_t part_count;
} shape;

typedef struct {
  shape *at;
  size_t count, room;
  uint32_t *slots;         /* hash table from the id of a shape to the shape's index + 1; the number of slots is a power
                            * of two */
  size_t slot_count;
} shapes;

typedef struct { const char *name; uint64_t id; } known_material;

struct vs_host_meshes {
  vs_backend backend;      /* must be the first member: an emitter's pointer to it is converted to vs_host_meshes */
  vs_format format;
  vs_session *session;
  shapes had, now;         /* had: shapes that the host has; only ids and hashes of placements are kept. now: shapes of
                            * the current drawing */
  const char **layers;     /* names of the open layers, outermost first */
  size_t layer_count, layer_room;
  size_t removed, told;    /* Where the next call of vs_mesh_next continues. removed: index in `had` of the next shape
                            * to check for removal; told: index in `now` of the next shape to pass to the host */
  size_t last;             /* 1 + index of the shape that the host received last and may use until the next call, or
                            * 0 */
  bool open;               /* whether vs_mesh_next is passing the shapes of a drawing */
  uint64_t (*material)(void *context, const char *name);
  void *material_context;
  known_material *known;
  size_t known_count, known_room;
};

/* ---- memory ---- */

static bool grow(vs_session *s, void *array, size_t *room, size_t need, size_t size) {
  void **at = array;
  if (need <= *room) return true;
  size_t more = *room + *room / 2 + 8 > need ? *room + *room / 2 + 8 : need;
  void *grown = vs_session_memory(s, *at, *room * size, more * size);
  if (!grown) return false;
  *at = grown, *room = more;
  return true;
}

static void drop(vs_session *s, void *array, size_t room, size_t size) {
  if (*(void **)array) vs_session_memory(s, *(void **)array, room * size, 0);
  *(void **)array = NULL;
}

static void drop_mesh(vs_session *s, shape *f) {
  drop(s, &f->mesh.vertices, f->mesh.vertex_room, sizeof *f->mesh.vertices);
  drop(s, &f->mesh.triangles, f->mesh.triangle_room, sizeof *f->mesh.triangles);
  drop(s, &f->mesh.tags, f->mesh.triangle_room, sizeof *f->mesh.tags);
  drop(s, &f->parts, f->part_count, sizeof *f->parts);
  vs_shading_free(&f->shading);
  f->mesh = (vs_mesh){ 0 }, f->part_count = 0;
}

static void drop_shape(vs_session *s, shape *f) {
  drop_mesh(s, f);
  drop(s, &f->places, f->place_room, sizeof *f->places);
  f->place_room = 0;
}

static void drop_shapes(vs_session *s, shapes *l) {
  for (size_t i = 0; i < l->count; i++) drop_shape(s, &l->at[i]);
  drop(s, &l->at, l->room, sizeof *l->at);
  drop(s, &l->slots, l->slot_count, sizeof *l->slots);
  *l = (shapes){ 0 };
}

/* ---- the hash table of shapes ---- */

static size_t slot_of(const shapes *l, uint64_t id) {
  size_t i = (size_t)id & (l->slot_count - 1);
  while (l->slots[i] && l->at[l->slots[i] - 1].id != id) i = (i + 1) & (l->slot_count - 1);
  return i;
}

static shape *find(const shapes *l, uint64_t id) {
  uint32_t number = l->slot_count ? l->slots[slot_of(l, id)] : 0;
  return number ? &l->at[number - 1] : NULL;
}

static shape *put(vs_session *s, shapes *l, uint64_t id) {
  if (2 * (l->count + 1) > l->slot_count) {
    size_t slots = l->slot_count ? 2 * l->slot_count : 64;
    uint32_t *fresh = vs_session_memory(s, NULL, 0, slots * sizeof *fresh);
    if (!fresh) return NULL;
    memset(fresh, 0, slots * sizeof *fresh);
    drop(s, &l->slots, l->slot_count, sizeof *l->slots);
    l->slots = fresh, l->slot_count = slots;
    for (size_t i = 0; i < l->count; i++) l->slots[slot_of(l, l->at[i].id)] = (uint32_t)i + 1;
  }
  if (!grow(s, &l->at, &l->room, l->count + 1, sizeof *l->at)) return NULL;
  l->at[l->count] = (shape){ .id = id };
  l->slots[slot_of(l, id)] = (uint32_t)++l->count;
  return &l->at[l->count - 1];
}

/* ---- the back-end that receives the shapes ---- */

static vs_host_meshes *meshes_of(vs_emitter *e) { return (vs_host_meshes *)(uintptr_t)e->backend; }

static const char *layer_of(const vs_host_meshes *m) { return m->layer_count ? m->layers[m->layer_count - 1] : ""; }

static uint64_t paint_hash(vs_emitter *e) {
  uint64_t h = e->material ? vs_material_hash(e->material) : 0;
  const char *layer = layer_of(meshes_of(e));
  return vs_hash_bytes(h, layer, strlen(layer));
}

static bool place(vs_emitter *e, shape *f, const vs_affine *a) {
  vs_session *s = meshes_of(e)->session;
  if (!grow(s, &f->places, &f->place_room, f->place_count + 1, sizeof *f->places)) return vs_emit_no_memory(e);
  uint64_t bits[12];
  _Static_assert(sizeof bits == sizeof *f->places && sizeof bits == sizeof a->m, "a place is twelve numbers");
  memcpy(f->places[f->place_count++], a->m, sizeof bits);
  memcpy(bits, a->m, sizeof bits);
  for (int i = 0; i < 12; i++) f->places_hash = vs_hash_mix(f->places_hash, bits[i]);
  return true;
}

static void paint(vs_mesh_part *p, const vs_material *m, const char *layer, const vs_origin *o) {
  *p = (vs_mesh_part){ .material = "", .layer = layer, .color = { 0.8, 0.8, 0.8, 1 }, .roughness = 0.6, .ior = 1.5 };
  if (m) {
    *p = (vs_mesh_part){ .material = m->name, .layer = layer, .painted = true, .roughness = m->roughness,
                         .color = { m->red, m->green, m->blue, 1 - m->transparency }, .metallic = m->metallic,
                         .ior = m->ior };
  }
  if (o) p->file = o->file, p->line = o->line, p->column = o->column;
}

/* Copies the driver's mesh `from` to the shape f. The driver's mesh is valid only until the driver makes the next
 * mesh. */
static bool keep(vs_emitter *e, shape *f, const vs_solid *from, const vs_origin *origin, double crease) {
  vs_host_meshes *m = meshes_of(e);
  vs_session *s = m->session;
  const vs_mesh *mesh = &from->mesh;
  size_t parts = from->part_count ? from->part_count : 1;
  bool tagged = mesh->tags && from->part_count > 1;
  if (!grow(s, &f->mesh.vertices, &f->mesh.vertex_room, mesh->vertex_count, sizeof *mesh->vertices) ||
      !grow(s, &f->mesh.triangles, &f->mesh.triangle_room, mesh->triangle_count, sizeof *mesh->triangles))
    return vs_emit_no_memory(e);
  f->parts = vs_session_memory(s, NULL, 0, parts * sizeof *f->parts);
  if (!f->parts) return vs_emit_no_memory(e);
  f->part_count = parts;
  if (tagged && !(f->mesh.tags = vs_session_memory(s, NULL, 0, f->mesh.triangle_room * sizeof *f->mesh.tags)))
    return vs_emit_no_memory(e);
  f->mesh.vertex_count = mesh->vertex_count, f->mesh.triangle_count = mesh->triangle_count;
  if (mesh->vertex_count) memcpy(f->mesh.vertices, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
  if (mesh->triangle_count) memcpy(f->mesh.triangles, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
  if (tagged) memcpy(f->mesh.tags, mesh->tags, mesh->triangle_count * sizeof *mesh->tags);
  for (size_t i = 0; i < parts; i++) {
    const vs_solid_part *p = from->part_count ? &from->parts[i] : NULL;
    const vs_origin *o = p && p->leaf.origin ? p->leaf.origin : origin;
    paint(&f->parts[i], p && p->material ? p->material : e->material, p && p->layer ? p->layer : layer_of(m), o);
  }
  vs_shade_faces faces = vs_shade_mesh(&f->mesh, crease);
  return vs_shading_make_in(e, vs_session_memory, s, &faces, &f->shading);
}

/* Returns the shape with this id; adds the shape if the drawing does not contain it yet. Sets *make to true if the
 * caller must compute the shape's mesh. Returns NULL when memory is out. */
static shape *shape_of(vs_emitter *e, uint64_t id, bool *make) {
  vs_host_meshes *m = meshes_of(e);
  shape *f = find(&m->now, id);
  *make = false;
  if (f) return f;
  f = put(m->session, &m->now, id);
  if (!f) return vs_emit_no_memory(e), NULL;
  f->made = *make = !find(&m->had, id);
  return f;
}

/* Returns true if all surfaces of the node are flat, so that its mesh does not depend on the tolerance. Returns false
 * for curved nodes, and for nodes with too many parts to examine. */
static bool is_angular(const vs_node *n) {
  enum { MOST = 200 };
  const vs_node *wait[MOST];
  size_t count = 0, seen = 0;
  wait[count++] = n;
  while (count) {
    n = wait[--count];
    if (++seen > MOST) return false;
    switch ((int)n->kind) {
    case VS_BOX: case VS_WEDGE: case VS_PYRAMID: case VS_POLYFACE_MESH: case VS_GRID_MESH: case VS_HALF_SPACE: break;
    case VS_TRANSFORM: case VS_MATERIAL: case VS_LAYER: case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE:
      if (n->child_count > MOST - count) return false;
      for (uint32_t i = 0; i < n->child_count; i++) wait[count++] = n->children[i].node;
      break;
    default: return false; /* a curved node, or a node of a kind that may be curved */
    }
  }
  return true;
}

static bool emit_shape(vs_emitter *e, const vs_ref *ref, double crease) {
  bool make;
  uint64_t fine = ref->node->hash;
  if (!is_angular(ref->node)) fine = vs_hash_real(vs_hash_real(fine, e->facets.tolerance), e->facets.segments);
  shape *f = shape_of(e, vs_hash_mix(fine, paint_hash(e)), &make);
  if (!f) return false;
  if (make) {
    const vs_solid *mesh = vs_emit_mesh(e, ref);
    if (!mesh || !keep(e, f, mesh, ref->origin, crease)) return false;
  }
  return place(e, f, &e->placement);
}

static vs_emit_status host_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_unit_copy copy;
  if (vs_unit_of(ref->node, &e->facets, &copy)) {
    bool make;
    vs_affine at = vs_affine_multiply(&e->placement, &copy.place);
    if (vs_affine_is_placement(&at)) {
      uint64_t kind = vs_hash_mix(vs_hash_mix(0x756e6974, (uint64_t)copy.unit), (uint64_t)copy.turn);
      shape *f = shape_of(e, vs_hash_mix(kind, paint_hash(e)), &make);
      vs_solid form = { .part_count = 0 };
      bool ok = f && (!make || ((vs_unit_mesh(copy.unit, copy.turn, &form.mesh) || vs_emit_no_memory(e)) &&
                                keep(e, f, &form, ref->origin, vs_shade_crease(copy.turn > 0))));
      vs_mesh_free(&form.mesh);
      return ok && place(e, f, &at) ? VS_EMITTED : VS_FAILED;
    }
  }
  return emit_shape(e, ref, vs_shade_crease(vs_lower_is_round(ref->node))) ? VS_EMITTED : VS_FAILED;
}

static vs_emit_status host_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return emit_shape(e, ref, vs_shade_crease(true)) ? VS_WHOLE : VS_FAILED;
}

/* Adds a curve as a mesh without triangles. Its vertices are the curve's points. For a closed curve, the first point is
 * repeated at the end. */
static vs_emit_status host_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_line *l = VS_AS(line, ref->node);
  vs_host_meshes *m = meshes_of(e);
  bool make;
  if (l->points->count < 2) return VS_EMITTED;
  shape *f = shape_of(e, vs_hash_mix(ref->node->hash, paint_hash(e)), &make);
  if (!f) return VS_FAILED;
  if (make) {
    size_t count = l->points->count + (l->closed ? 1u : 0u);
    f->parts = vs_session_memory(m->session, NULL, 0, sizeof *f->parts);
    if (f->parts) f->part_count = 1, paint(f->parts, e->material, layer_of(m), ref->origin);
    if (!f->parts || !grow(m->session, &f->mesh.vertices, &f->mesh.vertex_room, count, sizeof *f->mesh.vertices))
      return vs_emit_no_memory(e), VS_FAILED;
    for (size_t i = 0; i < count; i++) f->mesh.vertices[i] = l->points->at[i % l->points->count];
    f->mesh.vertex_count = count;
  }
  return place(e, f, &e->placement) ? VS_EMITTED : VS_FAILED;
}

/* Accepts a placement, material, layer or union; the driver emits its children next. Keeps the name of a layer. */
static vs_emit_status host_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  vs_host_meshes *m = meshes_of(e);
  if (ref->node->kind != VS_LAYER) return VS_EMITTED;
  if (phase == VS_PHASE_LEAVE) return m->layer_count--, VS_EMITTED;
  if (!grow(m->session, &m->layers, &m->layer_room, m->layer_count + 1, sizeof *m->layers))
    return vs_emit_no_memory(e), VS_FAILED;
  m->layers[m->layer_count++] = VS_AS(layer, ref->node)->name;
  return VS_EMITTED;
}

static bool host_begin(vs_emitter *e) { return meshes_of(e)->layer_count = 0, true; }
static bool host_end(vs_emitter *e) { return (void)e, true; }

static const vs_backend host_backend = {
  .begin = host_begin, .end = host_end, VS_EMIT_SHAPES(host_leaf, host_line, host_through, host_boolean) };

/* ---- public functions ---- */

static vs_host_meshes *open_meshes(vs_session *s) {
  if (s->meshes) return s->meshes;
  vs_host_meshes *m = vs_session_memory(s, NULL, 0, sizeof *m);
  if (!m) return vs_session_out_of_memory(s), NULL;
  memset(m, 0, sizeof *m);
  m->backend = host_backend, m->session = s;
  m->format = (vs_format){ .name = "meshes", .suffix = "meshes", .doc = "", .binary = true, .backend = &m->backend };
  return s->meshes = m;
}

void vs_session_free_meshes(vs_session *s) {
  vs_host_meshes *m = s->meshes;
  if (!m) return;
  drop_shapes(s, &m->had);
  drop_shapes(s, &m->now);
  drop(s, &m->layers, m->layer_room, sizeof *m->layers);
  drop(s, &m->known, m->known_room, sizeof *m->known);
  vs_session_memory(s, m, sizeof *m, 0);
  s->meshes = NULL;
}

static bool take_nothing(void *context, const void *bytes, size_t count) {
  return (void)context, (void)bytes, (void)count, true;
}

vs_outcome vs_meshes_begin(vs_scheme *vm, const vs_output_options *options) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_meshes_begin")) return VS_OUTCOME_USAGE;
  vs_host_meshes *m = open_meshes(s);
  if (!m) return VS_OUTCOME_MACHINE;
  if (m->open) { /* the host did not receive all shapes of the last drawing: the shapes that it did not receive are
                  * treated as new */
    drop_shapes(s, &m->now);
    m->open = false;
  }
  vs_output_options o = vs_output_options_default();
  vs_session_take_options(&o, sizeof o, VS_FIRST_OUTPUT_OPTIONS, options);
  o.passes &= ~(1u << VS_PASS_FOLD); /* omits the pass fold, which would turn the copies of a shape into different
                                      * nodes */
  vs_byte_sink nowhere = { take_nothing, NULL };
  vs_outcome outcome = vs_session_write(s, NULL, &m->format, &o, &nowhere);
  bool nothing = outcome == VS_OUTCOME_MODEL && !m->now.count && !s->bind.scene.drawn_count && !s->bind.returned_count;
  if (outcome != VS_OUTCOME_DONE && !nothing) return drop_shapes(s, &m->now), outcome;
  m->open = true, m->removed = m->told = m->last = 0;
  return outcome;
}

static uint64_t id_of_material(vs_host_meshes *m, const char *name) {
  if (!m->material || !*name) return 0;
  for (size_t i = 0; i < m->known_count; i++) if (m->known[i].name == name) return m->known[i].id; /* names are
                                                                                                    * interned, and
                                                                                                    * compared by
                                                                                                    * address */
  uint64_t id = m->material(m->material_context, name);
  if (grow(m->session, &m->known, &m->known_room, m->known_count + 1, sizeof *m->known))
    m->known[m->known_count++] = (known_material){ name, id };
  return id;
}

/* Ends the transfer of a drawing's shapes, after the host has received all of them. Returns false. */
static bool end_round(vs_host_meshes *m) {
  drop_shapes(m->session, &m->had);
  m->had = m->now, m->now = (shapes){ 0 };
  m->open = false;
  return false;
}

static bool hand_over(vs_host_meshes *m, shape *f, vs_mesh_info *out) {
  for (size_t i = 0; i < f->part_count; i++) f->parts[i].material_id = id_of_material(m, f->parts[i].material);
  *out = (vs_mesh_info){
    .change = f->made ? VS_MESH_ADDED : VS_MESH_CHANGED, .id = f->id,
    .points = (const double (*)[3])(const void *)f->mesh.vertices, .point_count = f->mesh.vertex_count,
    .corners = (const uint32_t (*)[3])f->mesh.triangles, .triangle_count = f->mesh.triangle_count,
    .normals = (const double (*)[3])(const void *)f->shading.normals, .normal_count = f->shading.normal_count,
    .normal_corners = (const uint32_t (*)[3])f->shading.corners, .part_of = f->mesh.tags, .parts = f->parts,
    .part_count = f->part_count, .places = (const double (*)[3][4])f->places, .place_count = f->place_count };
  return true;
}

bool vs_mesh_next(vs_scheme *vm, vs_mesh_info *out) {
  vs_session *s = vs_session_of(vm);
  vs_host_meshes *m = s->meshes;
  *out = (vs_mesh_info){ 0 };
  if (!m || !m->open || vs_session_busy(s, "vs_mesh_next")) return false;
  if (m->last) drop_shape(s, &m->now.at[m->last - 1]); /* frees the mesh of the shape that the host received last; keeps
                                                        * only the id and the hash of the placements */
  m->last = 0;
  while (m->removed < m->had.count) {
    const shape *f = &m->had.at[m->removed++];
    if (find(&m->now, f->id)) continue;
    *out = (vs_mesh_info){ .change = VS_MESH_REMOVED, .id = f->id };
    return true;
  }
  while (m->told < m->now.count) {
    shape *f = &m->now.at[m->told++];
    const shape *before = f->made ? NULL : find(&m->had, f->id);
    m->last = m->told;
    if (!before || before->places_hash != f->places_hash || before->place_count != f->place_count)
      return hand_over(m, f, out);
    drop_shape(s, f);
    m->last = 0;
  }
  return end_round(m);
}

void vs_meshes_forget(vs_scheme *vm) { vs_session_free_meshes(vs_session_of(vm)); }

void vs_material_handler(vs_scheme *vm, uint64_t (*ask)(void *context, const char *name), void *context) {
  vs_host_meshes *m = open_meshes(vs_session_of(vm));
  if (m) m->material = ask, m->material_context = context, m->known_count = 0;
}
