/* Keeps bricks, boards and pictures correct on rotated objects.
 *
 * POV-Ray chooses the projection of a texture on a face by the face's normal in the scene, but rotates the texture with
 * its object. Projection and texture agree only if the placements around the material are translations. The pass
 * therefore moves every other placement around a material down by one level at a time, until it is below all such
 * materials. Bricks then follow the scene's axes and keep their size, as on web pages. Translations stay, and so does
 * most sharing of copies. */
#include "passes/lay.h"

#include "passes/rewrite.h"

static bool lies_on_faces(const vs_material *m) {
  switch (m->pattern.kind) {
  case VS_PATTERN_NONE: case VS_PATTERN_COUNT: case VS_PATTERN_MOTTLED: case VS_PATTERN_SPECKLED:
  case VS_PATTERN_VEINED: case VS_PATTERN_PEBBLED: case VS_PATTERN_RIPPLED: case VS_PATTERN_GRASSY: return false;
  case VS_PATTERN_BRICKS: case VS_PATTERN_ENGLISH: case VS_PATTERN_FLEMISH: case VS_PATTERN_ASHLAR:
  case VS_PATTERN_TILES: case VS_PATTERN_BOARDS: case VS_PATTERN_GRAIN: case VS_PATTERN_RIBBED:
  case VS_PATTERN_BRUSHED: case VS_PATTERN_PICTURE: return true;
  }
  return false;
}

/* Returns true if node n contains a material with a pattern on faces, such as bricks. */
static bool lay_is_laid(const vs_rewrite *w, const vs_node *n) {
  return vs_order_has(&w->order, n) && ((const unsigned char *)w->state)[vs_order_of(n)];
}

static bool lay_look(vs_rewrite *w) {
  unsigned char *laid = w->state;
  bool any = false;
  for (size_t k = 0; k < w->order.count; k++) {
    const vs_node *n = w->order.at[k].node;
    laid[k] = n->kind == VS_MATERIAL && lies_on_faces(VS_AS(material, n)->material);
    any |= laid[k];
    if (!w->order.note[k].inner) continue;
    for (uint32_t i = 0; i < n->child_count; i++) laid[k] |= lay_is_laid(w, n->children[i].node);
  }
  return any;
}

/* Returns a copy of the node `inner` in which the placement is around each child, instead of around `inner`. */
static vs_node *lay_inside(vs_rewrite *w, const vs_node *placement, const vs_node *inner) {
  size_t count = inner->child_count, made = 0;
  vs_ref *kids = vs_store_realloc(w->store, NULL, 0, (count + 1) * sizeof *kids);
  if (kids == NULL) return NULL;
  for (; made < count; made++) {
    kids[made] = inner->children[made];
    kids[made].node = vs_node_new(w->store, VS_TRANSFORM, vs_node_data(placement), &inner->children[made], 1);
    if (kids[made].node == NULL) break;
  }
  vs_node *done = made == count ? vs_node_new(w->store, (vs_kind)inner->kind, vs_node_data(inner), kids, count) : NULL;
  for (size_t i = 0; i < made; i++) vs_node_release(kids[i].node);
  vs_store_realloc(w->store, kids, (count + 1) * sizeof *kids, 0);
  return done;
}

static vs_node *lay_node(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  (void)origin;
  if (n->kind != VS_TRANSFORM || !lay_is_laid(w, n)) return vs_rewrite_keep(w, n, kids);
  const vs_node *kid = kids[0].node;
  if (kid->kind == VS_TRANSFORM) {
    vs_affine both = vs_affine_multiply(&VS_AS(transform, n)->matrix, &VS_AS(transform, kid)->matrix);
    w->changed++;
    return vs_node_new(w->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = both }, kid->children, 1);
  }
  bool through = kid->kind == VS_MATERIAL || kid->kind == VS_LAYER || kid->kind == VS_UNION ||
                 kid->kind == VS_INTERSECTION || kid->kind == VS_DIFFERENCE;
  if (!through || vs_affine_is_translation(&VS_AS(transform, n)->matrix)) return vs_rewrite_keep(w, n, kids);
  w->changed++;
  return lay_inside(w, n, kid);
}

bool vs_scene_lay(vs_scene *scene, vs_error *e) {
  vs_store *store = scene->store;
  for (bool again = true; again;) {
    vs_rewrite w = { .store = store, .error = e, .order = { .store = store } };
    if (!vs_order_make(&w.order, scene->drawn, scene->drawn_count, e)) return false;
    size_t room = w.order.count + 1;
    w.state = vs_store_realloc(store, NULL, 0, room);
    bool ok = w.state != NULL || vs_error_memory(e, NULL);
    if (ok && lay_look(&w)) ok = vs_rewrite_run(&w, lay_node, scene->drawn, scene->drawn_count);
    again = w.changed > 0;
    if (w.state != NULL) vs_store_realloc(store, w.state, room, 0);
    vs_order_free(&w.order);
    if (!ok) return false;
  }
  return true;
}
