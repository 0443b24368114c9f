/* Implements grouping: it converts sets of very many parts to trees of boxes. This is for target programs, such as
 * POV-Ray, that test every part of a set for every ray.
 *
 * The pass divides the cutters of a difference into halves by their centres, until few are left. It does the same with
 * the members of a union that is cut or intersected. Each half is the intersection of a box, slightly larger than its
 * parts, with their union. If a point is outside the box, it is outside all of the parts, and one test suffices. Parts
 * with their own paint, or without bounds, stay outside the boxes, so order and paint do not change. */
#include "passes/group.h"

#include <math.h>
#include <stdlib.h>

#include "passes/rewrite.h"

enum { MANY = 12, FEW = 5 };

typedef struct { vs_ref ref; vs_bounds bounds; vs_vec3 middle; size_t index; } group_part;
typedef struct {
  unsigned char *carved, *painted; /* carved[i]: whether node i of the old tree is in an intersection or difference;
                                    * painted[i]: whether it contains a material */
  size_t count;
} group_state;

static bool group_finite(const vs_bounds *b) { return !vs_bounds_is_empty(b) && isfinite(vs_bounds_diagonal(b)); }

static int group_by(const group_part *a, const group_part *b, double x, double y) {
  return x != y ? (x < y ? -1 : 1) : a->index < b->index ? -1 : a->index > b->index;
}
static int group_by_x(const void *p, const void *q) {
  return group_by(p, q, ((const group_part *)p)->middle.x, ((const group_part *)q)->middle.x);
}
static int group_by_y(const void *p, const void *q) {
  return group_by(p, q, ((const group_part *)p)->middle.y, ((const group_part *)q)->middle.y);
}
static int group_by_z(const void *p, const void *q) {
  return group_by(p, q, ((const group_part *)p)->middle.z, ((const group_part *)q)->middle.z);
}

static vs_node *group_box(vs_rewrite *w, const group_part *parts, size_t count, vs_ref whole) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < count; i++) vs_bounds_unite(&b, &parts[i].bounds);
  double more = 2e-3 * vs_bounds_diagonal(&b); /* enlarges the bounds a little, because those of curved shapes are
                                                * computed from sample points */
  struct vs_box box = { .p = { b.min.x - more, b.min.y - more, b.min.z - more },
                        .q = { b.max.x + more, b.max.y + more, b.max.z + more } };
  vs_ref both[2] = { { vs_node_new(w->store, VS_BOX, &box, NULL, 0), whole.origin }, whole };
  vs_node *made = both[0].node ? vs_node_new(w->store, VS_INTERSECTION, NULL, both, 2) : NULL;
  vs_node_release(both[0].node);
  return made;
}

/* Returns a new reference to the union of the parts as a tree of boxes, with the origin of the first part. Divides the
 * parts into halves, so the recursion is as deep as the number of binary digits of count. */
static vs_node *group_tree(vs_rewrite *w, group_part *parts, size_t count) {
  vs_ref kids[FEW] = { { 0 } };
  size_t n = count <= FEW ? count : 2;
  const vs_origin *origin = parts[0].ref.origin;
  if (count == 1) return vs_node_retain(parts[0].ref.node);
  if (count <= FEW) {
    for (size_t i = 0; i < n; i++) kids[i] = (vs_ref){ vs_node_retain(parts[i].ref.node), parts[i].ref.origin };
  } else {
    vs_bounds middles = vs_bounds_empty();
    for (size_t i = 0; i < count; i++) vs_bounds_add(&middles, parts[i].middle);
    vs_vec3 d = vs_v3_sub(middles.max, middles.min);
    qsort(parts, count, sizeof *parts, d.x >= d.y && d.x >= d.z ? group_by_x : d.y >= d.z ? group_by_y : group_by_z);
    kids[0] = (vs_ref){ group_tree(w, parts, count / 2), origin };
    kids[1] = (vs_ref){ kids[0].node ? group_tree(w, parts + count / 2, count - count / 2) : NULL, origin };
  }
  vs_node *both = kids[n - 1].node ? vs_node_new(w->store, VS_UNION, NULL, kids, n) : NULL;
  vs_node *made = both ? group_box(w, parts, count, (vs_ref){ both, origin }) : NULL;
  for (size_t i = 0; i < n; i++) vs_node_release(kids[i].node);
  vs_node_release(both);
  return made;
}

/* Returns a copy of n in which trees of boxes replace the kids from index `first` on, if enough of these can be
 * grouped. Returns NULL on failure. */
