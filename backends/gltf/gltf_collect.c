/* Converts the drawing to glTF's meshes and nodes.
 *
 * Several places use one geometry in two cases: copies of a unit form (such as a sphere of radius 1) with the same
 * number of facets, and places of the same node of the model. (The share pass makes equal parts one node.) A glTF node
 * cannot express a placement that shears. The triangles are then computed for that place alone. */
#include "backends/gltf/gltf_collect.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "backends/format_numbers.h"
#include "backends/lower.h"
#include "backends/gltf/gltf.h"
#include "backends/shade.h"

bool vs_gltf_open(vs_emitter *e) {
  vs_gltf *g = vs_store_realloc(e->scene->store, NULL, 0, sizeof *g);
  if (g == NULL) return vs_emit_no_memory(e);
  memset(g, 0, sizeof *g);
  g->shapes.nodes.store = e->scene->store;
  e->state = g;
  if (e->scene->has_ground && !vs_emit_warn_once(e, NULL, "glTF: the ground is omitted")) return false;
  return true;
}

void vs_gltf_close(vs_emitter *e) {
  vs_gltf *g = e->state;
  if (g == NULL) return;
  vs_gltf_bytes *bytes[] = { &g->positions, &g->normals, &g->places, &g->narrow, &g->wide };
  for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++) vs_emit_release(e, bytes[i]->at, bytes[i]->room, 1);
  vs_emit_release(e, g->primitives, g->primitive_room, sizeof *g->primitives);
  vs_emit_release(e, g->geometries, g->geometry_room, sizeof *g->geometries);
  vs_emit_release(e, g->meshes, g->mesh_room, sizeof *g->meshes);
  vs_emit_release(e, g->nodes, g->node_room, sizeof *g->nodes);
  vs_emit_release(e, g->layers, g->layer_room, sizeof *g->layers);
  vs_emit_release(e, g->open_layers, g->open_room, sizeof *g->open_layers);
  vs_shared_free(e, &g->shapes);
  vs_emit_release(e, g, 1, sizeof *g);
  e->state = NULL;
}

/* ---- geometries ---- */

static unsigned char *gltf_room(vs_emitter *e, vs_gltf_bytes *b, size_t count) {
  if (!vs_emit_grow(e, &b->at, &b->room, b->count + count, 1)) return NULL;
  b->count += count;
  return b->at + b->count - count;
}

static bool gltf_vector(vs_emitter *e, vs_gltf_bytes *b, vs_vec3 v) {
  unsigned char *to = gltf_room(e, b, 12);
  if (to == NULL) return false;
  vs_le_float(vs_le_float(vs_le_float(to, v.x), v.y), v.z);
  return true;
}

static vs_gltf_primitive *gltf_primitive_new(vs_emitter *e, uint32_t paint) {
  vs_gltf *g = e->state;
  if (!vs_emit_grow(e, &g->primitives, &g->primitive_room, g->primitive_count + 1, sizeof *g->primitives)) return NULL;
  vs_gltf_primitive *p = &g->primitives[g->primitive_count++];
  *p = (vs_gltf_primitive){ .paint = paint, .vertices = g->positions.count,
                            .min = { FLT_MAX, FLT_MAX, FLT_MAX }, .max = { -FLT_MAX, -FLT_MAX, -FLT_MAX } };
  return p;
}

static bool gltf_vertex(vs_emitter *e, vs_gltf_primitive *p, vs_vec3 at, vs_vec3 normal) {
  vs_gltf *g = e->state;
  const float xyz[] = { (float)at.x, (float)at.y, (float)at.z };
  for (int i = 0; i < 3; i++) {
    p->min[i] = fminf(p->min[i], xyz[i] + 0.0f);
    p->max[i] = fmaxf(p->max[i], xyz[i] + 0.0f);
  }
  p->vertex_count++;
  /* Lines get normals, although no reader uses these. As a result, an offset in the positions is also valid in the
   * normals. */
  return gltf_vector(e, &g->positions, at) && gltf_vector(e, &g->normals, normal);
}

