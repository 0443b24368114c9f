/* Implements the pass fold. Nested placements are multiplied. A moved primitive becomes a primitive at another place.
 * Placements move into paint, layers, regions, extrusions and small sets, if every member can absorb them. Paint or a
 * layer that all members of a set have moves outside the set.
 *
 * Each step removes at least one command, and no step changes a node with several references. A placement moves through
 * at most one set, of at most CARRY_MOST members. Without this limit the pass would cost more per node, and texts would
 * contain many long numbers to save a single command. Transparent paint stays on its parts: around a set, it would make
 * touching panes into a single body of glass. */
#include "passes/fold.h"

#include "model/store/nodemap.h"
#include "passes/moved_primitives.h"
#include "passes/rewrite.h"

enum { CARRY_MOST = 8, DRESS_MOST = 4 };

typedef struct { vs_nodemap shared; /* shared: set of new nodes with several references, which the pass must not
                                     * change */ } fold_state;

bool vs_fold_begin(vs_rewrite *w) {
  fold_state *f = vs_store_realloc(w->store, NULL, 0, sizeof *f);
  if (!f) return vs_error_memory(w->error, NULL);
  *f = (fold_state){ .shared = { .store = w->store } };
  w->state = f;
  return true;
}

void vs_fold_end(vs_rewrite *w) {
  fold_state *f = w->state;
  if (!f) return;
  vs_nodemap_free(&f->shared);
  vs_store_realloc(w->store, f, sizeof *f, 0);
}

static bool fold_lone(const vs_rewrite *w, const vs_node *new) {
  return !vs_nodemap_get(&((const fold_state *)w->state)->shared, new);
}

static bool fold_is_wrapper(const vs_node *n) { return n->kind == VS_MATERIAL || n->kind == VS_LAYER; }

/* ---- placements ---- */

typedef struct { int wrappers; bool set; } fold_way; /* wrappers: number of materials and layers through which the
                                                      * placement may still move; set: true if it may move into a set */

static vs_node *fold_carry(vs_rewrite *w, const vs_affine *a, const vs_node *n, fold_way way, bool *fits,
                           const vs_origin **origin);

/* Moves the placement a into each child of n, and returns a copy of n with these children. data: fields of the copy;
 * way: how far the placement may move. Sets *fits to false if some child cannot absorb the placement. */
static vs_node *fold_carry_children(vs_rewrite *w, const vs_affine *a, const vs_node *n, const void *data, fold_way way,
                                    bool *fits) {
  vs_ref kids[CARRY_MOST];
  uint32_t done = 0;
  bool ok = true;
  vs_node *made = NULL;
  *fits = n->child_count <= CARRY_MOST;
  while (ok && *fits && done < n->child_count) {
    const vs_ref *kid = &n->children[done];
    *fits = fold_lone(w, kid->node);
    kids[done].origin = kid->origin;
    kids[done].node = *fits ? fold_carry(w, a, kid->node, way, fits, &kids[done].origin) : NULL;
    ok = kids[done].node != NULL;
    done += ok;
  }
  if (ok && *fits) made = vs_node_new(w->store, (vs_kind)n->kind, data, kids, n->child_count);
  while (done > 0) vs_node_release(kids[--done].node);
  return made;
}

static vs_node *fold_carry_placement(vs_rewrite *w, const vs_affine *a, const vs_node *n, const vs_origin **origin) {
  struct vs_transform both = { .matrix = vs_affine_multiply(a, &VS_AS(transform, n)->matrix) };
  vs_node *below = n->children[0].node;
  bool fits = false;
  vs_node *made = vs_affine_is_identity(&both.matrix) ? vs_node_retain(below)
                  : fold_lone(w, below)               ? vs_fold_primitive(w, &both.matrix, below, &fits)
                                                      : NULL;
  if (made || fits) *origin = n->children[0].origin;
  return made || fits ? made : vs_node_new(w->store, VS_TRANSFORM, &both, n->children, 1);
}

/* Returns a new reference to n under the placement a, without an additional command. Returns NULL and sets *fits to
 * false if n cannot absorb the placement; returns NULL with *fits true if memory is out. Sets *origin if n's child
 * replaces n. */