static vs_node *group_members(vs_rewrite *w, const vs_node *n, const vs_ref *kids, uint32_t first) {
  const group_state *g = w->state;
  size_t count = 0, kept = first;
  group_part *parts = vs_store_realloc(w->store, NULL, 0, (n->child_count + (size_t)1) * sizeof *parts);
  vs_ref *all = vs_store_realloc(w->store, NULL, 0, (n->child_count + (size_t)1) * sizeof *all);
  bool ok = parts && all;
  for (uint32_t i = 0; ok && i < first; i++) all[i] = kids[i];
  for (uint32_t i = first; ok && i < n->child_count; i++) {
    vs_bounds b = vs_bounds_empty();
    const vs_node *old = n->children[i].node;
    if (!vs_order_has(&w->order, old) || !g->painted[vs_order_of(old)])
      ok = w->options->bounds(w->options->context, kids[i].node, &b, w->error);
    if (!group_finite(&b)) all[kept++] = kids[i];
    else parts[count++] = (group_part){ kids[i], b, vs_v3_scale(vs_v3_add(b.min, b.max), 0.5), i };
  }
  vs_node *made = NULL;
  if (ok) { /* a large part would enlarge every box, so it stays outside the boxes */
    vs_bounds whole = vs_bounds_empty();
    for (size_t i = 0; i < count; i++) vs_bounds_unite(&whole, &parts[i].bounds);
    size_t small = 0;
    for (size_t i = 0; i < count; i++)
      if (3 * vs_bounds_diagonal(&parts[i].bounds) > vs_bounds_diagonal(&whole)) all[kept++] = parts[i].ref;
      else parts[small++] = parts[i];
    count = small;
  }
  if (ok && count < MANY) {
    made = vs_rewrite_keep(w, n, kids);
  } else if (ok) {
    const vs_origin *origin = parts[0].ref.origin;
    vs_node *tree = group_tree(w, parts, count);
    all[kept++] = (vs_ref){ tree, origin };
    made = tree ? vs_node_new(w->store, (vs_kind)n->kind, vs_node_data(n), all, kept) : NULL;
    vs_node_release(tree);
    w->changed++;
  }
  if (parts) vs_store_realloc(w->store, parts, (n->child_count + (size_t)1) * sizeof *parts, 0);
  if (all) vs_store_realloc(w->store, all, (n->child_count + (size_t)1) * sizeof *all, 0);
  return made;
}

static vs_node *group_node(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  const group_state *g = w->state;
  (void)origin;
  if (n->class_ != VS_SOLID || n->child_count < MANY) return vs_rewrite_keep(w, n, kids);
  if (n->kind == VS_DIFFERENCE) return group_members(w, n, kids, 1);
  if (n->kind == VS_UNION && g->carved[vs_order_of(n)]) return group_members(w, n, kids, 0);
  return vs_rewrite_keep(w, n, kids);
}

bool vs_sets_group(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_error *e) {
  group_state g = { 0 };
  vs_rewrite w = { .store = s, .options = options, .error = e, .state = &g, .order = { .store = s } };
  bool carved = false;
  for (size_t i = 0; i < count; i++) carved = carved || refs[i].node->flags & VS_NODE_CARVED;
  if (!carved) return true;
  bool ok = vs_order_make(&w.order, refs, count, e);
  g.count = w.order.count + 1;
  if (ok) {
    g.carved = vs_store_realloc(s, NULL, 0, g.count);
    g.painted = vs_store_realloc(s, NULL, 0, g.count);
    ok = (g.carved && g.painted) || vs_error_memory(e, NULL);
  }
  for (size_t k = 0; ok && k < g.count; k++) g.carved[k] = g.painted[k] = 0;
  for (size_t k = 0; ok && k < w.order.count; k++) {
    const vs_node *n = w.order.at[k].node;
    g.painted[k] = n->kind == VS_MATERIAL || n->kind == VS_NATIVE;
    for (uint32_t i = 0; w.order.note[k].inner && i < n->child_count; i++)
      if (vs_order_has(&w.order, n->children[i].node)) g.painted[k] |= g.painted[vs_order_of(n->children[i].node)];
  }
  for (size_t k = w.order.count; ok && k-- > 0;) { /* the loop visits parents before their children */
    const vs_node *n = w.order.at[k].node;
    bool below = g.carved[k] || n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE;
    for (uint32_t i = 0; below && w.order.note[k].inner && i < n->child_count; i++)
      if (vs_order_has(&w.order, n->children[i].node)) g.carved[vs_order_of(n->children[i].node)] = 1;
  }
  ok = ok && vs_rewrite_run(&w, group_node, refs, count);
  if (g.carved) vs_store_realloc(s, g.carved, g.count, 0);
  if (g.painted) vs_store_realloc(s, g.painted, g.count, 0);
  vs_order_free(&w.order);
  return ok;
}
