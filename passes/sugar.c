/* Removes nodes of level SUGAR, such as ghosts and highlights. A walk first collects the nodes that are to be shown in
 * addition to the drawing. Then a pass replaces the remaining nodes of this level by their children.
 *
 * The walk follows every path to such a node, because each placement counts, and visits nothing else. If a drawing
 * shares a ghost so often that there would be more than MARKS_MOST ghosts, it keeps the first MARKS_MOST. */
#include "passes/sugar.h"

#include <stdio.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "passes/rewrite.h"

enum { MARKS_MOST = 4096, STEPS_MOST = 1 << 22 };

typedef struct {
  vs_ref ref;
  uint32_t next;
  vs_affine placed;
  const vs_material *material; /* innermost material on the path to the current node, or NULL */
  bool cut; /* true if the current node is subtracted, or if other nodes cut it */
} sugar_level;

typedef struct {
  vs_store *store;
  const vs_sugar_options *options;
  vs_error *error;
  sugar_level *levels;
  size_t depth, room;
  vs_ref *found; /* nodes that are to be shown in addition to the drawing; the walk holds a reference to each */
  size_t count, found_room;
} sugar_walk;

static bool sugar_memory(const sugar_walk *w) { return vs_error_memory(w->error, NULL); }

static bool sugar_push(sugar_walk *w, sugar_level level) {
  if (w->depth == w->room) {
    size_t room = w->room ? 2 * w->room : 64;
    sugar_level *grown = vs_store_realloc(w->store, w->levels, w->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return sugar_memory(w);
    w->levels = grown;
    w->room = room;
  }
  w->levels[w->depth++] = level;
  return true;
}

/* Adds a node that is to be shown in addition to the drawing. Takes over the caller's reference to it. Returns false if
 * memory is out. */
static bool sugar_found(sugar_walk *w, vs_node *node, const vs_origin *origin) {
  if (node && w->count == w->found_room) {
    size_t room = w->found_room ? 2 * w->found_room : 16;
    vs_ref *grown = vs_store_realloc(w->store, w->found, w->found_room * sizeof *grown, room * sizeof *grown);
    if (!grown) {
      vs_node_release(node);
      return sugar_memory(w);
    }
    w->found = grown;
    w->found_room = room;
  }
  if (!node) return sugar_memory(w);
  w->found[w->count++] = (vs_ref){ node, origin };
  return true;
}

/* Returns the node inside the material and the placement. Takes over the caller's reference to the node. Returns NULL
 * if memory is out, or if the node is NULL. */
static vs_node *sugar_around(vs_store *s, vs_node *node, const vs_origin *origin, const vs_material *material,
                              const vs_affine *placed) {
  if (node && material) {
    vs_node *painted =
        vs_node_new(s, VS_MATERIAL, &(struct vs_material){ .material = material }, &(vs_ref){ node, origin }, 1);
    vs_node_release(node);
    node = painted;
  }
  bool still = vs_affine_is_translation(placed) && placed->m[0][3] == 0 && placed->m[1][3] == 0 && placed->m[2][3] == 0;
  if (node && !still) {
    vs_node *moved =
        vs_node_new(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = *placed }, &(vs_ref){ node, origin }, 1);
    vs_node_release(node);
    node = moved;
  }
  return node;
}

/* ---- removal of materials from an object that is shown in a single colour ---- */

static vs_node *sugar_bare(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  if (n->kind == VS_GHOST) return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
  if (!vs_node_is_wrapper(n) || n->kind == VS_LAYER) return vs_rewrite_keep(w, n, kids);
  *origin = kids[0].origin;
  return vs_node_retain(kids[0].node);
}

static vs_node *sugar_strip(sugar_walk *w, vs_ref ref) {
  vs_rewrite r = { .store = w->store, .error = w->error };
  vs_node_retain(ref.node);
  if (vs_rewrite_alone(&r, sugar_bare, &ref, 1)) return ref.node;
  vs_node_release(ref.node);
  return NULL;
}

/* ---- the walk ---- */