static vs_node *fold_carry(vs_rewrite *w, const vs_affine *a, const vs_node *n, fold_way way, bool *fits,
                           const vs_origin **origin) {
  if (n->kind == VS_TRANSFORM) {
    *fits = true;
    return fold_carry_placement(w, a, n, origin);
  }
  *fits = false;
  if (fold_is_wrapper(n))
    return way.wrappers > 0
               ? fold_carry_children(w, a, n, vs_node_data(n), (fold_way){ way.wrappers - 1, way.set }, fits)
               : NULL;
  if (vs_node_is_set(n))
    return way.set && n->class_ == VS_SOLID
               ? fold_carry_children(w, a, n, vs_node_data(n), (fold_way){ way.wrappers, false }, fits)
               : NULL;
  if (n->kind == VS_REGION && vs_fold_is_upright(a))
    return fold_carry_children(w, a, n, vs_node_data(n), (fold_way){ 0, false }, fits);
  if (n->kind == VS_EXTRUDE && n->child_count == 1 && vs_fold_is_upright(a)) {
    struct vs_extrude d = *VS_AS(extrude, n);
    d.along = vs_affine_vector(a, d.along);
    return fold_carry_children(w, a, n, &d, (fold_way){ 0, false }, fits);
  }
  return vs_fold_primitive(w, a, n, fits);
}

static vs_node *fold_placed(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  const vs_affine *a = &VS_AS(transform, n)->matrix;
  const vs_node *below = kids[0].node;
  bool fits = false;
  if (vs_affine_is_identity(a)) {
    w->changed++;
    *origin = kids[0].origin;
    return vs_node_retain(kids[0].node);
  }
  if (!vs_rewrite_lone(w, n->children[0].node) || !fold_lone(w, below)) return vs_rewrite_keep(w, n, kids);
  /* error messages should refer to the call that made the primitive, not to the call that placed it */
  const vs_origin *own = below->kind == VS_TRANSFORM ? NULL : kids[0].origin;
  vs_node *made = fold_carry(w, a, below, (fold_way){ DRESS_MOST, true }, &fits, &own);
  if (!fits) return vs_rewrite_keep(w, n, kids);
  w->changed++;
  w->nests = w->nests || vs_node_is_set(below);
  *origin = own;
  return made;
}

/* ---- paint and layers ---- */

static bool fold_same_wrapper(const vs_node *a, const vs_node *b) {
  if (a->kind != b->kind) return false;
  return a->kind == VS_MATERIAL ? VS_AS(material, a)->material == VS_AS(material, b)->material
                                : VS_AS(layer, a)->name == VS_AS(layer, b)->name;
}

static bool fold_may_rise(const vs_rewrite *w, const vs_node *n) {
  return fold_is_wrapper(n) && n->class_ == VS_SOLID &&
         (n->kind == VS_LAYER || !(VS_AS(material, n)->material->transparency > 0)) && fold_lone(w, n);
}

/* Counts the members, from kids[at] on, with a wrapper (material or layer) equal to that of kids[at], as long as it may
 * move outside the set. Returns their number. */
static uint32_t fold_run(const vs_rewrite *w, const vs_ref *kids, uint32_t at, uint32_t count) {
  uint32_t end = at;
  if (!fold_may_rise(w, kids[at].node)) return 0;
  while (end < count && fold_same_wrapper(kids[at].node, kids[end].node) && fold_may_rise(w, kids[end].node)) end++;
  return end - at;
}

static vs_node *fold_members(vs_rewrite *w, const vs_node *set, vs_kind kind, const vs_ref *kids, uint32_t count,
                             int depth);