/* Adds the indices, with 16 bits each if the number of vertices permits this, otherwise with 32 bits. */
static bool gltf_indices(vs_emitter *e, vs_gltf_primitive *p, const uint32_t *index, size_t count) {
  vs_gltf *g = e->state;
  p->wide = p->vertex_count >= 65535; /* glTF does not allow the largest number of 16 bits as an index */
  p->index_count = (uint32_t)count;
  vs_gltf_bytes *b = p->wide ? &g->wide : &g->narrow;
  p->indices = b->count;
  unsigned char *to = gltf_room(e, b, count * (p->wide ? 4 : 2));
  if (to == NULL) return false;
  for (size_t i = 0; i < count; i++) {
    *to++ = (unsigned char)index[i];
    *to++ = (unsigned char)(index[i] >> 8);
    if (!p->wide) continue;
    *to++ = (unsigned char)(index[i] >> 16);
    *to++ = (unsigned char)(index[i] >> 24);
  }
  return true;
}

static bool gltf_geometry_new(vs_emitter *e, uint32_t *number) {
  vs_gltf *g = e->state;
  if (!vs_emit_grow(e, &g->geometries, &g->geometry_room, g->geometry_count + 1, sizeof *g->geometries)) return false;
  *number = (uint32_t)g->geometry_count;
  g->geometries[g->geometry_count++] = (vs_gltf_geometry){ .first = (uint32_t)g->primitive_count };
  return true;
}

static uint32_t gltf_paint_of(const vs_emitter *e, const vs_solid *m, size_t triangle) {
  uint32_t tag = m->mesh.tags != NULL ? m->mesh.tags[triangle] : 0;
  return tag < m->part_count ? (uint32_t)vs_emit_material_number(e, m->parts[tag].material) : 0;
}

/* Returns true if two corners of the triangle are equal when rounded to 32 bits. The triangle is then only an edge, and
 * omitting it opens no gap. */
static bool gltf_is_edge(const vs_affine *place, const vs_mesh *m, const uint32_t v[3]) {
  float at[3][3];
  for (int i = 0; i < 3; i++) {
    vs_vec3 p = vs_affine_point(place, m->vertices[v[i]]);
    at[i][0] = (float)p.x + 0.0f, at[i][1] = (float)p.y + 0.0f, at[i][2] = (float)p.z + 0.0f;
  }
  return memcmp(at[0], at[1], sizeof at[0]) == 0 || memcmp(at[1], at[2], sizeof at[0]) == 0 ||
         memcmp(at[2], at[0], sizeof at[0]) == 0;
}

/* Adds a triangle with texture coordinates. It has vertices of its own, because the picture may end at its edges.
 * there: map from the vertices to the drawing, along whose axes pictures are placed. */
static bool gltf_pictured(vs_emitter *e, vs_gltf_primitive *p, const vs_vec3 at[3], const vs_vec3 normals[3],
                          const vs_affine *there, const vs_material *m) {
  vs_gltf *g = e->state;
  double metres = vs_scene_metres(e->scene);
  vs_vec3 placed[3];
  for (int k = 0; k < 3; k++) placed[k] = vs_v3_scale(vs_affine_point(there, at[k]), metres);
  vs_vec3 n = vs_v3_cross(vs_v3_sub(placed[1], placed[0]), vs_v3_sub(placed[2], placed[0]));
  int direction = vs_picture_direction(n.x, n.y, n.z);
  for (int k = 0; k < 3; k++) {
    const double xyz[] = { placed[k].x, placed[k].y, placed[k].z };
    double place[2];
    vs_picture_place(vs_pattern_size(&m->pattern), vs_pattern_height(&m->pattern), m->pattern.angle, direction, xyz,
                     place);
    unsigned char *to = gltf_room(e, &g->places, 8);
    if (to == NULL || !gltf_vertex(e, p, at[k], normals[k])) return false;
    vs_le_float(vs_le_float(to, place[0]), 1 - place[1]); /* glTF measures texture coordinates from the upper left
                                                           * corner of the picture */
  }
  return true;
}

/* Data for converting a solid to a geometry. */
typedef struct {
  vs_shaded_solid shaded;
  const vs_affine *there;      /* map from the geometry to the drawing, along whose axes pictures are placed; NULL: the
                                * solid has no picture */
  uint32_t *index;             /* array for indices, with room for the corners of all triangles */
} gltf_making;

