/* Converts the drawing to groups: unit forms and uses of templates with their placements, and batches of triangles and
 * lines for each material. */
#include "backends/x3d/x3d_collect.h"

#include <math.h>
#include <string.h>

#include "backends/lower.h"
#include "backends/shade.h"
#include "backends/x3d/x3d.h"
#include "geometry/shapes/unit_forms.h"

bool vs_x3d_open(vs_emitter *e, vs_x3d_notation notation) {
  vs_x3d *x = vs_store_realloc(e->scene->store, NULL, 0, sizeof *x);
  if (x == NULL) return vs_emit_no_memory(e);
  *x = (vs_x3d){ .notation = notation, .batch_count = vs_emit_material_count(e) + 1 };
  e->state = x;
  if (!vs_emit_grow(e, &x->groups, &x->group_room, 1, sizeof *x->groups)) return false;
  x->groups[x->group_count++] = (vs_x3d_group){ .bare = true };
  return true;
}

void vs_x3d_close(vs_emitter *e) {
  vs_x3d *x = e->state;
  if (x == NULL) return;
  for (size_t k = 0; k < x->group_count; k++) {
    vs_x3d_group *g = &x->groups[k];
    for (size_t i = 0; g->batches != NULL && i < x->batch_count; i++) {
      vs_x3d_batch *b = &g->batches[i];
      vs_emit_release(e, b->vertices, b->vertex_room, sizeof *b->vertices);
      vs_emit_release(e, b->normals, b->normal_room, sizeof *b->normals);
      vs_emit_release(e, b->triangles, b->triangle_room, sizeof *b->triangles);
      vs_emit_release(e, b->points, b->point_room, sizeof *b->points);
      vs_emit_release(e, b->lines, b->line_room, sizeof *b->lines);
    }
    vs_emit_release(e, g->batches, x->batch_count, sizeof *g->batches);
    vs_emit_release(e, g->items, g->item_room, sizeof *g->items);
    vs_emit_release(e, g->uses, g->use_room, sizeof *g->uses);
    vs_emit_release(e, g->paints, g->paint_room, sizeof *g->paints);
  }
  vs_emit_release(e, x->groups, x->group_room, sizeof *x->groups);
  vs_emit_release(e, x, 1, sizeof *x);
  e->state = NULL;
}

vs_x3d_batch *vs_x3d_batches(vs_emitter *e, vs_x3d_group *g) {
  const vs_x3d *x = e->state;
  if (g->batches != NULL) return g->batches;
  g->batches = vs_store_realloc(e->scene->store, NULL, 0, x->batch_count * sizeof *g->batches);
  if (g->batches != NULL) memset(g->batches, 0, x->batch_count * sizeof *g->batches);
  else vs_emit_no_memory(e);
  return g->batches;
}

static vs_x3d_group *collect_group(const vs_emitter *e) {
  const vs_x3d *x = e->state;
  return &x->groups[x->group];
}

/* ---- templates ---- */

bool vs_x3d_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  vs_x3d *x = e->state;
  x->group = open ? id : 0;
  if (!open) return true;
  if (!vs_emit_grow(e, &x->groups, &x->group_room, (size_t)id + 1, sizeof *x->groups)) return false;
  while (x->group_count <= id) x->groups[x->group_count++] = (vs_x3d_group){ .bare = vs_emit_is_bare(e, ref->node) };
  return true;
}

bool vs_x3d_use_template(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  vs_x3d_group *g = collect_group(e);
  (void)ref;
  if (!vs_emit_grow(e, &g->uses, &g->use_room, g->use_count + 1, sizeof *g->uses)) return false;
  g->uses[g->use_count++] = (vs_x3d_placed){ id, (uint32_t)vs_emit_material_number(e, e->material), e->placement };
  return true;
}

/* ---- triangles ---- */

static size_t collect_paint(const vs_emitter *e, const vs_solid *m, size_t part, uint32_t inherited) {
  return part < m->part_count && m->parts[part].material != NULL ? vs_emit_material_number(e, m->parts[part].material)
                                                                 : inherited;
}

/* Counts the triangles that are collected. More triangles may be collected than written, because the triangles of a
 * template are written once. The limit is that of combined solids. */
