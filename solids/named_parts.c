/* Makes each part of a drawing a drawn object of its own.
 *
 * The file divides each node into pieces, children first: one piece for each part below the node, and one for all that
 * belongs to no part. A piece is the node itself with only the content of its part:
 *
 *   (a in part P + b) - c   has the pieces   P: a - c   and   outside of parts: b - c
 *
 * Pieces of equal name become one. An object that is made from others, such as a hull, belongs to the part around it.
 * Cost: proportional to the number of nodes that contain parts, times the number of parts below them. A tree of boxes
 * finds the solids that overlap. */
#include "solids/named_parts.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "model/order.h"
#include "model/store/array.h"
#include "model/store/nodemap.h"
#include "solids/near_boxes.h"

/* The content of one part in a node. name: the part's name; "" for content outside of parts. The holder of the piece
 * holds a reference to its node. */
typedef struct { const char *name; vs_ref ref; } parts_piece;
/* The pieces of a node (one piece for each part): pieces[first] to pieces[first + count - 1]. A count of 0 means that
 * the node is made from objects that contain parts, and belongs to the part around it. bare: the node without parts;
 * NULL if the node contains no parts. */
typedef struct { size_t first, count; vs_node *bare; } parts_entry;
typedef struct { uint32_t first, last, count; } parts_bucket; /* The members (pieces of a node's children) that have one
                                                               * name, as a list linked by their `next`. */
typedef struct { parts_piece piece; uint32_t next; } parts_member; /* piece: a piece of a node's child, without a
                                                                    * reference of its own; next: index of the next
                                                                    * member with the same name */

typedef struct {
  vs_store *store;
  vs_error *error;
  vs_order order;
  vs_bounds_memo bounds;
  const char *nothing;   /* name of the piece that has the content outside of all parts */
  parts_entry *entries;  /* entries[i]: the pieces of node number i in `order` */
  parts_piece *pieces;
  size_t piece_count, piece_room;
  parts_member *members; /* pieces of the children of the node that is divided now */
  size_t member_count, member_room;
  parts_bucket *buckets; /* the members, in one bucket for each name */
  size_t bucket_count, bucket_room;
  vs_ref *kids;          /* working memory for the children of a new node */
  size_t kid_room;
} parts_state;

/* ---- pieces of children ---- */

static const parts_entry *entry_of(const parts_state *s, const vs_node *n) {
  return vs_order_has(&s->order, n) && s->entries[vs_order_of(n)].bare ? &s->entries[vs_order_of(n)] : NULL;
}

static vs_ref bare_of(const parts_state *s, vs_ref ref) {
  const parts_entry *entry = entry_of(s, ref.node);
  return (vs_ref){ entry ? entry->bare : ref.node, ref.origin };
}

static bool no_memory(const parts_state *s) { return vs_error_memory(s->error, NULL); }

static bool add_member(parts_state *s, parts_piece piece) {
  if (!vs_store_grow(s->store, &s->members, &s->member_room, s->member_count + 1, sizeof *s->members))
    return no_memory(s);
  s->members[s->member_count++] = (parts_member){ piece, UINT32_MAX };
  return true;
}

/* Appends the pieces of the node `ref`, a child or drawn object, to s->members. */
static bool gather(parts_state *s, vs_ref ref) {
  const parts_entry *entry = entry_of(s, ref.node);
  if (!entry || entry->count == 0) return add_member(s, (parts_piece){ s->nothing, bare_of(s, ref) });
  bool ok = vs_store_going(s->store, VS_ORDER_WORK, s->error);
  for (size_t i = 0; ok && i < entry->count; i++) ok = add_member(s, s->pieces[entry->first + i]);
  return ok;
}

/* Sorts the members (pieces of children) into buckets, one for each name. single: true if each member outside of all
 * parts gets its own bucket. */
