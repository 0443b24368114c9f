/* Owns the drawing as shapes: unit forms with their placement while they are few, and batches of triangles and lines a material. */
#include <math.h>
#include <string.h>

#include "backends/shade.h"
#include "backends/x3d/x3d.h"
#include "geometry/frame.h"

bool vs_x3d_open(vs_emitter *e, vs_x3d_notation notation) {
  vs_x3d *x = vs_store_realloc(e->scene->store, NULL, 0, sizeof *x);
  if (x == NULL) return vs_emit_no_memory(e);
  *x = (vs_x3d){ .notation = notation, .batch_count = vs_emit_material_count(e) + 1 };
  e->state = x;
  x->batches = vs_store_realloc(e->scene->store, NULL, 0, x->batch_count * sizeof *x->batches);
  if (x->batches == NULL) return vs_emit_no_memory(e);
  memset(x->batches, 0, x->batch_count * sizeof *x->batches);
  return true;
}

void vs_x3d_close(vs_emitter *e) {
  vs_x3d *x = e->state;
  if (x == NULL) return;
  for (size_t i = 0; x->batches != NULL && i < x->batch_count; i++) {
    vs_x3d_batch *b = &x->batches[i];
    vs_emit_release(e, b->vertices, b->vertex_room, sizeof *b->vertices);
    vs_emit_release(e, b->normals, b->normal_room, sizeof *b->normals);
    vs_emit_release(e, b->triangles, b->triangle_room, sizeof *b->triangles);
    vs_emit_release(e, b->points, b->point_room, sizeof *b->points);
    vs_emit_release(e, b->lines, b->line_room, sizeof *b->lines);
  }
  vs_emit_release(e, x->batches, x->batch_count, sizeof *x->batches);
  vs_emit_release(e, x->items, x->item_room, sizeof *x->items);
  vs_emit_release(e, x, 1, sizeof *x);
  e->state = NULL;
}

/* ---- triangles ---- */

/* Normals go by the inverse transpose, which for an affine map is the cofactors of its linear part (and its sign). */
static vs_vec3 collect_normal(const vs_affine *a, vs_vec3 n) {
  vs_vec3 c0 = vs_v3(a->m[0][0], a->m[1][0], a->m[2][0]), c1 = vs_v3(a->m[0][1], a->m[1][1], a->m[2][1]), c2 = vs_v3(a->m[0][2], a->m[1][2], a->m[2][2]);
  vs_vec3 out = vs_v3_add(vs_v3_add(vs_v3_scale(vs_v3_cross(c1, c2), n.x), vs_v3_scale(vs_v3_cross(c2, c0), n.y)), vs_v3_scale(vs_v3_cross(c0, c1), n.z));
  if (vs_affine_determinant(a) < 0) out = vs_v3_scale(out, -1);
  double length = vs_v3_length(out);
  return length > 0 ? vs_v3_scale(out, 1 / length) : n;
}