static bool collect_count(vs_emitter *e, size_t count) {
  vs_x3d *x = e->state;
  size_t limit = e->job->limits.mesh_triangles;
  x->collected += count;
  return !limit || x->collected / VS_ON_THE_WAY <= limit ||
         vs_error_set(e->error, VS_ERROR_LIMIT, NULL, VS_SHAPES_OVER, limit * VS_ON_THE_WAY, VS_ON_THE_WAY, limit);
}

/* Adds triangle i to a batch. */
static bool collect_triangle(vs_emitter *e, vs_x3d_batch *b, const vs_shaded_solid *s, size_t i) {
  if (!vs_emit_grow(e, &b->triangles, &b->triangle_room, b->triangle_count + 1, sizeof *b->triangles)) return false;
  for (int k = 0; k < 3; k++) {
    uint32_t *vertex = vs_shaded_vertex(s, i, k);
    if (*vertex == VS_SHADED_NEW) {
      if (!vs_emit_grow(e, &b->vertices, &b->vertex_room, b->vertex_count + 1, sizeof *b->vertices) ||
          !vs_emit_grow(e, &b->normals, &b->normal_room, b->vertex_count + 1, sizeof *b->normals))
        return false;
      b->vertices[b->vertex_count] = vs_shaded_point(s, i, k);
      b->normals[b->vertex_count] = vs_shaded_normal(s, i, k);
      *vertex = (uint32_t)b->vertex_count++;
    }
    b->triangles[b->triangle_count][s->mirrored ? 2 - k : k] = *vertex;
  }
  b->triangle_count++;
  return true;
}

/* Adds the triangles of the solid whose material has the number `paint`. inherited: material number for parts without a
 * material. */
static bool collect_painted(vs_emitter *e, vs_x3d_batch *b, vs_shaded_solid *s, size_t paint, uint32_t inherited) {
  const vs_mesh *mesh = &s->solid->mesh;
  size_t parts = s->solid->part_count > 0 ? s->solid->part_count : 1;
  bool any = false;
  for (size_t part = 0; part < parts && !any; part++) any = collect_paint(e, s->solid, part, inherited) == paint;
  if (!any) return true;
  vs_shaded_begin_part(s);
  for (size_t i = 0; i < mesh->triangle_count; i++) {
    uint32_t tag = mesh->tags != NULL ? mesh->tags[i] : 0;
    if (collect_paint(e, s->solid, tag, inherited) != paint) continue;
    if (!collect_triangle(e, b, s, i) || !vs_emit_going(e, i)) return false;
  }
  return true;
}

static bool collect_triangles(vs_emitter *e, vs_x3d_group *to, const vs_solid *m, const vs_affine *place,
                              uint32_t inherited, double crease) {
  if (!collect_count(e, m->mesh.triangle_count)) return false;
  const vs_x3d *x = e->state;
  vs_x3d_batch *batches = vs_x3d_batches(e, to);
  if (batches == NULL) return false;
  vs_shaded_solid s;
  bool ok = vs_shaded_make(e, m, place, crease, &s);
  for (size_t paint = 0; ok && paint < x->batch_count; paint++)
    ok = collect_painted(e, &batches[paint], &s, paint, inherited);
  vs_shaded_free(e, &s);
  return ok;
}

bool vs_x3d_bake_node(vs_emitter *e, vs_x3d_group *to, const vs_ref *ref, const vs_affine *place, uint32_t paint) {
  const vs_solid *m = vs_emit_mesh(e, ref);
  bool boolean = ref->node->kind == VS_INTERSECTION || ref->node->kind == VS_DIFFERENCE;
  return m != NULL &&
         collect_triangles(e, to, m, place, paint, vs_shade_crease(boolean || vs_lower_is_round(ref->node)));
}

bool vs_x3d_bake_item(vs_emitter *e, vs_x3d_group *to, const vs_x3d_item *item) {
  return vs_x3d_bake_node(e, to, &item->ref, &item->placement, item->paint);
}

static bool collect_here(vs_emitter *e, const vs_ref *ref) {
  return vs_x3d_bake_node(e, collect_group(e), ref, &e->placement, (uint32_t)vs_emit_material_number(e, e->material));
}