static bool sort_members(parts_state *s, bool single) {
  vs_nodemap names = { .store = s->store };
  bool ok = true;
  s->bucket_count = 0;
  for (uint32_t i = 0; ok && i < s->member_count; i++) {
    bool found = false, own = single && s->members[i].piece.name == s->nothing;
    uint64_t *number = own ? NULL : vs_nodemap_put(&names, s->members[i].piece.name, &found);
    ok = own || number;
    if (ok && found) {
      parts_bucket *b = &s->buckets[*number];
      s->members[b->last].next = i;
      b->last = i, b->count++;
      continue;
    }
    ok = ok && vs_store_grow(s->store, &s->buckets, &s->bucket_room, s->bucket_count + 1, sizeof *s->buckets);
    if (!ok) break;
    if (number) *number = s->bucket_count;
    s->buckets[s->bucket_count++] = (parts_bucket){ i, i, 1 };
  }
  vs_nodemap_free(&names);
  return ok || no_memory(s);
}

static bool grow_kids(parts_state *s, size_t count) {
  return vs_store_grow(s->store, &s->kids, &s->kid_room, count, sizeof *s->kids) || no_memory(s);
}

/* Returns a new reference to the union of the pieces in a bucket, which have one name. Returns NULL on failure. */
static vs_node *bucket_union(parts_state *s, const parts_bucket *b) {
  if (b->count == 1) return vs_node_retain(s->members[b->first].piece.ref.node);
  size_t count = 0;
  if (!grow_kids(s, b->count)) return NULL;
  for (uint32_t i = b->first; i != UINT32_MAX; i = s->members[i].next) s->kids[count++] = s->members[i].piece.ref;
  vs_node *made = vs_node_new(s->store, VS_UNION, &(struct vs_union){ 0 }, s->kids, count);
  if (!made) no_memory(s);
  return made;
}

/* ---- pieces of a node ---- */

/* Adds a piece (content of one part) to the entry of its node. Takes over the caller's reference to piece.ref.node;
 * NULL there counts as out of memory. */
static bool add_piece(parts_state *s, parts_entry *entry, parts_piece piece) {
  bool ok = piece.ref.node &&
            vs_store_grow(s->store, &s->pieces, &s->piece_room, s->piece_count + 1, sizeof *s->pieces);
  if (!ok) return vs_node_release(piece.ref.node), no_memory(s);
  if (entry->count == 0) entry->first = s->piece_count;
  entry->count++;
  s->pieces[s->piece_count++] = piece;
  return true;
}

/* Returns "outer/inner", or the outer name if the inner one is empty; NULL on failure. */
static const char *name_within(const parts_state *s, const char *outer, const char *inner) {
  if (inner == s->nothing) return outer;
  size_t a = strlen(outer), b = strlen(inner), room = a + b + 1;
  char *text = vs_store_realloc(s->store, NULL, 0, room);
  if (!text) return NULL;
  memcpy(text, outer, a);
  text[a] = '/';
  memcpy(text + a + 1, inner, b);
  const char *name = vs_store_text(s->store, text, room);
  vs_store_realloc(s->store, text, room, 0);
  return name;
}

/* Sets *meets to false if the bounds of two solids do not meet. Returns false on failure. */
static bool may_meet(parts_state *s, const vs_node *a, const vs_node *b, bool *meets) {
  vs_bounds of_a, of_b;
  *meets = true;
  if (a->class_ != VS_SOLID || b->class_ != VS_SOLID || (a->flags | b->flags) & VS_NODE_ENDLESS) return true;
  if (!vs_bounds_memo_get(&s->bounds, a, &of_a, s->error) || !vs_bounds_memo_get(&s->bounds, b, &of_b, s->error))
    return false;
  *meets = !vs_bounds_is_empty(&of_a) && !vs_bounds_is_empty(&of_b) && vs_bounds_overlap(&of_a, &of_b, 0);
  return true;
}

/* Adds to `entry`, for each member, a copy of node n in which this member is child number `which` and the other
 * children have no parts. In a difference, solids that do not touch the member are not subtracted. */
