/* Moves looks (materials and layers) out of flat sets, so that each part of a region keeps its material and its layer.
 *
 * A format makes a single region of a difference of regions, and a region has a single look. The pass therefore moves
 * looks out of the set: (a + b in red) - c becomes (a - c) + (b - c) in red. It divides the operand with looks into
 * parts, each with its placements and its looks. Parts of equal look stay together, so a set becomes as many sets as it
 * has looks. In a difference, the divided operand is the first operand. In an intersection, it is the first operand
 * with a look, so the earlier look applies to the common part. An offset, a hull and a filled curve are new outlines,
 * and have the look of their first part.
 *
 * A union does not change: the driver shows its members one by one if they contain a look.
 *
 * Cost: proportional to the number of nodes, plus the parts of each set with looks. */
#include "passes/looks.h"

#include "model/store/nodemap.h"
#include "passes/rewrite.h"

/* A look: the material or layer `wrapper` inside the look number `above`; look 0 has neither. first, last: list of the
 * parts with this look, linked by their member `next`. */
typedef struct { uint32_t above; const vs_node *wrapper; uint32_t first, last; } looks_look;
typedef struct { uint32_t look, next; vs_ref ref; } looks_part;         /* A part of an operand without its material
                                                                         * and layer. look: number of its look; next:
                                                                         * index of the next part with this look;
                                                                         * ref: its node, to which this entry holds a
                                                                         * reference. */
typedef struct { uint32_t look; vs_affine placed; vs_ref ref; } looks_step; /* An operand, or a node in it, that must
                                                                             * still be divided into parts. look: number
                                                                             * of the look around it; placed: product of
                                                                             * the placements around it. */

#define NO_PART UINT32_MAX

typedef struct {
  vs_store *store;
  vs_error *error;
  unsigned char *looked; /* looked[i]: whether old node i contains a material or layer */
  vs_nodemap made;        /* new nodes that contain a material or layer; the materials and layers themselves are not
                           * entered */
  looks_look *looks;
  size_t look_count, look_room;
  looks_part *parts;
  size_t part_count, part_room;
  looks_step *steps;
  size_t step_count, step_room;
} looks_state;

static bool is_look(const vs_node *n) { return n->kind == VS_MATERIAL || n->kind == VS_LAYER; }

/* ---- which nodes have looks ---- */

static bool had_look(const vs_rewrite *w, const vs_node *old) {
  return vs_order_has(&w->order, old) && ((const looks_state *)w->state)->looked[vs_order_of(old)];
}

static bool is_outlined(const vs_node *n) { /* Returns true if n is an outline that is computed from other outlines: an
                                             * offset, a hull or a filled curve. */
  return n->kind == VS_OFFSET || n->kind == VS_REGION || (n->kind == VS_HULL && n->class_ == VS_REGION_CLASS);
}

static bool is_cut_region(const vs_node *n) {
  return n->class_ == VS_REGION_CLASS && (n->kind == VS_DIFFERENCE || n->kind == VS_INTERSECTION);
}

/* Returns true if the node contains a material or layer that is drawn. The material or layer of a profile does not
 * apply to the object made from the profile. */
static bool look_within(const vs_rewrite *w, const vs_node *n) {
  if (is_look(n)) return true;
  bool first = is_outlined(n) || n->kind == VS_DIFFERENCE;
  bool through = first || vs_node_is_set(n) || n->kind == VS_TRANSFORM;
  bool found = false;
  for (uint32_t i = 0; through && !found && i < (first && n->child_count ? 1 : n->child_count); i++)
    found = had_look(w, n->children[i].node);
  return found;
}

static bool has_look(const looks_state *s, const vs_node *new) {
  return is_look(new) || vs_nodemap_get(&s->made, new);
}

/* ---- looks and parts ---- */

static bool same_wrapper(const vs_node *a, const vs_node *b) {
  if (a->kind != b->kind) return false;
  return a->kind == VS_LAYER ? VS_AS(layer, a)->name == VS_AS(layer, b)->name
                             : VS_AS(material, a)->material == VS_AS(material, b)->material;
}

/* Sets *out to the number of the look that has this wrapper inside the look number `above`. Adds the look if it is new.
 * Returns false if memory is out. */
static bool find_look(looks_state *s, uint32_t above, const vs_node *wrapper, uint32_t *out) {
  for (size_t i = s->look_count; i-- > 1;)
    if (s->looks[i].above == above && same_wrapper(s->looks[i].wrapper, wrapper)) return *out = (uint32_t)i, true;
  if (!vs_store_grow(s->store, &s->looks, &s->look_room, s->look_count + 1, sizeof *s->looks)) return false;
  s->looks[*out = (uint32_t)s->look_count++] = (looks_look){ above, wrapper, NO_PART, NO_PART };
  return true;
}

static bool add_step(looks_state *s, looks_step step) {
  if (!vs_store_grow(s->store, &s->steps, &s->step_room, s->step_count + 1, sizeof *s->steps)) return false;
  s->steps[s->step_count++] = step;
  return true;
}