/* Changes *placed so that n is scaled about its middle. A mark must not have the faces of its object, or of the hole in
 * its place: where faces coincide, they hide each other in part. */
static bool sugar_resize(const sugar_walk *w, const vs_node *n, double factor, vs_affine *placed) {
  vs_bounds b;
  if (!vs_node_bounds(n, &b, w->error)) return false;
  if (vs_bounds_is_empty(&b) || !isfinite(vs_bounds_diagonal(&b))) return true;
  vs_affine resized = vs_affine_scaling(vs_v3_scale(vs_v3_add(b.min, b.max), 0.5), vs_v3(factor, factor, factor));
  *placed = vs_affine_multiply(placed, &resized);
  return true;
}

static bool sugar_mark(sugar_walk *w, const sugar_level *at, bool ghost) {
  static const double colors[2][3] = { { .86, .16, .12 }, { .55, .58, .62 } };
  vs_mark_style how = ghost ? w->options->ghosts : w->options->highlights;
  vs_ref child = at->ref.node->children[0];
  vs_affine placed = at->placed;
  if (w->count >= MARKS_MOST) return true;
  vs_node *bare = sugar_strip(w, child);
  if (!bare) return false;
  if (how == VS_MARKS_KEEP) { /* collects the ghost, which is shown in addition to the drawing */
    vs_node *kept = vs_node_new(w->store, VS_GHOST, NULL, &(vs_ref){ bare, child.origin }, 1);
    vs_node_release(bare);
    if (!kept) return sugar_memory(w);
    vs_node *whole = sugar_around(w->store, kept, at->ref.origin, NULL, &placed);
    return sugar_found(w, whole, at->ref.origin);
  }
  vs_material look = vs_material_of_color(colors[ghost][0], colors[ghost][1], colors[ghost][2]);
  look.transparency = 0.7;
  look.ior = 1; /* the transparent material of highlights and ghosts does not bend light */
  const vs_material *m = vs_store_material(w->store, &look);
  bool ok = (m || sugar_memory(w)) && (ghost || sugar_resize(w, bare, 0.999, &placed));
  if (ok) return sugar_found(w, sugar_around(w->store, bare, child.origin, m, &placed), at->ref.origin);
  vs_node_release(bare);
  return false;
}

/* Collects an object that breaks a rule: in red, and a thousandth larger, so that its faces cover those of the object
 * in the drawing. */
static bool sugar_fault(sugar_walk *w, vs_ref fault) {
  vs_affine placed = vs_affine_identity();
  vs_node *bare = sugar_strip(w, fault);
  if (!bare) return false;
  if (w->options->faults == VS_MARKS_KEEP) {
    vs_node *kept = vs_node_new(w->store, VS_GHOST, NULL, &(vs_ref){ bare, fault.origin }, 1);
    vs_node_release(bare);
    return sugar_found(w, kept, fault.origin);
  }
  vs_material look = vs_material_of_color(.86, .1, .08);
  look.transparency = 0.5;
  look.ior = 1;
  const vs_material *m = vs_store_material(w->store, &look);
  if ((m || sugar_memory(w)) && sugar_resize(w, bare, 1.001, &placed))
    return sugar_found(w, sugar_around(w->store, bare, fault.origin, m, &placed), fault.origin);
  vs_node_release(bare);
  return false;
}

/* Removes materials, parts and ghosts from the objects that break a rule, for formats that mark these themselves. */
static bool sugar_plain_faults(sugar_walk *w, vs_scene *scene) {
  for (size_t i = 0; i < scene->fault_count; i++) {
    vs_node *bare = sugar_strip(w, scene->faults[i]);
    if (!bare) return false;
    vs_node_release(scene->faults[i].node);
    scene->faults[i].node = bare;
  }
  return true;
}

/* Walks through the nodes below the drawn object `root` and collects nodes: if `only` is true, the children of nodes of
 * kind VS_ONLY; otherwise highlights and ghosts. */