static bool replace_child(parts_state *s, const vs_node *n, parts_entry *entry, uint32_t which) {
  for (size_t i = 0; i < s->member_count; i++) {
    parts_piece piece = s->members[i].piece;
    size_t count = 0;
    if (!grow_kids(s, n->child_count)) return false;
    for (uint32_t k = 0; k < n->child_count; k++) {
      vs_ref kid = k == which ? piece.ref : bare_of(s, n->children[k]);
      bool meets = true;
      if (n->kind == VS_DIFFERENCE && k > 0 && !may_meet(s, piece.ref.node, kid.node, &meets)) return false;
      if (meets) s->kids[count++] = kid;
    }
    bool whole = n->kind == VS_DIFFERENCE && count == 1 && n->child_count > 1;
    piece.ref.node = whole ? vs_node_retain(piece.ref.node)
                           : vs_node_new(s->store, (vs_kind)n->kind, vs_node_data(n), s->kids, count);
    if (!add_piece(s, entry, piece)) return false;
  }
  return true;
}

static bool name_members(parts_state *s, const vs_node *n, parts_entry *entry) {
  bool ok = true;
  for (size_t i = 0; ok && i < s->member_count; i++) {
    parts_piece piece = s->members[i].piece;
    piece.name = name_within(s, VS_AS(part, n)->name, piece.name);
    vs_node_retain(piece.ref.node);
    ok = piece.name ? add_piece(s, entry, piece) : (vs_node_release(piece.ref.node), no_memory(s));
  }
  return ok;
}

static bool unite_members(parts_state *s, parts_entry *entry) {
  bool ok = sort_members(s, false);
  for (size_t i = 0; ok && i < s->bucket_count; i++) {
    const parts_piece *first = &s->members[s->buckets[i].first].piece;
    vs_ref united = { bucket_union(s, &s->buckets[i]), first->ref.origin };
    ok = add_piece(s, entry, (parts_piece){ first->name, united });
  }
  return ok;
}

static vs_node *without_parts(parts_state *s, const vs_node *n) {
  if (n->kind == VS_PART) return vs_node_retain(bare_of(s, n->children[0]).node);
  if (!grow_kids(s, n->child_count)) return NULL;
  for (uint32_t i = 0; i < n->child_count; i++) s->kids[i] = bare_of(s, n->children[i]);
  vs_node *made = vs_node_new(s->store, (vs_kind)n->kind, vs_node_data(n), s->kids, n->child_count);
  if (!made) no_memory(s);
  return made;
}

/* Computes the pieces of node n from the pieces of its children, which are already known. */
static bool enter(parts_state *s, const vs_node *n, parts_entry *entry) {
  bool any = n->kind == VS_PART, set = vs_node_is_set(n);
  uint32_t which = 0;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (entry_of(s, n->children[i].node)) any = true;
  if (!any) return true;
  if (n->kind == VS_INTERSECTION)
    while (which + 1 < n->child_count && !entry_of(s, n->children[which].node)) which++;
  s->member_count = 0;
  bool ok = true, around = n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
  if (n->kind == VS_UNION)
    for (uint32_t i = 0; ok && i < n->child_count; i++) ok = gather(s, n->children[i]);
  else if (set || around) ok = gather(s, n->children[which]);
  parts_entry made = { 0 };
  if (ok && n->kind == VS_PART) ok = name_members(s, n, &made);
  else if (ok && n->kind == VS_UNION) ok = unite_members(s, &made);
  else if (ok && (set || around)) ok = replace_child(s, n, &made, which);
  if (ok) ok = (made.bare = without_parts(s, n)) != NULL;
  *entry = made;
  return ok;
}

/* ---- solids of different parts ---- */

/* A drawn object of the result. plain: the object without materials and layers, for subtraction from other objects;
 * NULL until it is needed. */
typedef struct { const char *name; vs_ref ref; vs_bounds bounds; vs_node *plain; } parts_item;

/* Returns a new reference to node n without materials and layers, or NULL if memory is out. made[i]: the copy of node i
 * of s->order that has none. */
static vs_node *without_look(parts_state *s, const vs_node *n, vs_node **made) {
  bool same = true;
  if (!grow_kids(s, n->child_count + (size_t)1)) return NULL;
  for (uint32_t i = 0; i < n->child_count; i++) {
    vs_node *kid = n->children[i].node;
    s->kids[i] = (vs_ref){ vs_order_has(&s->order, kid) ? made[vs_order_of(kid)] : kid, n->children[i].origin };
    same = same && s->kids[i].node == kid;
  }
  if (vs_node_is_look(n)) return vs_node_retain(s->kids[0].node);
  if (same) return vs_node_retain((vs_node *)(uintptr_t)n);
  vs_node *new = vs_node_new(s->store, (vs_kind)n->kind, vs_node_data(n), s->kids, n->child_count);
  if (!new) no_memory(s);
  return new;
}