/* Adds the part of `at`, with its placement, to the end of the list of parts with its look. Returns false if memory is
 * out. */
static bool add_part(looks_state *s, const looks_step *at) {
  vs_ref ref = at->ref;
  bool still = vs_affine_is_translation(&at->placed) && at->placed.m[0][3] == 0 && at->placed.m[1][3] == 0 &&
               at->placed.m[2][3] == 0;
  if (!vs_store_grow(s->store, &s->parts, &s->part_room, s->part_count + 1, sizeof *s->parts)) return false;
  ref.node = still ? vs_node_retain(ref.node)
                   : vs_node_new(s->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = at->placed }, &ref, 1);
  if (!ref.node) return false;
  uint32_t number = (uint32_t)s->part_count++;
  s->parts[number] = (looks_part){ at->look, NO_PART, ref };
  looks_look *look = &s->looks[at->look];
  if (look->first == NO_PART) look->first = number;
  else s->parts[look->last].next = number;
  look->last = number;
  return true;
}

static void forget_parts(looks_state *s) {
  for (size_t i = 0; i < s->part_count; i++) vs_node_release(s->parts[i].ref.node);
  s->part_count = s->step_count = 0;
}

/* Divides an operand into its parts, in order, and finds the look (material and layer) of each. Returns false if memory
 * is out or the run is interrupted. */
static bool take_apart(looks_state *s, vs_ref operand) {
  forget_parts(s);
  s->look_count = 0;
  if (!vs_store_grow(s->store, &s->looks, &s->look_room, 1, sizeof *s->looks)) return false;
  s->looks[s->look_count++] = (looks_look){ 0, NULL, NO_PART, NO_PART };
  bool ok = add_step(s, (looks_step){ 0, vs_affine_identity(), operand });
  while (ok && s->step_count) {
    looks_step at = s->steps[--s->step_count];
    const vs_node *n = at.ref.node;
    ok = vs_store_going(s->store, VS_ORDER_WORK, s->error);
    if (!ok || n->class_ == VS_NOTHING) continue;
    bool through = is_look(n) || (has_look(s, n) && (n->kind == VS_TRANSFORM || n->kind == VS_UNION));
    if (!through) {
      ok = add_part(s, &at);
      continue;
    }
    if (n->kind == VS_TRANSFORM) at.placed = vs_affine_multiply(&at.placed, &VS_AS(transform, n)->matrix);
    if (is_look(n)) ok = find_look(s, at.look, n, &at.look);
    for (uint32_t i = n->child_count; ok && i-- > 0;)
      ok = add_step(s, (looks_step){ at.look, at.placed, n->children[i] });
  }
  return ok;
}

/* ---- sets that have one look ---- */

/* Returns node n inside the materials and layers of the given look. Takes over the caller's reference to n. Returns
 * NULL if memory is out, or if n is NULL. */
static vs_node *within_look(looks_state *s, uint32_t look, vs_node *n, const vs_origin *origin) {
  for (; n && look; look = s->looks[look].above) {
    const vs_node *wrapper = s->looks[look].wrapper;
    vs_node *bare = n;
    n = vs_node_new(s->store, (vs_kind)wrapper->kind, vs_node_data(wrapper), &(vs_ref){ bare, origin }, 1);
    vs_node_release(bare);
  }
  return n;
}

/* Returns the part with this look, or if there are several, their union. *origin: origin of the first part. */
static vs_node *parts_of(looks_state *s, const looks_look *look, const vs_origin **origin) {
  size_t count = 0;
  for (uint32_t i = look->first; i != NO_PART; i = s->parts[i].next) count++;
  const vs_ref *first = &s->parts[look->first].ref;
  *origin = first->origin;
  if (count == 1) return vs_node_retain(first->node);
  vs_ref *refs = vs_store_realloc(s->store, NULL, 0, count * sizeof *refs);
  if (!refs) return NULL;
  size_t n = 0;
  for (uint32_t i = look->first; i != NO_PART; i = s->parts[i].next) refs[n++] = s->parts[i].ref;
  vs_node *made = vs_node_new(s->store, VS_UNION, &(struct vs_union){ 0 }, refs, count);
  vs_store_realloc(s->store, refs, count * sizeof *refs, 0);
  return made;
}

/* Returns the set n with the operands kids, inside the given look. Of operand kids[which], it has only the parts with
 * this look. */
static vs_node *set_of_look(looks_state *s, const vs_node *n, vs_ref *kids, uint32_t which, uint32_t look,
                            const vs_origin **origin) {
  vs_node *operand = parts_of(s, &s->looks[look], origin);
  if (!operand) return NULL;
  kids[which] = (vs_ref){ operand, *origin };
  vs_node *made = vs_node_new(s->store, (vs_kind)n->kind, vs_node_data(n), kids, n->child_count);
  vs_node_release(operand);
  return within_look(s, look, made, *origin);
}

/* Divides the set n into one set for each look of the parts of kids[which]. Returns the union of these sets, or the
 * only one. */