static bool collect_triangles(vs_emitter *e, const vs_solid *m, const vs_affine *place, const vs_material *material, double crease) {
  vs_x3d *x = e->state;
  const vs_mesh *mesh = &m->mesh;
  vs_shading s;
  if (!vs_shading_make(mesh->vertices, mesh->vertex_count, (const uint32_t (*)[3])mesh->triangles, mesh->triangle_count, crease, &s)) return vs_emit_no_memory(e);
  bool mirrored = vs_affine_determinant(place) < 0, ok = true;
  /* Each entry of the normals belongs to one vertex: it is the batch's vertex, and `at` is where the batch has it, per part. */
  uint32_t *at = vs_store_realloc(e->scene->store, NULL, 0, (s.normal_count + 1) * sizeof *at);
  if (at == NULL) ok = vs_emit_no_memory(e);
  size_t parts = m->part_count > 0 ? m->part_count : 1;
  for (size_t paint = 0; ok && paint < x->batch_count; paint++) {
    bool any = false;
    for (size_t part = 0; part < parts && !any; part++) {
      const vs_material *own = part < m->part_count && m->parts[part] != NULL ? m->parts[part] : material;
      any = vs_emit_material_number(e, own) == paint;
    }
    if (!any) continue;
    vs_x3d_batch *b = &x->batches[paint];
    memset(at, 0xff, (s.normal_count + 1) * sizeof *at);
    for (size_t i = 0; ok && i < mesh->triangle_count; i++) {
      uint32_t tag = mesh->tags != NULL ? mesh->tags[i] : 0;
      const vs_material *own = tag < m->part_count && m->parts[tag] != NULL ? m->parts[tag] : material;
      if (vs_emit_material_number(e, own) != paint) continue;
      ok = vs_emit_grow(e, &b->triangles, &b->triangle_room, b->triangle_count + 1, sizeof *b->triangles);
      for (int k = 0; ok && k < 3; k++) {
        uint32_t corner = s.corners[i][k];
        if (at[corner] == UINT32_MAX) {
          ok = vs_emit_grow(e, &b->vertices, &b->vertex_room, b->vertex_count + 1, sizeof *b->vertices)
            && vs_emit_grow(e, &b->normals, &b->normal_room, b->vertex_count + 1, sizeof *b->normals);
          if (!ok) break;
          b->vertices[b->vertex_count] = vs_affine_point(place, mesh->vertices[mesh->triangles[i][k]]);
          b->normals[b->vertex_count] = collect_normal(place, s.normals[corner]);
          at[corner] = (uint32_t)b->vertex_count++;
        }
        b->triangles[b->triangle_count][mirrored ? 2 - k : k] = at[corner];
      }
      if (ok) b->triangle_count++;
    }
  }
  vs_emit_release(e, at, s.normal_count + 1, sizeof *at);
  vs_shading_free(&s);
  return ok;
}

static bool collect_bake(vs_emitter *e, const vs_ref *ref, const vs_affine *place, const vs_material *material) {
  const vs_solid *m = vs_emit_mesh(e, ref);
  bool boolean = ref->node->kind == VS_INTERSECTION || ref->node->kind == VS_DIFFERENCE;
  return m != NULL && collect_triangles(e, m, place, material, boolean || vs_lower_is_round(ref->node) ? 0.6 : 0.05);
}

/* ---- unit forms ---- */

static vs_affine collect_scale(vs_vec3 by) { return (vs_affine){ { { by.x, 0, 0, 0 }, { 0, by.y, 0, 0 }, { 0, 0, by.z, 0 } } }; }

/* X3D's cylinders and cones stand on Y about the origin: Y to +Z, half the height, onto the axis. */
static vs_affine collect_on_axis(vs_vec3 base, vs_vec3 top, double radius) {
  vs_vec3 axis = vs_v3_sub(top, base);
  double half = vs_v3_length(axis) / 2;
  vs_affine frame = vs_frame_on_axis(vs_v3_scale(vs_v3_add(base, top), 0.5), axis);
  vs_affine upright = { { { radius, 0, 0, 0 }, { 0, 0, -radius, 0 }, { 0, half, 0, 0 } } };
  return vs_affine_multiply(&frame, &upright);
}