static bool sugar_below(sugar_walk *w, vs_ref root, bool only) {
  size_t steps = 0;
  w->depth = 0;
  if (!(root.node->flags & VS_NODE_SUGAR)) return true;
  if (!sugar_push(w, (sugar_level){ .ref = root, .placed = vs_affine_identity() })) return false;
  while (w->depth) {
    sugar_level *top = &w->levels[w->depth - 1];
    const vs_node *n = top->ref.node;
    if (top->next == 0) {
      if (only && n->kind == VS_ONLY) {
        vs_ref inner = n->children[0];
        sugar_level at = *top;
        w->depth--;
        vs_node_retain(inner.node);
        if (!sugar_found(w, sugar_around(w->store, inner.node, inner.origin, at.material, &at.placed), at.ref.origin))
          return false;
        continue; /* a VS_ONLY node inside another VS_ONLY node has no effect */
      }
      bool ghost = n->kind == VS_GHOST,
           marked = (ghost && w->options->ghosts != VS_MARKS_DROP) ||
                    (n->kind == VS_HIGHLIGHT && top->cut && w->options->highlights == VS_MARKS_PAINT);
      if (!only && marked && !sugar_mark(w, top, ghost)) return false;
      if (ghost) { /* skips the children of a ghost, which are shown with the ghost and belong to no other object */
        w->depth--;
        continue;
      }
    }
    if (top->next == n->child_count || ++steps > STEPS_MOST) {
      w->depth--;
      continue;
    }
    uint32_t i = top->next++;
    if (!(n->children[i].node->flags & VS_NODE_SUGAR)) continue;
    sugar_level below = { .ref = n->children[i], .placed = top->placed, .material = top->material, .cut = top->cut };
    if (n->kind == VS_TRANSFORM) below.placed = vs_affine_multiply(&top->placed, &VS_AS(transform, n)->matrix);
    if (n->kind == VS_MATERIAL) below.material = VS_AS(material, n)->material;
    if (n->kind == VS_INTERSECTION || (n->kind == VS_DIFFERENCE && i)) below.cut = true;
    if (!sugar_push(w, below)) return false;
  }
  return true;
}

/* ---- the pass ---- */

/* Returns true if n is native text for the program whose format is being written. */
static bool sugar_speaks(const vs_sugar_options *o, const vs_node *n) {
  const char *target = VS_AS(native, n)->target;
  size_t i = 0;
  if (!o->target) return false;
  while (target[i] && target[i] == o->target[i]) i++;
  return target[i] == o->target[i];
}

/* Returns true if the text only keeps its child from casting a shadow. It is written for untrusted models, too. */
static bool sugar_shadowless(const vs_node *n) { return strcmp(VS_AS(native, n)->code, "no_shadow") == 0; }

static vs_node *sugar_node(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  const vs_sugar_options *o = w->state;
  bool unwrap = false;
  if (n->kind == VS_CUSTOM) unwrap = n->child_count == 1;
  if (n->kind == VS_ONLY) unwrap = true;
  if (n->kind == VS_PART) unwrap = !o->keeps_parts;
  if (n->kind == VS_HIGHLIGHT) unwrap = o->highlights != VS_MARKS_KEEP;
  if (n->kind == VS_NATIVE)
    unwrap = ((o->muted && !sugar_shadowless(n)) || !sugar_speaks(o, n)) &&
             !(o->keeps_text && kids[0].node->kind == VS_EMPTY);
  if (n->kind == VS_GHOST) return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
  if (!unwrap) return vs_rewrite_keep(w, n, kids);
  *origin = n->kind == VS_CUSTOM ? NULL : kids[0].origin; /* the origin of an object of define-primitive is the user's
                                                           * call, not the call inside the definition */
  return vs_node_retain(kids[0].node);
}

/* The kinds of SUGAR nodes that a drawing contains. only: true if it contains VS_ONLY nodes; native: the first native
 * text for the program of the format */
typedef struct { const vs_sugar_options *options; bool only; vs_ref native; } sugar_kinds;

/* Handles native text for another program that has no replacement for this format: warns that the output does not
 * contain it, or fails if the option `strict` is set. */