/* Adds triangle i of a solid with texture coordinates to the primitive p. */
static bool gltf_add_pictured(vs_emitter *e, vs_gltf_primitive *p, const gltf_making *from, size_t i,
                              const vs_material *look) {
  const vs_shaded_solid *s = &from->shaded;
  vs_vec3 corners[3], normals[3];
  for (int k = 0; k < 3; k++) {
    int to = s->mirrored ? 2 - k : k;
    corners[to] = vs_shaded_point(s, i, k);
    normals[to] = vs_shaded_normal(s, i, k);
  }
  return gltf_pictured(e, p, corners, normals, from->there, look);
}

/* Adds triangle i of a solid to the primitive p, and writes the numbers of its vertices to `index`. */
static bool gltf_add_triangle(vs_emitter *e, vs_gltf_primitive *p, const vs_shaded_solid *s, size_t i,
                              uint32_t index[3]) {
  for (int k = 0; k < 3; k++) {
    uint32_t *vertex = vs_shaded_vertex(s, i, k);
    if (*vertex == VS_SHADED_NEW) {
      *vertex = p->vertex_count;
      if (!gltf_vertex(e, p, vs_shaded_point(s, i, k), vs_shaded_normal(s, i, k))) return false;
    }
    index[s->mirrored ? 2 - k : k] = *vertex;
  }
  return true;
}

/* Adds the triangles of a solid whose material has the number `paint`, as a primitive. */
static bool gltf_add_part(vs_emitter *e, gltf_making *from, uint32_t paint) {
  vs_gltf *g = e->state;
  const vs_solid *m = from->shaded.solid;
  vs_gltf_primitive *p = NULL;
  size_t count = 0;
  const vs_material *look = paint > 0 ? vs_emit_material_at(e, paint) : e->material;
  bool pictured = from->there != NULL && look != NULL && look->pattern.picture != NULL;
  vs_shaded_begin_part(&from->shaded);
  for (size_t i = 0; i < m->mesh.triangle_count; i++) {
    if (gltf_paint_of(e, m, i) != paint || gltf_is_edge(from->shaded.place, &m->mesh, m->mesh.triangles[i])) continue;
    if (p == NULL) {
      if ((p = gltf_primitive_new(e, paint)) == NULL) return false;
      p->pictured = pictured ? ++g->pictured_count : 0, p->places = g->places.count;
    }
    uint32_t *index = from->index + count;
    for (uint32_t k = 0; pictured && k < 3; k++) index[k] = p->vertex_count + k;
    if (pictured ? !gltf_add_pictured(e, p, from, i, look) : !gltf_add_triangle(e, p, &from->shaded, i, index))
      return false;
    count += 3;
  }
  return p == NULL || (vs_emit_triangles(e, count / 3) && gltf_indices(e, p, from->index, count));
}

/* Adds a solid as a geometry, and sets *number to its number. there: map from the geometry to the drawing, along whose
 * axes pictures are placed; NULL: the solid has no picture. */
static bool gltf_add_solid(vs_emitter *e, const vs_solid *m, const vs_affine *place, const vs_affine *there,
                           double crease, uint32_t *number) {
  vs_gltf *g = e->state;
  gltf_making from = { .there = there };
  size_t corners = 3 * m->mesh.triangle_count;
  if (!gltf_geometry_new(e, number)) return false;
  if (m->mesh.triangle_count > UINT32_MAX / 3)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more triangles than a glTF mesh can hold");
  bool ok = vs_shaded_make(e, m, place, crease, &from.shaded);
  if (ok) {
    from.index = vs_store_realloc(e->scene->store, NULL, 0, (corners + 1) * sizeof *from.index);
    ok = from.index != NULL || vs_emit_no_memory(e);
  }
  for (uint32_t paint = 0; ok && paint <= vs_emit_material_count(e); paint++)
    if (paint == 0 || m->part_count > 0) /* without parts, all triangles have the colour of the place at which the
                                          * geometry is used */
      ok = gltf_add_part(e, &from, paint);
  vs_emit_release(e, from.index, corners + 1, sizeof *from.index);
  vs_shaded_free(e, &from.shaded);
  vs_gltf_geometry *made = &g->geometries[*number];
  made->count = (uint32_t)g->primitive_count - made->first;
  return ok;
}