/* Returns a new reference to the object without its materials and layers; NULL on failure. Replaces s->order. */
static vs_node *without_looks(parts_state *s, const vs_ref *ref) {
  vs_order_free(&s->order);
  s->order = (vs_order){ .store = s->store };
  if (!vs_order_make(&s->order, ref, 1, s->error)) return NULL;
  size_t count = s->order.count, done = 0;
  if (count == 0) return vs_node_retain(ref->node);
  vs_node **made = vs_store_realloc(s->store, NULL, 0, count * sizeof *made);
  bool ok = made || no_memory(s);
  for (; ok && done < count; done++) {
    made[done] = without_look(s, s->order.at[done].node, made);
    ok = made[done] != NULL;
    if (!ok) break;
  }
  vs_node *plain = ok ? vs_node_retain(made[count - 1]) : NULL; /* the last node in the order is the object's own
                                                                 * node */
  for (size_t i = 0; i < done; i++) vs_node_release(made[i]);
  if (made) vs_store_realloc(s->store, made, count * sizeof *made, 0);
  return plain;
}

/* Returns true if the intersection of the two boxes has a volume, so that they do not only touch. */
static bool share_space(const vs_bounds *a, const vs_bounds *b) {
  vs_bounds both = *a;
  if (vs_bounds_is_empty(a) || vs_bounds_is_empty(b)) return false;
  double least = 1e-9 * fmin(vs_bounds_diagonal(a), vs_bounds_diagonal(b));
  vs_bounds_meet(&both, b);
  vs_vec3 size = vs_v3_sub(both.max, both.min);
  return size.x > least && size.y > least && size.z > least;
}

/* Pairs of items: items[item] is cut by items[by]. */
typedef struct { uint32_t item, by; } parts_cut;
typedef struct {
  const parts_state *state;
  const parts_item *items;
  parts_cut *cuts;
  size_t count, room;
} parts_cuts;

/* Returns true if items[i] is subtracted from items[at]: it is a solid part whose box overlaps that of items[at], and
 * it comes earlier or items[at] belongs to no part. */
static bool cuts(const parts_cuts *c, uint32_t i, uint32_t at) {
  const parts_item *items = c->items;
  const char *nothing = c->state->nothing;
  return (i < at || items[at].name == nothing) && items[i].name != nothing &&
         share_space(&items[i].bounds, &items[at].bounds);
}

static bool note_cuts(void *context, uint32_t a, uint32_t b) {
  parts_cuts *c = context;
  if (!VS_GROW(c->cuts, c->room, c->count + 2)) return false;
  if (cuts(c, a, b)) c->cuts[c->count++] = (parts_cut){ b, a };
  if (cuts(c, b, a)) c->cuts[c->count++] = (parts_cut){ a, b };
  return true;
}

static int by_item(const void *p, const void *q) {
  const parts_cut *x = p, *y = q;
  if (x->item != y->item) return x->item < y->item ? -1 : 1;
  return x->by < y->by ? -1 : x->by > y->by;
}

/* Finds the cuts of all items, sorted by the cut item. Returns false on failure; the caller frees c->cuts. */
static bool find_cuts(parts_state *s, parts_cuts *c, size_t count) {
  size_t room = 0;
  vs_bounds *boxes = NULL;
  if (!VS_GROW(boxes, room, count + 1)) return no_memory(s);
  for (size_t i = 0; i < count; i++) boxes[i] = c->items[i].bounds;
  bool ok = vs_near_boxes(boxes, (uint32_t)count, 0, NULL, note_cuts, c, s->error);
  free(boxes);
  if (ok && c->count) qsort(c->cuts, c->count, sizeof *c->cuts, by_item);
  return ok;
}

/* Returns `made` inside copies of the outermost materials and layers of the object `ref`; NULL on failure. Some formats
 * show only materials outside of booleans. Takes over the caller's reference to `made`. */