static bool sugar_lacks(const sugar_kinds *k, vs_ref ref, vs_error *e) {
  const vs_sugar_options *o = k->options;
  const vs_node *n = ref.node;
  char message[240];
  if (!o->output || n->children[0].node->kind != VS_EMPTY || (sugar_speaks(o, n) && !o->muted)) return true;
  snprintf(message, sizeof message,
           "native: this text is for %.20s alone; %.20s is written without it (#:otherwise gives other formats "
           "something to show)",
           VS_AS(native, n)->target, o->output);
  if (o->strict) return vs_error_set(e, VS_ERROR_MODEL, ref.origin, "%s", message);
  vs_job_warn(o->job, ref.origin, message);
  return true;
}

static bool sugar_look(sugar_kinds *k, const vs_scene *scene, vs_error *e) {
  vs_order o = { .store = scene->store };
  if (!vs_order_make(&o, scene->drawn, scene->drawn_count, e)) return false;
  bool ok = true;
  for (size_t i = 0; ok && i < o.count; i++) {
    k->only |= o.at[i].node->kind == VS_ONLY;
    if (o.at[i].node->kind == VS_NATIVE) ok = sugar_lacks(k, o.at[i], e);
    if (!k->native.node && o.at[i].node->kind == VS_NATIVE && sugar_speaks(k->options, o.at[i].node) &&
        !sugar_shadowless(o.at[i].node))
      k->native = o.at[i];
  }
  vs_order_free(&o);
  return ok;
}

/* Replaces the scene's drawn objects by the collected nodes, and takes over the references to these. */
static void sugar_take(vs_scene *scene, sugar_walk *w) {
  for (size_t i = 0; i < scene->drawn_count; i++) vs_node_release(scene->drawn[i].node);
  vs_store_realloc(scene->store, scene->drawn, scene->drawn_room * sizeof *scene->drawn, 0);
  scene->drawn = w->found;
  scene->drawn_count = w->count;
  scene->drawn_room = w->found_room;
  w->found = NULL;
  w->count = w->found_room = 0;
}

bool vs_scene_sugar(vs_scene *scene, const vs_sugar_options *options, vs_error *e) {
  sugar_walk w = { .store = scene->store, .options = options, .error = e };
  sugar_kinds kinds = { .options = options };
  bool sugar = false, ok = true;
  for (size_t i = 0; i < scene->drawn_count; i++) sugar |= (scene->drawn[i].node->flags & VS_NODE_SUGAR) != 0;
  bool faults = options->faults != VS_MARKS_DROP && scene->fault_count;
  if (options->faults == VS_MARKS_DROP && !sugar_plain_faults(&w, scene)) return false;
  if (!sugar && !faults) return true;
  ok = sugar_look(&kinds, scene, e);
  if (ok && options->muted && kinds.native.node)
    vs_job_warn(options->job, kinds.native.origin,
                "native: text for other programs is switched off here; the object of #:otherwise is drawn");
  for (size_t i = 0; ok && kinds.only && i < scene->drawn_count; i++) ok = sugar_below(&w, scene->drawn[i], true);
  if (ok && w.count) { /* a VS_ONLY node inside a ghost has no effect */
    vs_job_warn(options->job, w.found[0].origin, "only: nothing else of the drawing is shown");
    sugar_take(scene, &w);
  }
  size_t before = scene->drawn_count;
  for (size_t i = 0; ok && i < before; i++) ok = sugar_below(&w, scene->drawn[i], false);
  for (size_t i = 0; ok && faults && i < scene->fault_count; i++) ok = sugar_fault(&w, scene->faults[i]);
  vs_sugar_options all = *options;
  vs_rewrite r = { .store = scene->store, .error = e, .state = &all };
  ok = ok && (!sugar || vs_rewrite_alone(&r, sugar_node, scene->drawn, before));
  for (size_t i = 0; ok && i < w.count; i++) ok = vs_scene_draw(scene, w.found[i]) || vs_error_memory(e, NULL);
  for (size_t i = 0; i < w.count; i++) vs_node_release(w.found[i].node);
  vs_store_realloc(w.store, w.found, w.found_room * sizeof *w.found, 0);
  vs_store_realloc(w.store, w.levels, w.room * sizeof *w.levels, 0);
  return ok;
}