/* The unit form that the node is, and its place in the node's own coordinates; false: it is none. */
static bool collect_form(const vs_node *n, vs_x3d_form *form, vs_affine *place) {
  switch ((vs_kind)n->kind) {
  case VS_BOX: {
    const struct vs_box *b = VS_AS(box, n);
    vs_affine size = collect_scale(vs_v3_scale(vs_v3_sub(b->q, b->p), 0.5)), middle = vs_affine_translation(vs_v3_scale(vs_v3_add(b->p, b->q), 0.5));
    *form = VS_X3D_BOX;
    *place = vs_affine_multiply(&middle, &size);
    return true;
  }
  case VS_SPHERE: {
    const struct vs_sphere *s = VS_AS(sphere, n);
    vs_affine size = collect_scale(vs_v3(s->radius, s->radius, s->radius)), middle = vs_affine_translation(s->center);
    *form = VS_X3D_SPHERE;
    *place = vs_affine_multiply(&middle, &size);
    return s->segments == 0;
  }
  case VS_CYLINDER: {
    const struct vs_cylinder *c = VS_AS(cylinder, n);
    *form = VS_X3D_CYLINDER;
    *place = collect_on_axis(c->base, c->top, c->radius);
    return c->segments == 0;
  }
  case VS_CONE: {
    const struct vs_cone *c = VS_AS(cone, n);
    *form = VS_X3D_CONE;
    *place = collect_on_axis(c->base, c->apex, c->radius);
    return c->segments == 0;
  }
  case VS_SUPERELLIPSOID: case VS_HALF_SPACE: case VS_HEIGHT_FIELD: case VS_SLICE: case VS_HULL:
  case VS_E_CONE: {
    const struct vs_e_cone *c = VS_AS(e_cone, n);
    vs_affine wide = collect_scale(vs_v3(1, 1, c->base_across / c->base_radius)); /* X3D's Z is across the axis */
    *form = c->top_radius == 0 ? VS_X3D_CONE : VS_X3D_CYLINDER;
    *place = collect_on_axis(c->base, c->top, c->base_radius);
    *place = vs_affine_multiply(place, &wide);
    return c->segments == 0 && (c->top_radius == 0 || c->top_radius == c->base_radius);
  }
  case VS_EMPTY: case VS_LINE: case VS_ARC: case VS_CIRCLE: case VS_SPLINE: case VS_REGION: case VS_TEXT: case VS_WEDGE: case VS_CUT_CONE: case VS_PYRAMID:
  case VS_TORUS: case VS_POLYFACE_MESH: case VS_EXTRUDE: case VS_SWEEP: case VS_THICKEN: case VS_TRANSFORM: case VS_MATERIAL: case VS_LAYER:
  case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: case VS_KIND_COUNT:
    break;
  }
  return false;
}

/* An X3D Transform says translation, rotation and scale: the columns must be at right angles. */
static bool collect_is_placeable(const vs_affine *a) {
  vs_vec3 c[3];
  for (int i = 0; i < 3; i++) c[i] = vs_v3(a->m[0][i], a->m[1][i], a->m[2][i]);
  for (int i = 0; i < 3; i++) {
    vs_vec3 p = c[i], q = c[(i + 1) % 3];
    if (fabs(vs_v3_dot(p, q)) > 1e-9 * vs_v3_length(p) * vs_v3_length(q)) return false;
  }
  return true;
}

vs_emit_status vs_x3d_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_x3d *x = e->state;
  vs_x3d_form form;
  vs_affine place;
  if (!x->bake && collect_form(ref->node, &form, &place)) {
    place = vs_affine_multiply(&e->placement, &place);
    if (collect_is_placeable(&place)) {
      if (!vs_emit_grow(e, &x->items, &x->item_room, x->item_count + 1, sizeof *x->items)) return VS_FAILED;
      x->items[x->item_count++] = (vs_x3d_item){ *ref, e->placement, e->material, form, place };
      x->bake = x->item_count > VS_X3D_NATIVE_MAX;
      return VS_EMITTED;
    }
  }
  return collect_bake(e, ref, &e->placement, e->material) ? VS_EMITTED : VS_FAILED;
}

bool vs_x3d_finish(vs_emitter *e) {
  vs_x3d *x = e->state;
  if (!x->bake) return true;
  for (size_t i = 0; i < x->item_count; i++)
    if (!collect_bake(e, &x->items[i].ref, &x->items[i].placement, x->items[i].material)) return false;
  x->item_count = 0;
  return true;
}

vs_emit_status vs_x3d_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_x3d *x = e->state;
  const struct vs_line *l = VS_AS(line, ref->node);
  vs_x3d_batch *b = &x->batches[vs_emit_material_number(e, e->material)];
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

/* Placement and paint are the emitter's; a union's parts stand beside each other. */
vs_emit_status vs_x3d_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)e, (void)ref, (void)phase;
  return VS_EMITTED;
}

vs_emit_status vs_x3d_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return VS_EMITTED;
  return collect_bake(e, ref, &e->placement, e->material) ? VS_WHOLE : VS_FAILED;
}