/* ---- unit forms ---- */

/* The axis of X3D's cylinders and cones is Y. */
bool vs_x3d_form_of(const vs_emitter *e, const vs_node *n, vs_x3d_form *form, vs_affine *place) {
  static const vs_affine upright = { { { 1, 0, 0, 0 }, { 0, 0, -1, 0 }, { 0, 1, 0, 0 } } };
  vs_unit_copy copy;
  if (!vs_unit_of(n, &e->facets, &copy) || copy.faceted) return false;
  *place = copy.place;
  switch (copy.unit) {
  case VS_UNIT_BOX: *form = VS_X3D_BOX; return true;
  case VS_UNIT_SPHERE: *form = VS_X3D_SPHERE; return true;
  case VS_UNIT_CYLINDER: *form = VS_X3D_CYLINDER; break;
  case VS_UNIT_CONE: *form = VS_X3D_CONE; break;
  case VS_UNIT_WEDGE: case VS_UNIT_COUNT: return false;
  }
  *place = vs_affine_multiply(place, &upright);
  return true;
}

vs_emit_status vs_x3d_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_x3d_group *g = collect_group(e);
  vs_x3d_form form = VS_X3D_BOX;
  vs_affine place;
  /* A form whose material has a picture must become triangles. A template may get any paint, so all materials are
   * tested. */
  for (size_t i = vs_emit_material_count(e); i > 0; i--)
    if (vs_emit_material_at(e, i)->pattern.picture != NULL) return collect_here(e, ref) ? VS_EMITTED : VS_FAILED;
  if (!vs_x3d_form_of(e, ref->node, &form, &place)) return collect_here(e, ref) ? VS_EMITTED : VS_FAILED;
  place = vs_affine_multiply(&e->placement, &place);
  if (!vs_affine_is_placement(&place)) return collect_here(e, ref) ? VS_EMITTED : VS_FAILED;
  if (!vs_emit_grow(e, &g->items, &g->item_room, g->item_count + 1, sizeof *g->items)) return VS_FAILED;
  g->items[g->item_count++] =
      (vs_x3d_item){ *ref, e->placement, (uint32_t)vs_emit_material_number(e, e->material), form };
  return VS_EMITTED;
}

vs_emit_status vs_x3d_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_line *l = VS_AS(line, ref->node);
  vs_x3d_batch *batches = vs_x3d_batches(e, collect_group(e));
  if (batches == NULL) return VS_FAILED;
  vs_x3d_batch *b = &batches[vs_emit_material_number(e, e->material)];
  uint32_t count = l->points->count, first = (uint32_t)b->point_count;
  if (count == 0) return VS_EMITTED;
  if (!vs_emit_grow(e, &b->points, &b->point_room, b->point_count + count, sizeof *b->points)
      || !vs_emit_grow(e, &b->lines, &b->line_room, b->line_count + count + 2, sizeof *b->lines))
    return VS_FAILED;
  for (uint32_t i = 0; i < count; i++) {
    b->points[b->point_count++] = vs_affine_point(&e->placement, l->points->at[i]);
    b->lines[b->line_count++] = first + i;
  }
  if (l->closed) b->lines[b->line_count++] = first;
  b->lines[b->line_count++] = UINT32_MAX;
  return VS_EMITTED;
}

/* Writes nothing for a placement, paint or union: the emitter contains placement and paint while shapes are written,
 * and the members of a union are written separately. A part gets a group of its own. */
vs_emit_status vs_x3d_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  vs_x3d *x = e->state;
  if (ref->node->kind != VS_PART || e->body != NULL) return VS_EMITTED;
  x->group = 0;
  if (phase == VS_PHASE_LEAVE) return VS_EMITTED;
  if (!vs_emit_grow(e, &x->groups, &x->group_room, x->group_count + 1, sizeof *x->groups)) return VS_FAILED;
  x->group = x->group_count;
  x->groups[x->group_count++] = (vs_x3d_group){ .bare = true, .part = VS_AS(part, ref->node)->name };
  return VS_EMITTED;
}

vs_emit_status vs_x3d_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return collect_here(e, ref) ? VS_WHOLE : VS_FAILED;
}