/* Adds a unit form (such as a sphere of radius 1) as a geometry, in its own coordinates. */
static bool gltf_add_form(vs_emitter *e, const vs_solid *form, double crease, uint32_t *number) {
  vs_affine here = vs_affine_identity();
  return gltf_add_solid(e, form, &here, NULL, crease, number);
}

/* ---- nodes ---- */

static bool gltf_place(vs_emitter *e, uint32_t geometry, const vs_affine *place) {
  vs_gltf *g = e->state;
  uint32_t paint = (uint32_t)vs_emit_material_number(e, e->material), mesh = g->geometries[geometry].mesh;
  if (g->geometries[geometry].count == 0) return true;
  while (mesh > 0 && g->meshes[mesh - 1].paint != paint) mesh = g->meshes[mesh - 1].next;
  if (mesh == 0) {
    if (!vs_emit_grow(e, &g->meshes, &g->mesh_room, g->mesh_count + 1, sizeof *g->meshes)) return false;
    g->meshes[g->mesh_count++] = (vs_gltf_mesh){ geometry, paint, g->geometries[geometry].mesh };
    g->geometries[geometry].mesh = mesh = (uint32_t)g->mesh_count;
  }
  if (!vs_emit_grow(e, &g->nodes, &g->node_room, g->node_count + 1, sizeof *g->nodes)) return false;
  uint32_t layer = g->open_count > 0 ? g->open_layers[g->open_count - 1] : 0;
  g->nodes[g->node_count++] = (vs_gltf_node){ mesh - 1, layer, *place };
  return true;
}

/* Adds a solid as gltf_add_solid does, but first maps it by `place` and rounds it to 32-bit numbers. there: map from
 * these coordinates to the drawing, for warnings. */
static bool gltf_add_settled(vs_emitter *e, const vs_solid *m, const vs_affine *place, const vs_affine *there,
                             double crease, uint32_t *number) {
  vs_gltf *g = e->state;
  vs_solid copy = { .parts = m->parts, .part_count = m->part_count };
  vs_affine here = vs_affine_identity();
  vs_rounded what = { 0 };
  bool ok = vs_mesh_copy(&m->mesh, &copy.mesh) || vs_emit_no_memory(e);
  if (ok) vs_mesh_transform(&copy.mesh, place);
  ok = ok && vs_emit_round(e, &copy.mesh, VS_NUMBERS_LOOSE, &what) &&
       gltf_add_solid(e, &copy, &here, there, crease, number);
  if (g->settled.met == 0) g->settled.at = vs_affine_point(there, what.at);
  if (g->settled.dropped == 0) g->settled.dropped_at = vs_affine_point(there, what.dropped_at);
  g->settled.met += what.met;
  g->settled.dropped += what.dropped;
  vs_mesh_free(&copy.mesh);
  return ok;
}

/* Returns true if n contains a picture. Pictures are placed along the drawing's axes, so the geometry of such a node is
 * valid at a single place only. */
static bool gltf_has_picture(const vs_emitter *e, const vs_node *n) {
  if (e->material != NULL && e->material->pattern.picture != NULL) return true;
  for (size_t i = vs_emit_is_painted(e, n) ? vs_emit_material_count(e) : 0; i > 0; i--)
    if (vs_emit_material_at(e, i)->pattern.picture != NULL) return true;
  return false;
}

/* Adds the triangles of the referenced node at the current placement. */
static bool gltf_shape(vs_emitter *e, const vs_ref *ref, double crease) {
  vs_gltf *g = e->state;
  bool shared = vs_affine_is_placement(&e->placement) && !gltf_has_picture(e, ref->node);
  vs_shared_place at;
  if (!vs_shared_find(e, &g->shapes, ref->node, shared, &at)) return false;
  if (!at.written) {
    const vs_solid *m = vs_emit_mesh(e, ref);
    uint32_t number;
    if (m == NULL) return false;
    if (ref->node->class_ == VS_SOLID ? !gltf_add_settled(e, m, &at.home, &at.there, crease, &number)
                                      : !gltf_add_solid(e, m, &at.home, &at.there, crease, &number))
      return false;
    if (!vs_shared_keep(e, &g->shapes, ref->node, &at, number)) return false;
  }
  return gltf_place(e, at.number, &at.there);
}

