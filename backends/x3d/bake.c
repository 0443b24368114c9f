/* Converts objects that no Transform can place to triangles ("baking"). A use of a template that shears or mirrors
 * becomes triangle sets, one for each material. A baked template uses only baked templates. Also finds the paints
 * (materials) of templates. */
#include "backends/x3d/bake.h"

#include "backends/x3d/x3d_collect.h"

/* ---- adding a group to another ---- */

static bool bake_append(vs_emitter *e, vs_x3d_batch *to, const vs_x3d_batch *from, const vs_affine *place) {
  bool mirrored = vs_affine_determinant(place) < 0;
  uint32_t vertex = (uint32_t)to->vertex_count, point = (uint32_t)to->point_count;
  if (to->vertex_count + from->vertex_count >= UINT32_MAX || to->point_count + from->point_count >= UINT32_MAX)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more corners than an X3D triangle set can number");
  if (!vs_emit_grow(e, &to->vertices, &to->vertex_room, to->vertex_count + from->vertex_count, sizeof *to->vertices) ||
      !vs_emit_grow(e, &to->normals, &to->normal_room, to->vertex_count + from->vertex_count, sizeof *to->normals) ||
      !vs_emit_grow(e, &to->triangles, &to->triangle_room, to->triangle_count + from->triangle_count,
                    sizeof *to->triangles) ||
      !vs_emit_grow(e, &to->points, &to->point_room, to->point_count + from->point_count, sizeof *to->points) ||
      !vs_emit_grow(e, &to->lines, &to->line_room, to->line_count + from->line_count, sizeof *to->lines))
    return false;
  for (size_t i = 0; i < from->vertex_count; i++) {
    to->vertices[to->vertex_count] = vs_affine_point(place, from->vertices[i]);
    to->normals[to->vertex_count++] = vs_affine_normal(place, from->normals[i]);
  }
  for (size_t i = 0; i < from->triangle_count; i++, to->triangle_count++)
    for (int k = 0; k < 3; k++)
      to->triangles[to->triangle_count][mirrored ? 2 - k : k] = from->triangles[i][k] + vertex;
  for (size_t i = 0; i < from->point_count; i++)
    to->points[to->point_count++] = vs_affine_point(place, from->points[i]);
  for (size_t i = 0; i < from->line_count; i++)
    to->lines[to->line_count++] = from->lines[i] == UINT32_MAX ? UINT32_MAX : from->lines[i] + point;
  return true;
}

static bool bake_items(vs_emitter *e, vs_x3d_group *g) {
  for (size_t i = 0; i < g->item_count; i++) {
    if ((i & 0xff) == 0 && !vs_emit_progress(e, "meshing", -1)) return false;
    if (!vs_x3d_bake_item(e, g, &g->items[i])) return false;
  }
  g->item_count = 0;
  return true;
}

/* Adds a baked template's triangles to the group g, mapped by the placement of `use`. */
static bool bake_use(vs_emitter *e, vs_x3d_group *g, const vs_x3d_placed *use) {
  const vs_x3d *x = e->state;
  const vs_x3d_batch *from = x->groups[use->group].batches;
  vs_x3d_batch *to = from != NULL ? vs_x3d_batches(e, g) : NULL;
  if (from != NULL && to == NULL) return false;
  for (size_t paint = 0; from != NULL && paint < x->batch_count; paint++)
    if (!bake_append(e, &to[paint > 0 ? paint : use->paint], &from[paint], &use->placement)) return false;
  return vs_emit_progress(e, "meshing", -1);
}

static bool bake_uses(vs_emitter *e, vs_x3d_group *g) {
  for (size_t i = 0; i < g->use_count; i++)
    if (!bake_use(e, g, &g->uses[i])) return false;
  g->use_count = 0;
  return true;
}

/* ---- placements that X3D lacks ---- */

/* Returns true if no Transform can express the placement of the use: it shears or mirrors (viewers turn mirrored nodes
 * inside out). Such a use, and all templates that it uses, become triangles. */
static bool bake_is_sheared(const vs_x3d_placed *use) {
  return !vs_affine_is_placement(&use->placement) || vs_affine_determinant(&use->placement) < 0;
}

/* Bakes the sheared uses of a group that is drawn itself, all of whose templates are baked. */
static bool bake_drawn(vs_emitter *e, vs_x3d_group *g) {
  size_t kept = 0;
  for (size_t i = 0; i < g->use_count; i++) {
    vs_x3d_placed use = g->uses[i];
    if (!bake_is_sheared(&use)) g->uses[kept++] = use;
    else if (!bake_use(e, g, &use)) return false;
  }
  g->use_count = kept;
  return true;
}

static bool bake_sheared(vs_emitter *e) {
  vs_x3d *x = e->state;
  bool any = false;
  for (size_t k = 0; k < x->group_count; k++)
    for (size_t i = 0; i < x->groups[k].use_count; i++) any |= bake_is_sheared(&x->groups[k].uses[i]);
  if (!any) return true;
  for (size_t k = 1; k < x->group_count && x->groups[k].part == NULL; k++)
    if (!bake_items(e, &x->groups[k]) || !bake_uses(e, &x->groups[k])) return false;
  for (size_t k = 0; k < x->group_count; k++)
    if ((k == 0 || x->groups[k].part != NULL) && !bake_drawn(e, &x->groups[k])) return false;
  return true;
}

/* ---- paints ---- */

static bool bake_paint(vs_emitter *e, vs_x3d_group *g, uint32_t paint) {
  if (!g->bare) paint = 0;
  for (size_t i = 0; i < g->paint_count; i++)
    if (g->paints[i] == paint) return true;
  if (!vs_emit_grow(e, &g->paints, &g->paint_room, g->paint_count + 1, sizeof *g->paints)) return false;
  g->paints[g->paint_count++] = paint;
  return true;
}

/* Determines the paints with which each template is used. Visits the drawing first, then its parts, then the templates
 * from the last to the first, so that a template comes after all groups that use it. */
static bool bake_paints(vs_emitter *e) {
  vs_x3d *x = e->state;
  for (size_t k = x->group_count; k > 0; k--) {
    vs_x3d_group *g = &x->groups[k % x->group_count];
    for (size_t i = 0; i < g->use_count; i++) {
      const vs_x3d_placed *use = &g->uses[i];
      bool own = use->paint > 0 || k == x->group_count || g->part != NULL;
      for (size_t p = 0; p < (own ? 1 : g->paint_count); p++)
        if (!bake_paint(e, &x->groups[use->group], own ? use->paint : g->paints[p])) return false;
    }
  }
  return true;
}

bool vs_x3d_settle(vs_emitter *e) { return bake_sheared(e) && bake_paints(e); }
