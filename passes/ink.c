/* Gives a dark paint to thin objects without a material. In a picture, a pale line or letter would be invisible against
 * a pale sky.
 *
 * The pass gives a dark material to curves, flat regions and open surfaces without a material, each subtree as a whole.
 * An outer material applies to everything below it. The pass therefore skips everything below a material, and visits
 * the children of nodes that contain one. */
#include "passes/ink.h"

#include "passes/rewrite.h"

typedef struct {
  const vs_material *ink, *slate; /* ink: dark material for curves and regions; slate: a less dark material for
                                   * surfaces, so that their shading stays visible */
  unsigned char *painted;         /* painted[i]: whether node i contains a material */
} ink_state;

static bool ink_is_thin(const vs_node *n) {
  return n->class_ == VS_CURVE || n->class_ == VS_REGION_CLASS || n->class_ == VS_SURFACE;
}

static bool ink_is_painted(const vs_rewrite *w, const vs_node *n) {
  return vs_order_has(&w->order, n) && ((const ink_state *)w->state)->painted[vs_order_of(n)];
}

/* Returns true if n is thin (curve, region or surface) and contains no material, so that the pass gives one material to
 * all of it. */
static bool ink_is_whole(const vs_rewrite *w, const vs_node *n) { return ink_is_thin(n) && !ink_is_painted(w, n); }

static vs_node *ink_around(vs_rewrite *w, vs_ref thin) {
  const ink_state *s = w->state;
  struct vs_material paint = { .material = thin.node->class_ == VS_SURFACE ? s->slate : s->ink };
  w->changed++;
  return vs_node_new(w->store, VS_MATERIAL, &paint, &thin, 1);
}

/* Returns a copy of node n with the children kids, of which those that contain no material get a dark one. Returns NULL
 * if memory is out. */
static vs_node *ink_children(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  size_t count = n->child_count;
  vs_ref *inked = vs_store_realloc(w->store, NULL, 0, (count + 1) * sizeof *inked);
  size_t made = 0;
  if (!inked) return NULL;
  for (; made < count; made++) {
    const vs_node *old = n->children[made].node;
    inked[made] = kids[made];
    inked[made].node = ink_is_whole(w, old) ? ink_around(w, n->children[made]) : vs_node_retain(kids[made].node);
    if (!inked[made].node) break;
  }
  vs_node *done = made == count ? vs_rewrite_keep(w, n, inked) : NULL;
  for (size_t i = 0; i < made; i++) vs_node_release(inked[i].node);
  vs_store_realloc(w->store, inked, (count + 1) * sizeof *inked, 0);
  return done;
}

static vs_node *ink_node(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  (void)origin;
  bool gone_into = n->kind == VS_UNION || n->kind == VS_TRANSFORM || n->kind == VS_LAYER;
  /* nothing below this node changes, so it keeps its own children */
  if (!gone_into || n->class_ == VS_SOLID || ink_is_whole(w, n)) return vs_node_retain((vs_node *)(uintptr_t)n);
  return ink_children(w, n, kids);
}

static const vs_material *ink_color(vs_store *s, double red, double green, double blue, const char *name) {
  vs_material m = vs_material_of_color(red, green, blue);
  m.name = name;
  return vs_store_material(s, &m);
}

/* Computes painted[i] for each node: whether it contains a material. */
static void ink_look(vs_rewrite *w, ink_state *s) {
  for (size_t k = 0; k < w->order.count; k++) {
    const vs_node *n = w->order.at[k].node;
    s->painted[k] = n->kind == VS_MATERIAL || n->kind == VS_NATIVE;
    if (!w->order.note[k].inner) continue;
    for (uint32_t i = 0; i < n->child_count; i++) s->painted[k] |= ink_is_painted(w, n->children[i].node);
  }
}

bool vs_scene_ink(vs_scene *scene, vs_error *e) {
  bool thin = false;
  for (size_t i = 0; i < scene->drawn_count; i++) thin |= scene->drawn[i].node->class_ != VS_SOLID;
  if (!thin) return true;
  vs_store *store = scene->store;
  ink_state s = { .ink = ink_color(store, 0.05, 0.055, 0.07, "ink"),
                  .slate = ink_color(store, 0.34, 0.38, 0.44, "slate") };
  vs_rewrite w = { .store = store, .error = e, .state = &s, .order = { .store = store } };
  bool ok = ((s.ink && s.slate) || vs_error_memory(e, NULL)) &&
            vs_order_make(&w.order, scene->drawn, scene->drawn_count, e);
  size_t room = w.order.count + 1;
  if (ok) ok = (s.painted = vs_store_realloc(store, NULL, 0, room)) != NULL || vs_error_memory(e, NULL);
  if (ok) ink_look(&w, &s);
  for (size_t i = 0; ok && i < scene->drawn_count; i++) { /* gives each drawn object that contains no material one
                                                           * material as a whole; nothing below such an object
                                                           * changes */
    vs_ref *drawn = &scene->drawn[i];
    if (!ink_is_whole(&w, drawn->node)) continue;
    vs_node *inked = ink_around(&w, *drawn);
    if (!inked) ok = vs_error_memory(e, NULL);
    else vs_node_release(drawn->node), drawn->node = inked;
  }
  ok = ok && vs_rewrite_run(&w, ink_node, scene->drawn, scene->drawn_count);
  if (s.painted) vs_store_realloc(store, s.painted, room, 0);
  vs_order_free(&w.order);
  return ok;
}
