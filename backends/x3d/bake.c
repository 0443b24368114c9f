/* Chooses the objects that become triangles, and converts them ("baking").
 *
 * Each use of a template adds Shapes, which a viewer draws one by one. If the number of Shapes is too large, repeated
 * stretches of the drawing become templates (repeats.c). While it is still too large, templates are baked, the
 * innermost first (their numbers are the smallest). Baking turns all forms of a template into triangle sets, one for
 * each material, in the template's coordinates. After all templates, the drawing's own forms are baked, and finally the
 * drawing's uses of templates. A baked template uses only baked templates. */
#include "backends/x3d/bake.h"

#include "backends/x3d/repeats.h"
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

/* Adds a baked template's triangles to the group g, moved to the place where the template is used. */
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

/* ---- counting Shapes ---- */

static double bake_own(const vs_x3d *x, const vs_x3d_group *g) {
  double shapes = (double)g->item_count;
  for (size_t i = 0; g->batches != NULL && i < x->batch_count; i++)
    shapes += (g->batches[i].triangle_count > 0) + (g->batches[i].point_count > 0);
  return shapes;
}

/* Returns the number of Shapes of the entire drawing. Sets shapes[k] to the number of Shapes for each use of template
 * k. Templates use only earlier templates. */
static double bake_count(const vs_x3d *x, double *shapes) {
  for (size_t k = 1; k <= x->group_count; k++) {
    const vs_x3d_group *g = &x->groups[k % x->group_count];
    double all = bake_own(x, g);
    for (size_t i = 0; i < g->use_count; i++) all += shapes[g->uses[i].group];
    shapes[k % x->group_count] = all;
  }
  return shapes[0];
}

/* Returns true if no Transform can express the placement of the use: it shears or mirrors (viewers turn mirrored nodes
 * inside out). Such a use, and all templates that it uses, become triangles regardless of the number of Shapes. */
static bool bake_is_sheared(const vs_x3d_placed *use) {
  return !vs_affine_is_placement(&use->placement) || vs_affine_determinant(&use->placement) < 0;
}

static bool bake_sheared(vs_emitter *e) {
  vs_x3d *x = e->state;
  bool any = false;
  for (size_t k = 0; k < x->group_count; k++)
    for (size_t i = 0; i < x->groups[k].use_count; i++) any |= bake_is_sheared(&x->groups[k].uses[i]);
  if (!any) return true;
  for (size_t k = 1; k < x->group_count; k++)
    if (!bake_items(e, &x->groups[k]) || !bake_uses(e, &x->groups[k])) return false;
  size_t kept = 0;
  for (size_t i = 0; i < x->groups[0].use_count; i++) {
    vs_x3d_placed use = x->groups[0].uses[i];
    if (!bake_is_sheared(&use)) x->groups[0].uses[kept++] = use;
    else if (!bake_use(e, &x->groups[0], &use)) return false;
  }
  x->groups[0].use_count = kept;
  return true;
}

/* Returns the approximate number of bytes of a form as triangles, with this many facets in a full turn. It counts
 * corners with their normals, and three numbers for each triangle. */
double vs_x3d_form_bytes(vs_x3d_form form, double facets) {
  switch (form) {
  case VS_X3D_BOX: break;
  case VS_X3D_SPHERE: return 40 * facets * facets;
  case VS_X3D_CYLINDER: case VS_X3D_CONE: return 200 * facets;
  }
  return 1100;
}

/* Estimates the bytes of all baked forms, with `least` facets in a full turn, or more if the drawing's tolerance
 * requires it. */
static bool bake_estimate(vs_emitter *e, int least, double *bytes) {
  const vs_x3d *x = e->state;
  *bytes = 0;
  for (size_t k = 0; k < x->group_count; k++)
    for (size_t i = 0; i < x->groups[k].item_count; i++) {
      if ((i & 0xfff) == 0 && !vs_emit_progress(e, "meshing", -1)) return false;
      const vs_x3d_item *item = &x->groups[k].items[i];
      *bytes += vs_x3d_form_bytes(item->form, vs_x3d_facets(e, item, least));
    }
  return true;
}

/* Chooses coarser facets if there are very many forms. Tens of thousands of forms would be hundreds of megabytes,
 * which take a browser minutes, and each form is small in the picture. A number of facets that the user set does not
 * change. */
static bool bake_coarsely(vs_emitter *e) {
  static const int least[] = { 32, 16, 12, VS_X3D_COARSEST };
  vs_x3d *x = e->state;
  size_t i = 0;
  double bytes;
  if (e->drawing_facets.segments > 0) return true;
  for (; i + 1 < sizeof least / sizeof *least; i++) {
    if (!bake_estimate(e, least[i], &bytes)) return false;
    if (bytes <= VS_X3D_BAKED_MOST) break;
  }
  x->least = i > 0 ? least[i] : 0;
  return i == 0 ||
         vs_emit_warn_once(e, NULL,
                           "the drawing has so many shapes that small round shapes get fewer facets in this format; to "
                           "keep all facets, make a repeated part once and place it several times");
}