static vs_node *within_looks(parts_state *s, const vs_ref *ref, vs_node *made) {
  size_t depth = 0, count = 0;
  for (const vs_node *n = ref->node; vs_node_is_look(n); n = n->children[0].node) depth++;
  if (!made || !grow_kids(s, depth + 1)) return vs_node_release(made), NULL;
  for (vs_ref at = *ref; vs_node_is_look(at.node); at = at.node->children[0]) s->kids[count++] = at;
  while (made && count-- > 0) {
    vs_ref inner = { made, s->kids[count].origin };
    const vs_node *look = s->kids[count].node;
    made = vs_node_new(s->store, (vs_kind)look->kind, vs_node_data(look), &inner, 1);
    vs_node_release(inner.node);
  }
  return made;
}

/* Subtracts from the solid items[at] the items of its cuts. They are subtracted without materials and layers, because
 * the new faces would otherwise get the material of another part. */
static bool part_item(parts_state *s, parts_item *items, const parts_cut *cut, size_t count) {
  parts_item *item = &items[cut->item];
  for (size_t i = 0; i < count; i++) {
    parts_item *by = &items[cut[i].by];
    if (!by->plain && !(by->plain = without_looks(s, &by->ref))) return false;
  }
  if (!grow_kids(s, count + 1)) return false;
  s->kids[0] = item->ref;
  while (vs_node_is_look(s->kids[0].node)) s->kids[0] = s->kids[0].node->children[0];
  for (size_t i = 0; i < count; i++) s->kids[i + 1] = (vs_ref){ items[cut[i].by].plain, items[cut[i].by].ref.origin };
  vs_node *made = within_looks(
      s, &item->ref, vs_node_new(s->store, VS_DIFFERENCE, &(struct vs_difference){ 0 }, s->kids, count + 1));
  if (!made) return no_memory(s);
  vs_node_release(item->ref.node);
  item->ref.node = made;
  return true;
}

/* Makes the cuts from the last item to the first, so that no item is cut before it is subtracted from others. */
static bool make_cuts(parts_state *s, parts_item *items, const parts_cuts *c, bool named) {
  bool ok = true;
  for (size_t end = c->count, from; ok && end > 0; end = from) {
    for (from = end - 1; from > 0 && c->cuts[from - 1].item == c->cuts[end - 1].item;) from--;
    if ((items[c->cuts[from].item].name != s->nothing) == named)
      ok = vs_store_going(s->store, (uint32_t)(VS_ORDER_WORK + 8 * (end - from)), s->error) &&
           part_item(s, items, c->cuts + from, end - from);
  }
  return ok;
}

static bool part_solids(parts_state *s, parts_item *items, size_t count) {
  parts_cuts c = { .state = s, .items = items };
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++)
    ok = items[i].ref.node->class_ != VS_SOLID || items[i].ref.node->flags & VS_NODE_ENDLESS
             ? (items[i].bounds = vs_bounds_empty(), true)
             : vs_node_bounds(items[i].ref.node, &items[i].bounds, s->error);
  ok = ok && find_cuts(s, &c, count) && make_cuts(s, items, &c, false) && make_cuts(s, items, &c, true);
  free(c.cuts);
  return ok;
}

/* ---- the drawing ---- */

/* Returns an array with one drawn object for each bucket (pieces of one name); NULL on failure. The caller owns the
 * array and its references. */