vs_emit_status vs_gltf_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_gltf *g = e->state;
  vs_unit_copy copy;
  uint32_t number;
  if (!gltf_has_picture(e, ref->node) && vs_unit_of(ref->node, &e->facets, &copy)) {
    vs_affine place = vs_affine_multiply(&e->placement, &copy.place);
    if (vs_affine_is_placement(&place))
      return vs_shared_unit(e, &g->shapes, &copy, gltf_add_form, &number) && gltf_place(e, number, &place) ? VS_EMITTED
                                                                                                         : VS_FAILED;
  }
  return gltf_shape(e, ref, vs_shade_crease(vs_lower_is_round(ref->node))) ? VS_EMITTED : VS_FAILED;
}

vs_emit_status vs_gltf_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return gltf_shape(e, ref, vs_shade_crease(true)) ? VS_WHOLE : VS_FAILED;
}

vs_emit_status vs_gltf_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_gltf *g = e->state;
  const struct vs_line *l = VS_AS(line, ref->node);
  uint32_t count = l->points->count, number;
  if (count < 2) return VS_EMITTED;
  vs_gltf_primitive *p;
  if (!gltf_geometry_new(e, &number) || (p = gltf_primitive_new(e, 0)) == NULL) return VS_FAILED;
  p->lines = true;
  vs_vec3 middle = vs_shared_line_middle(e, l);
  for (uint32_t i = 0; i < count; i++)
    if (!gltf_vertex(e, p, vs_v3_sub(vs_affine_point(&e->placement, l->points->at[i]), middle), vs_v3(0, 0, 1)))
      return VS_FAILED;
  size_t room = (size_t)count + 1;
  uint32_t *index = vs_store_realloc(e->scene->store, NULL, 0, room * sizeof *index);
  if (index == NULL) return vs_emit_no_memory(e), VS_FAILED;
  for (uint32_t i = 0; i <= count; i++) index[i] = i % count;
  bool ok = gltf_indices(e, p, index, l->closed ? room : room - 1);
  vs_emit_release(e, index, room, sizeof *index);
  g->geometries[number].count = 1;
  vs_affine there = vs_affine_translation(middle);
  return ok && gltf_place(e, number, &there) ? VS_EMITTED : VS_FAILED;
}

/* Does nothing for placements and paint, because the emitter contains them while shapes are written. A layer or part
 * remains open until the walk leaves its node. A layer within a part belongs to this part alone. */
vs_emit_status vs_gltf_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  vs_gltf *g = e->state;
  bool part = ref->node->kind == VS_PART;
  if (!part && ref->node->kind != VS_LAYER) return VS_EMITTED;
  if (phase == VS_PHASE_LEAVE) {
    g->open_count--;
    return VS_EMITTED;
  }
  const char *name = part ? VS_AS(part, ref->node)->name : VS_AS(layer, ref->node)->name;
  size_t depth = g->open_count;
  while (depth > 0 && !g->layers[g->open_layers[depth - 1] - 1].part) depth--;
  uint32_t above = depth > 0 ? g->open_layers[depth - 1] : 0, layer = 0;
  for (; layer < g->layer_count; layer++) {
    const vs_gltf_group *known = &g->layers[layer];
    if (known->part == part && known->above == above && strcmp(known->name, name) == 0) break;
  }
  if (layer == g->layer_count) {
    if (!vs_emit_grow(e, &g->layers, &g->layer_room, g->layer_count + 1, sizeof *g->layers)) return VS_FAILED;
    g->layers[g->layer_count++] = (vs_gltf_group){ name, above, part };
  }
  if (!vs_emit_grow(e, &g->open_layers, &g->open_room, g->open_count + 1, sizeof *g->open_layers)) return VS_FAILED;
  g->open_layers[g->open_count++] = layer + 1;
  return VS_EMITTED;
}