/* Returns the wrapper (material or layer) that all kids have, around a set of the nodes inside these wrappers. */
static vs_node *fold_raise(vs_rewrite *w, const vs_node *set, vs_kind kind, const vs_ref *kids, uint32_t count,
                           int depth) {
  const vs_node *wrapper = kids[0].node;
  vs_ref *members = vs_store_realloc(w->store, NULL, 0, count * sizeof *members);
  if (!members) return NULL;
  for (uint32_t i = 0; i < count; i++) members[i] = kids[i].node->children[0];
  vs_ref below = { fold_members(w, set, kind, members, count, depth), w->order.at[vs_order_of(set)].origin };
  vs_store_realloc(w->store, members, count * sizeof *members, 0);
  vs_node *made = below.node ? vs_node_new(w->store, (vs_kind)wrapper->kind, vs_node_data(wrapper), &below, 1) : NULL;
  vs_node_release(below.node);
  return made;
}

/* Returns a set of the kids, in which a wrapper (material or layer) that neighbours have in common is moved around
 * these neighbours. New nodes have the origin of `set`. */
static vs_node *fold_members(vs_rewrite *w, const vs_node *set, vs_kind kind, const vs_ref *kids, uint32_t count,
                             int depth) {
  if (depth > 0 && fold_run(w, kids, 0, count) == count) return fold_raise(w, set, kind, kids, count, depth - 1);
  if (depth == 0 || kind != VS_UNION) return vs_node_new(w->store, kind, vs_node_data(set), kids, count);
  const vs_origin *origin = w->order.at[vs_order_of(set)].origin;
  vs_ref *all = vs_store_realloc(w->store, NULL, 0, count * sizeof *all);
  uint32_t *made = vs_store_realloc(w->store, NULL, 0, count * sizeof *made); /* indices of the new members whose
                                                                               * references this function must
                                                                               * release */
  uint32_t kept = 0, ours = 0;
  bool ok = all && made;
  for (uint32_t i = 0, run; ok && i < count; i += run > 1 ? run : 1) {
    run = fold_run(w, kids, i, count);
    all[kept] = kids[i];
    if (run > 1) {
      all[kept] = (vs_ref){ fold_members(w, set, VS_UNION, kids + i, run, depth), origin };
      ok = all[kept].node != NULL;
      if (ok) made[ours++] = kept;
    }
    kept++;
  }
  vs_node *result = ok ? vs_node_new(w->store, kind, vs_node_data(set), all, kept) : NULL;
  for (uint32_t i = 0; i < ours; i++) vs_node_release(all[made[i]].node);
  if (all) vs_store_realloc(w->store, all, count * sizeof *all, 0);
  if (made) vs_store_realloc(w->store, made, count * sizeof *made, 0);
  return result;
}

static vs_node *fold_set(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  bool any = false;
  /* If kids is the node's own array, all children are leaves with one reference, which have no wrapper around them. */
  if (n->child_count < 2 || kids == n->children) return vs_rewrite_keep(w, n, kids);
  for (uint32_t i = 1; !any && n->kind == VS_UNION && i < n->child_count; i++)
    any = fold_is_wrapper(kids[i].node) && fold_same_wrapper(kids[i - 1].node, kids[i].node) &&
          fold_run(w, kids, i - 1, i + 1) == 2;
  if (!any && fold_run(w, kids, 0, n->child_count) < n->child_count) return vs_rewrite_keep(w, n, kids);
  w->changed++;
  return fold_members(w, n, (vs_kind)n->kind, kids, n->child_count, DRESS_MOST);
}

/* An outer material directly around a material has no effect, and an outer layer directly around a layer neither.
 * Therefore the outer one is removed. */
static vs_node *fold_wrapper(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  if (kids[0].node->kind != n->kind || !fold_lone(w, kids[0].node)) return vs_rewrite_keep(w, n, kids);
  w->changed++;
  *origin = kids[0].origin;
  return vs_node_retain(kids[0].node);
}

vs_node *vs_pass_fold(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  fold_state *f = w->state;
  vs_node *new = n->kind == VS_TRANSFORM ? fold_placed(w, n, kids, origin)
                 : fold_is_wrapper(n)      ? fold_wrapper(w, n, kids, origin)
                 : vs_node_is_set(n)     ? fold_set(w, n, kids)
                                         : vs_rewrite_keep(w, n, kids);
  if (new && !vs_rewrite_lone(w, n) && !vs_nodemap_put(&f->shared, new, NULL)) {
    vs_node_release(new);
    new = NULL;
  }
  return new;
}