static vs_ref *make_drawn(parts_state *s, bool parted) {
  size_t count = s->bucket_count, done = 0;
  parts_item *items = vs_store_realloc(s->store, NULL, 0, (count + 1) * sizeof *items);
  vs_ref *drawn = items ? vs_store_realloc(s->store, NULL, 0, (count + 1) * sizeof *drawn) : NULL;
  bool ok = drawn || no_memory(s);
  for (size_t made = 0; ok && made < count; made++) {
    const parts_piece *first = &s->members[s->buckets[made].first].piece;
    vs_ref ref = { bucket_union(s, &s->buckets[made]), first->ref.origin };
    ok = ref.node != NULL;
    if (ok) items[done++] = (parts_item){ first->name, ref, vs_bounds_empty(), NULL };
  }
  ok = ok && (!parted || part_solids(s, items, count));
  size_t named = 0;
  for (; ok && named < count; named++) {
    parts_item *item = &items[named];
    drawn[named] = item->ref;
    drawn[named].node = item->name == s->nothing
                            ? vs_node_retain(item->ref.node)
                            : vs_node_new(s->store, VS_PART, &(struct vs_part){ .name = item->name }, &item->ref, 1);
    ok = drawn[named].node || no_memory(s);
    if (!ok) break;
  }
  for (size_t i = 0; i < done; i++) vs_node_release(items[i].ref.node), vs_node_release(items[i].plain);
  if (items) vs_store_realloc(s->store, items, (count + 1) * sizeof *items, 0);
  if (ok || !drawn) return drawn;
  for (size_t i = 0; i < named; i++) vs_node_release(drawn[i].node);
  vs_store_realloc(s->store, drawn, (count + 1) * sizeof *drawn, 0);
  return NULL;
}

/* Divides all nodes of the drawing into pieces, and replaces the scene's drawn objects by one object for each part. */
static bool divide(parts_state *s, vs_scene *scene, bool parted) {
  bool ok = true;
  for (size_t k = 0; ok && k < s->order.count; k++)
    ok = vs_store_going(s->store, VS_ORDER_WORK, s->error) && enter(s, s->order.at[k].node, &s->entries[k]);
  s->member_count = 0;
  for (size_t i = 0; ok && i < scene->drawn_count; i++) ok = gather(s, scene->drawn[i]);
  vs_ref *drawn = ok && sort_members(s, true) ? make_drawn(s, parted) : NULL;
  if (!drawn) return false;
  for (size_t i = 0; i < scene->drawn_count; i++) vs_node_release(scene->drawn[i].node);
  vs_store_realloc(s->store, scene->drawn, scene->drawn_room * sizeof *scene->drawn, 0);
  scene->drawn = drawn, scene->drawn_count = s->bucket_count, scene->drawn_room = s->bucket_count + 1;
  return true;
}

bool vs_scene_parts(vs_scene *scene, bool parted, vs_error *e) {
  bool sugar = false, any = false;
  for (size_t i = 0; i < scene->drawn_count; i++) sugar |= (scene->drawn[i].node->flags & VS_NODE_SUGAR) != 0;
  if (!sugar) return true;
  parts_state s = { .store = scene->store, .error = e, .order = { .store = scene->store },
                    .bounds = { .places.store = scene->store } };
  s.nothing = vs_store_text(s.store, "", 0);
  bool ok = (s.nothing || no_memory(&s)) && vs_order_make(&s.order, scene->drawn, scene->drawn_count, e);
  size_t count = s.order.count + 1;
  for (size_t k = 0; ok && k < s.order.count; k++) any |= s.order.at[k].node->kind == VS_PART;
  if (ok && any) {
    s.entries = vs_store_realloc(s.store, NULL, 0, count * sizeof *s.entries);
    ok = s.entries || no_memory(&s);
    for (size_t k = 0; ok && k < count; k++) s.entries[k] = (parts_entry){ 0 };
    ok = ok && divide(&s, scene, parted);
  }
  for (size_t i = 0; i < s.piece_count; i++) vs_node_release(s.pieces[i].ref.node);
  for (size_t k = 0; s.entries && k < count; k++) vs_node_release(s.entries[k].bare);
  if (s.entries) vs_store_realloc(s.store, s.entries, count * sizeof *s.entries, 0);
  if (s.pieces) vs_store_realloc(s.store, s.pieces, s.piece_room * sizeof *s.pieces, 0);
  if (s.members) vs_store_realloc(s.store, s.members, s.member_room * sizeof *s.members, 0);
  if (s.buckets) vs_store_realloc(s.store, s.buckets, s.bucket_room * sizeof *s.buckets, 0);
  if (s.kids) vs_store_realloc(s.store, s.kids, s.kid_room * sizeof *s.kids, 0);
  vs_bounds_memo_free(&s.bounds);
  vs_order_free(&s.order);
  return ok;
}