static vs_node *spread(looks_state *s, const vs_node *n, const vs_ref *kids, uint32_t which) {
  size_t room = n->child_count, used = 0;
  vs_ref *own = vs_store_realloc(s->store, NULL, 0, room * sizeof *own);
  vs_ref *sets = vs_store_realloc(s->store, NULL, 0, s->look_count * sizeof *sets);
  bool ok = own && sets;
  for (size_t i = 0; ok && i < room; i++) own[i] = kids[i];
  for (size_t p = 0; ok && p < s->part_count; p++) { /* visits the looks in the order in which they first occur among
                                                      * the parts */
    uint32_t look = s->parts[p].look;
    if (s->looks[look].first != p) continue;
    sets[used].node = set_of_look(s, n, own, which, look, &sets[used].origin);
    if (!sets[used].node) ok = false;
    else used++;
  }
  vs_node *made = !ok         ? NULL
                  : used == 1 ? vs_node_retain(sets[0].node)
                              : vs_node_new(s->store, VS_UNION, &(struct vs_union){ 0 }, sets, used);
  for (size_t i = 0; i < used; i++) vs_node_release(sets[i].node);
  if (own) vs_store_realloc(s->store, own, room * sizeof *own, 0);
  if (sets) vs_store_realloc(s->store, sets, s->look_count * sizeof *sets, 0);
  return made;
}

/* ---- the pass ---- */

/* Returns the index of the operand whose material and layer apply to the result of the set. */
static uint32_t operand_with_look(const looks_state *s, const vs_node *n, const vs_ref *kids) {
  uint32_t i = 0;
  while (n->kind == VS_INTERSECTION && i + 1 < n->child_count && !has_look(s, kids[i].node)) i++;
  return i;
}

/* Rewrites a difference or intersection n of regions that contain materials or layers, so that these are outside of it.
 * Returns NULL on failure. */
static vs_node *set_with_looks(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  looks_state *s = w->state;
  uint32_t which = operand_with_look(s, n, kids);
  bool ok = take_apart(s, kids[which]), any = s->part_count > 0;
  vs_node *made = !ok ? NULL : any ? spread(s, n, kids, which) : vs_rewrite_keep(w, n, kids);
  w->changed += any;
  forget_parts(s);
  return made;
}

/* Returns n, an outline that is computed from other outlines, inside the material and layer of the first of those
 * outlines. */
static vs_node *outline_with_look(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  looks_state *s = w->state;
  vs_node *made = vs_rewrite_keep(w, n, kids);
  if (!take_apart(s, kids[0])) {
    vs_node_release(made);
    made = NULL;
  } else if (s->part_count) {
    made = within_look(s, s->parts[0].look, made, kids[0].origin);
    w->changed++;
  }
  forget_parts(s);
  return made;
}

static vs_node *looks_node(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  (void)origin;
  looks_state *s = w->state;
  if (is_look(n) || !had_look(w, n)) return vs_rewrite_keep(w, n, kids);
  vs_node *made = is_cut_region(n) ? set_with_looks(w, n, kids)
                  : is_outlined(n) ? outline_with_look(w, n, kids)
                                   : vs_rewrite_keep(w, n, kids);
  if (made && !vs_nodemap_put(&s->made, made, NULL)) vs_node_release(made), made = NULL;
  return made;
}

/* Returns true if the drawing has a node out of which materials or layers must be moved. */
static bool find_looks(vs_rewrite *w, looks_state *s) {
  bool any = false;
  for (size_t k = 0; k < w->order.count; k++) {
    const vs_node *n = w->order.at[k].node;
    s->looked[k] = is_look(n) || (w->order.note[k].inner && look_within(w, n));
    any = any || (s->looked[k] && (is_cut_region(n) || is_outlined(n)));
  }
  return any;
}

bool vs_scene_looks(vs_scene *scene, vs_error *e) {
  bool thin = false;
  for (size_t i = 0; i < scene->drawn_count; i++) thin |= scene->drawn[i].node->class_ != VS_SOLID;
  if (!thin) return true;
  vs_store *store = scene->store;
  looks_state s = { .store = store, .error = e, .made = { .store = store } };
  vs_rewrite w = { .store = store, .error = e, .state = &s, .order = { .store = store } };
  bool ok = vs_order_make(&w.order, scene->drawn, scene->drawn_count, e);
  size_t room = w.order.count + 1;
  if (ok) ok = (s.looked = vs_store_realloc(store, NULL, 0, room)) != NULL || vs_error_memory(e, NULL);
  if (ok && find_looks(&w, &s)) ok = vs_rewrite_run(&w, looks_node, scene->drawn, scene->drawn_count);
  if (s.looked) vs_store_realloc(store, s.looked, room, 0);
  if (s.looks) vs_store_realloc(store, s.looks, s.look_room * sizeof *s.looks, 0);
  if (s.parts) vs_store_realloc(store, s.parts, s.part_room * sizeof *s.parts, 0);
  if (s.steps) vs_store_realloc(store, s.steps, s.step_room * sizeof *s.steps, 0);
  vs_nodemap_free(&s.made);
  vs_order_free(&w.order);
  return ok;
}