double vs_x3d_batch_bytes(const vs_x3d *x, const vs_x3d_group *g) {
  double bytes = 0;
  for (size_t i = 0; g->batches != NULL && i < x->batch_count; i++) {
    const vs_x3d_batch *b = &g->batches[i];
    bytes += 40.0 * (double)b->vertex_count + 20.0 * (double)b->triangle_count + 30.0 * (double)b->point_count;
  }
  return bytes;
}

/* Replaces the drawing's uses of baked templates by triangles, beginning with those that need the least text for each
 * saved Shape. Stops when there are few Shapes, or the text is long. A use whose triangles cost more than a Shape
 * remains a use. */
static bool bake_cheapest(vs_emitter *e, const double *shapes, double many) {
  vs_x3d *x = e->state;
  vs_x3d_group *g = &x->groups[0];
  double *price = vs_store_realloc(e->scene->store, NULL, 0, x->group_count * sizeof *price);
  if (price == NULL) return vs_emit_no_memory(e);
  double most = VS_X3D_BAKED_MOST, bytes = 0;
  bool ok = true;
  for (size_t k = 0; k < x->group_count; k++) price[k] = vs_x3d_batch_bytes(x, &x->groups[k]);
  /* `limit` is the number of bytes of triangles that may replace a Shape */
  for (double limit = VS_X3D_SHAPE_BYTES / 128; ok && limit <= VS_X3D_SHAPE_BYTES && many > VS_X3D_NATIVE_MAX;
       limit *= 2) {
    size_t kept = 0;
    bool dearer = false;
    for (size_t i = 0; ok && i < g->use_count; i++) {
      vs_x3d_placed use = g->uses[i];
      bool cheap = price[use.group] <= limit * shapes[use.group];
      dearer |= !cheap;
      if (!cheap || many <= VS_X3D_NATIVE_MAX || bytes + price[use.group] > most) {
        g->uses[kept++] = use;
        continue;
      }
      bytes += price[use.group];
      many -= shapes[use.group];
      ok = bake_use(e, g, &use);
    }
    g->use_count = kept;
    if (!dearer) break;
  }
  vs_emit_release(e, price, x->group_count, sizeof *price);
  return ok;
}

static bool bake_until_few(vs_emitter *e, double *shapes) {
  vs_x3d *x = e->state;
  bool few = bake_count(x, shapes) <= VS_X3D_NATIVE_MAX;
  for (size_t k = 1; !few && k < x->group_count; k++) {
    if (!bake_items(e, &x->groups[k]) || !bake_uses(e, &x->groups[k])) return false;
    /* Counting takes time in proportion to the number of templates. If there are many templates, it is therefore not
     * done after each of them. */
    if (k % (x->group_count / 64 + 1) == 0 || k + 1 == x->group_count) few = bake_count(x, shapes) <= VS_X3D_NATIVE_MAX;
  }
  if (few) return true;
  if (!bake_items(e, &x->groups[0])) return false;
  double many = bake_count(x, shapes);
  return many <= VS_X3D_NATIVE_MAX || bake_cheapest(e, shapes, many);
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

/* Gives each template the paints of its uses. Visits users before the templates that they use: the drawing, then the
 * templates from the last to the first. */
static bool bake_paints(vs_emitter *e) {
  vs_x3d *x = e->state;
  for (size_t k = x->group_count; k > 0; k--) {
    vs_x3d_group *g = &x->groups[k % x->group_count];
    for (size_t i = 0; i < g->use_count; i++) {
      const vs_x3d_placed *use = &g->uses[i];
      bool own = use->paint > 0 || k == x->group_count;
      for (size_t p = 0; p < (own ? 1 : g->paint_count); p++)
        if (!bake_paint(e, &x->groups[use->group], own ? use->paint : g->paints[p])) return false;
    }
  }
  return true;
}

/* Returns an array with a number for each group, which bake_count sets. */
static double *bake_room(vs_emitter *e) {
  const vs_x3d *x = e->state;
  double *shapes = vs_store_realloc(e->scene->store, NULL, 0, x->group_count * sizeof *shapes);
  if (shapes == NULL) vs_emit_no_memory(e);
  return shapes;
}

static bool bake_too_many(vs_emitter *e, bool *many) {
  const vs_x3d *x = e->state;
  double *shapes = bake_room(e);
  if (shapes == NULL) return false;
  *many = bake_count(x, shapes) > VS_X3D_NATIVE_MAX;
  vs_emit_release(e, shapes, x->group_count, sizeof *shapes);
  return true;
}

static bool bake_many(vs_emitter *e) {
  const vs_x3d *x = e->state;
  if (!vs_x3d_repeats(e) || !bake_coarsely(e)) return false;
  double *shapes = bake_room(e);
  bool ok = shapes != NULL && bake_until_few(e, shapes);
  if (shapes != NULL) vs_emit_release(e, shapes, x->group_count, sizeof *shapes);
  return ok;
}

bool vs_x3d_settle(vs_emitter *e) {
  bool many = false;
  return bake_sheared(e) && bake_too_many(e, &many) && (!many || bake_many(e)) && bake_paints(e);
}
