/* Implements nodes and the arrays they share: creating, retaining, releasing, comparing.
 *
 * A node is one allocation: header, children, payload. Releasing a node needs neither memory nor recursion: the hash
 * member of each dead node links it to the next node to be freed. Comparing stores the pairs of nodes that were already
 * found equal. Two separately built DAGs of n nodes therefore cost n comparisons, not one for every path. */
#include "model/node.h"

#include <string.h>

#include "model/kinds.h"
#include "model/store/store_inside.h"
#include "model/store/piece.h"

/* ---- arrays ---- */

size_t vs_points_bytes(const vs_points *p) { return sizeof *p + p->count * sizeof *p->at; }
size_t vs_faces_bytes(const vs_faces *f) {
  return sizeof *f + (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data;
}

vs_points *vs_points_new(vs_store *s, const vs_vec3 *at, size_t count) {
  if (count > UINT32_MAX || count > SIZE_MAX / sizeof *at - 1) return NULL;
  vs_points *p = vs_store_realloc(s, NULL, 0, sizeof *p + count * sizeof *at);
  if (!p) return NULL;
  p->refs = 1;
  p->count = (uint32_t)count;
  for (size_t i = 0; i < count; i++) p->at[i] = vs_v3(at[i].x + 0.0, at[i].y + 0.0, at[i].z + 0.0); /* adding 0.0
                                                                                                     * changes -0 to 0,
                                                                                                     * so that equal
                                                                                                     * coordinates have
                                                                                                     * equal bits */
  return p;
}

static void faces_settle(vs_faces *f) {
  f->hash = vs_hash_bytes(8, f->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data);
}

vs_faces *vs_faces_new(vs_store *s, const uint32_t *starts, size_t count, const uint32_t *corners,
                       size_t corner_count) {
  if (count >= UINT32_MAX || corner_count > UINT32_MAX || count + corner_count > SIZE_MAX / sizeof *starts - 8)
    return NULL;
  vs_faces *f = vs_store_realloc(s, NULL, 0, sizeof *f + (count + 1 + corner_count) * sizeof *starts);
  if (!f) return NULL;
  f->refs = 1;
  f->count = (uint32_t)count;
  f->corner_count = (uint32_t)corner_count;
  memcpy(f->data, starts, (count + 1) * sizeof *starts);
  if (corner_count) memcpy(f->data + count + 1, corners, corner_count * sizeof *corners);
  faces_settle(f);
  return f;
}

vs_faces *vs_faces_turned(vs_store *s, const vs_faces *old) {
  vs_faces *f = vs_faces_new(s, vs_faces_starts(old), old->count, vs_faces_corners(old), old->corner_count);
  if (!f) return NULL;
  uint32_t *corners = f->data + f->count + 1;
  for (uint32_t i = 0; i < f->count; i++)
    for (uint32_t a = f->data[i] + 1, b = f->data[i + 1]; a + 1 < b; a++) { /* divides a face with more than three
                                                                             * corners into triangles that all have its
                                                                             * first corner */
      uint32_t swap = corners[a];
      corners[a] = corners[--b];
      corners[b] = swap;
    }
  faces_settle(f);
  return f;
}

vs_points *vs_points_retain(vs_points *p) {
  VS_ASSERT(p->refs > 0);
  p->refs++;
  return p;
}

vs_faces *vs_faces_retain(vs_faces *f) {
  VS_ASSERT(f->refs > 0);
  f->refs++;
  return f;
}

/* Releases a reference to a shared array, and frees the array after the last. Nodes refer to it as const, but its
 * reference count changes. */
void vs_points_release(vs_store *s, const vs_points *p) {
  vs_points *mine = (vs_points *)(uintptr_t)p;
  if (mine && !--mine->refs) vs_store_realloc(s, mine, vs_points_bytes(mine), 0);
}

void vs_faces_release(vs_store *s, const vs_faces *f) {
  vs_faces *mine = (vs_faces *)(uintptr_t)f;
  if (mine && !--mine->refs) vs_store_realloc(s, mine, vs_faces_bytes(mine), 0);
}

vs_ticket *vs_ticket_new(vs_store *s, uint32_t id) {
  vs_ticket *t = vs_store_realloc(s, NULL, 0, sizeof *t);
  if (t) *t = (vs_ticket){ 1, id };
  return t;
}

void vs_ticket_release(vs_store *s, const vs_ticket *t) {
  vs_ticket *mine = (vs_ticket *)(uintptr_t)t;
  if (!mine || --mine->refs) return;
  if (s->ticket_gone) s->ticket_gone(s->ticket_context, mine->id);
  vs_store_realloc(s, mine, sizeof *mine, 0);
}

/* ---- creating nodes ---- */

static size_t node_payload_room(const vs_kind_info *info) { return (info->size + 7) & ~(size_t)7; }
static size_t node_size(const vs_kind_info *info, size_t children) {
  return sizeof(vs_node) + node_payload_room(info) + children * sizeof(vs_ref);
}

static bool node_is_planar_area(const vs_node *n) {
  return n->class_ == VS_REGION_CLASS || (n->class_ == VS_CURVE && n->flags & VS_NODE_CLOSED);
}

/* Properties that a node's children have in common. They are collected while the children are copied, so that even a
 * million children are visited only once. */
typedef struct {
  vs_class together; /* class of all children (such as solid), or VS_MIXED if they differ; children that draw nothing
                      * are ignored */
  bool nothing;      /* true if at least one child is empty or otherwise draws nothing */
  uint8_t any, all;  /* any: flags (VS_NODE_...) that at least one child has; all: flags that all children have */
} vs_node_family;

static void node_join_family(vs_node_family *f, const vs_node *child) {
  vs_class c = (vs_class)child->class_;
  f->any |= child->flags;
  f->all &= child->flags;
  if (c == VS_NOTHING) f->nothing = true;
  else if (f->together == VS_NOTHING) f->together = c;
  else if (f->together != c) f->together = VS_MIXED;
}

/* Returns true if all children are curves, regions or empty. Surfaces do not count: only the mesh of a surface shows
 * whether it is flat. */
static bool node_holds_planar(const vs_node *n) {
  bool planar = true;
  for (uint32_t i = 0; planar && i < n->child_count; i++) {
    vs_class c = (vs_class)n->children[i].node->class_;
    planar = c == VS_CURVE || c == VS_REGION_CLASS || c == VS_NOTHING;
  }
  return planar;
}

static void node_find_end(vs_node *n, const vs_node_family *f) {
  bool cut = n->kind == VS_HALF_SPACE || f->any & VS_NODE_CUT;
  bool carved =
      (n->class_ == VS_SOLID && (n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE)) || f->any & VS_NODE_CARVED;
  bool meshed = carved || (n->class_ == VS_REGION_CLASS && !node_holds_planar(n)); /* true if the corners of some part
                                                                                    * of the hull can only be computed
                                                                                    * from a solid's mesh */
  bool unresolved =
      vs_node_has(n, VS_IS_UNRESOLVED) || f->any & VS_NODE_UNRESOLVED || (n->kind == VS_HULL && meshed);
  bool first = n->child_count && n->children[0].node->flags & VS_NODE_ENDLESS,
       all = n->child_count && f->all & VS_NODE_ENDLESS;
  bool is = n->kind == VS_HALF_SPACE || (n->kind == VS_INTERSECTION ? all
                                         : n->kind == VS_DIFFERENCE ? first
                                                                    : f->any & VS_NODE_ENDLESS);
  n->flags = (uint8_t)((n->flags & VS_NODE_CLOSED) | (is ? VS_NODE_ENDLESS : 0) | (cut ? VS_NODE_CUT : 0) |
                       (unresolved ? VS_NODE_UNRESOLVED : 0) | (carved ? VS_NODE_CARVED : 0));
}

static void node_classify(vs_node *n, const vs_kind_info *info, const vs_node_family *family) {
  const vs_node *first = n->child_count ? n->children[0].node : NULL;
  n->class_ = (uint8_t)info->class_;
  switch ((vs_kind)n->kind) {
#include "model/cases/shape_cases.def"
    case VS_EMPTY: case VS_GHOST: case VS_ARC: break;
    case VS_LINE: if (VS_AS(line, n)->closed) n->flags |= VS_NODE_CLOSED; break;
    case VS_SPLINE: if (VS_AS(spline, n)->closed) n->flags |= VS_NODE_CLOSED; break;
    case VS_CIRCLE: case VS_REGION: case VS_TEXT: n->flags |= VS_NODE_CLOSED; break;
    case VS_POLYFACE_MESH: n->class_ = VS_AS(polyface_mesh, n)->closed ? VS_SOLID : VS_SURFACE; break;
    case VS_EXTRUDE: case VS_SWEEP: case VS_REVOLVE:
      n->class_ = !first || first->class_ == VS_NOTHING ? VS_NOTHING
                  : node_is_planar_area(first)          ? VS_SOLID
                                                        : VS_SURFACE;
      break;
    case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: { /* ignores a section that is a single point, because it has
                                                              * no class */
      bool areas = false;
      uint32_t sections = n->kind == VS_GUIDED_LOFT ? (uint32_t)VS_AS(guided_loft, n)->section_count : n->child_count;
      for (uint32_t i = 0; i < sections && i < n->child_count; i++)
        areas = areas || node_is_planar_area(n->children[i].node);
      n->class_ = areas ? VS_SOLID : VS_SURFACE;
      break;
    }
    case VS_GRID_MESH: n->class_ = VS_AS(grid_mesh, n)->closed ? VS_SOLID : VS_SURFACE; break;
    case VS_GRID_SURFACE: n->class_ = VS_AS(grid_surface, n)->closed ? VS_SOLID : VS_SURFACE; break;
    case VS_JOIN: if (VS_AS(join, n)->closed) n->flags |= VS_NODE_CLOSED; break;
    case VS_XLINE: case VS_RAY: break;
    case VS_SECTION: case VS_PROJECT: case VS_EDGES:
      if (!first || first->class_ == VS_NOTHING) n->class_ = VS_NOTHING;
      else if (n->class_ == VS_REGION_CLASS) n->flags |= VS_NODE_CLOSED;
      break;
    case VS_OFFSET:
      n->class_ = !first || first->class_ == VS_NOTHING                          ? VS_NOTHING
                  : VS_AS(offset, n)->filled || first->class_ == VS_REGION_CLASS ? VS_REGION_CLASS
                                                                                 : VS_CURVE;
      if (n->class_ == VS_REGION_CLASS || (n->class_ == VS_CURVE && first->flags & VS_NODE_CLOSED))
        n->flags |= VS_NODE_CLOSED;
      break;
    case VS_THICKEN: if (!first || first->class_ == VS_NOTHING) n->class_ = VS_NOTHING; break;
    case VS_CUSTOM: case VS_NATIVE: /* a child of unknown kind counts as a solid */
      if (!first || (n->kind == VS_NATIVE && first->class_ == VS_NOTHING)) {
        n->class_ = VS_SOLID;
        break;
      } /* fall through */
    case VS_TRANSFORM: case VS_MATERIAL: case VS_LAYER: case VS_PART: case VS_HIGHLIGHT: case VS_ONLY:
      n->class_ = first ? first->class_ : VS_NOTHING;
      n->flags |= first ? first->flags & VS_NODE_CLOSED : 0;
      break;
    case VS_SLICE: case VS_DEFORM:
      n->class_ = first ? first->class_ : VS_NOTHING;
      if (n->class_ == VS_REGION_CLASS) n->flags |= VS_NODE_CLOSED;
      break;
    case VS_HULL:
      n->class_ = VS_AS(hull, n)->dimension == 3 ? VS_SOLID : VS_REGION_CLASS;
      if (n->class_ == VS_REGION_CLASS) n->flags |= VS_NODE_CLOSED;
      break;
    case VS_UNION: /* a union of closed curves stays a curve, because only regions are filled */
      n->class_ = (uint8_t)family->together;
      if (family->together == VS_REGION_CLASS) n->flags |= VS_NODE_CLOSED;
      break;
    case VS_INTERSECTION: case VS_DIFFERENCE:
      n->class_ = first ? first->class_ : VS_NOTHING;
      if (first && node_is_planar_area(first)) {
        n->class_ = VS_REGION_CLASS;
        n->flags |= VS_NODE_CLOSED;
      }
      if (n->kind == VS_INTERSECTION && family->nothing) n->class_ = VS_NOTHING;
      break;
    case VS_KIND_COUNT: break;
  }
  if (n->child_count || n->kind == VS_HALF_SPACE || vs_node_has(n, VS_IS_UNRESOLVED)) node_find_end(n, family);
}

vs_node *vs_node_new(vs_store *s, vs_kind kind, const void *data, const vs_ref *children, size_t child_count) {
  const vs_kind_info *info = vs_kind_get(kind);
  if (!info || child_count > UINT32_MAX || child_count > (SIZE_MAX - node_size(info, 0)) / sizeof(vs_ref)) return NULL;
  vs_node *n = vs_store_piece(s, node_size(info, child_count));
  if (!n) return NULL;
  vs_ref *kept = (vs_ref *)(void *)(n + 1);
  void *payload = kept + child_count;
  if (data) memcpy(payload, data, info->size);
  else memset(payload, 0, info->size);
  uint64_t hash = vs_hash_mix(vs_hash_mix(4, (uint64_t)kind), vs_payload_settle(kind, payload)),
           form = vs_hash_mix(10, (uint64_t)kind);
  uint32_t depth = 1;
  vs_node_family family = { .together = VS_NOTHING, .all = UINT8_MAX };
  for (size_t i = 0; i < child_count; i++) {
    if (child_count - i > VS_NODES_AHEAD) __builtin_prefetch(children[i + VS_NODES_AHEAD].node);
    kept[i] = children[i];
    vs_node *child = vs_node_retain(kept[i].node);
    hash = vs_hash_mix(hash, child->hash);
    form = vs_hash_mix(form, child->form);
    if (child->depth >= depth) depth = child->depth == UINT32_MAX ? UINT32_MAX : child->depth + 1;
    node_join_family(&family, child);
  }
  bool same = child_count == 1 &&
              (kind == VS_TRANSFORM || kind == VS_UNION || kind == VS_INTERSECTION || kind == VS_DIFFERENCE);
  if (same) form = kept[0].node->form; /* a placed node, or a set of one child, has the same `form` (hash without
                                        * positions) as its child */
  n->refs = 1;
  n->kind = (uint16_t)kind;
  n->class_ = VS_NOTHING;
  n->flags = 0;
  n->child_count = (uint32_t)child_count;
  n->depth = depth;
  n->slot = 0;
  n->form = (uint32_t)form;
  n->hash = hash;
  n->store = vs_store_retain(s);
  node_classify(n, info, &family);
  n->flags |= family.any & (VS_NODE_SUGAR | VS_NODE_OPEN);
  if (info->level == VS_LEVEL_SUGAR) n->flags |= VS_NODE_SUGAR;
  if (kind == VS_CUSTOM && !child_count) n->flags |= VS_NODE_OPEN;
  return n;
}

vs_node *vs_node_retain(vs_node *n) {
  VS_ASSERT(n->refs > 0);
  n->refs++;
  return n;
}

void vs_node_release(vs_node *n) {
  if (!n || --n->refs || n->store->abandoned) return;
  vs_node *dead = n;
  n->hash = 0; /* From here on, the member `hash` is the link in the list of nodes to be freed. */
  while (dead) {
    n = dead;
    dead = (vs_node *)(uintptr_t)n->hash;
    const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
    vs_store *s = n->store;
    vs_payload_drop((vs_kind)n->kind, s, vs_node_data(n));
    for (uint32_t i = n->child_count; i-- > 0;) {
      vs_node *child = n->children[i].node;
      if (--child->refs) continue;
      child->hash = (uintptr_t)dead;
      dead = child;
    }
    vs_store_piece_free(s, n, node_size(info, n->child_count));
    vs_store_release(s);
  }
}

size_t vs_node_bytes(const vs_node *n) {
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  return node_size(info, n->child_count) + vs_payload_array_bytes((vs_kind)n->kind, vs_node_data(n));
}

/* ---- comparing nodes ---- */

typedef struct { const vs_node *a, *b; } vs_node_pair;
typedef struct { vs_store *store; vs_node_pair *at; size_t count, room; } vs_node_pairs;

static bool pairs_resize(vs_node_pairs *p, size_t room) {
  vs_node_pair *at = vs_store_realloc(p->store, p->at, p->room * sizeof *at, room * sizeof *at);
  if (room && !at) return false;
  p->at = at;
  p->room = room;
  return true;
}

/* Adds a pair of nodes to the set of pairs that were found equal. *new: false if the set already contained the pair.
 * Only nodes with several references can be in two pairs. Returns false when memory is out. */
static bool pairs_note(vs_node_pairs *set, vs_node_pair pair, bool *new) {
  if (set->count * 3 >= set->room * 2) {
    vs_node_pairs grown = { .store = set->store };
    if (!pairs_resize(&grown, set->room ? set->room * 2 : 64)) return false;
    memset(grown.at, 0, grown.room * sizeof *grown.at);
    for (size_t i = 0; i < set->room; i++)
      if (set->at[i].a && !pairs_note(&grown, set->at[i], new)) return false; /* copies the pairs into the larger table,
                                                                               * which has room for them, so the call
                                                                               * recurses no further */
    pairs_resize(set, 0);
    *set = grown;
  }
  size_t at = (size_t)vs_hash_mix((uintptr_t)pair.a, (uintptr_t)pair.b) & (set->room - 1);
  while (set->at[at].a && (set->at[at].a != pair.a || set->at[at].b != pair.b)) at = (at + 1) & (set->room - 1);
  *new = !set->at[at].a;
  if (*new) {
    set->at[at] = pair;
    set->count++;
  }
  return true;
}

/* Returns true if nodes a and b are equal, without comparing the contents of their children. */
static bool node_alike(const vs_node *a, const vs_node *b) {
  return a->hash == b->hash && a->kind == b->kind && a->child_count == b->child_count && a->depth == b->depth &&
         vs_payload_equal(vs_kind_get((vs_kind)a->kind), vs_node_data(a), vs_node_data(b));
}

bool vs_node_equal(const vs_node *a, const vs_node *b, bool *ok) {
  if (ok) *ok = true;
  if (a == b) return true;
  if (!node_alike(a, b)) return false;
  vs_node_pairs todo = { .store = a->store }, done = { .store = a->store };
  bool equal = true, memory = true, new;
  vs_node_pair now = { a, b };
  for (;;) {
    for (uint32_t i = 0; i < now.a->child_count && equal && memory; i++) {
      vs_node_pair next = { now.a->children[i].node, now.b->children[i].node };
      if (next.a == next.b) continue;
      equal = node_alike(next.a, next.b);
      if (!equal || !next.a->child_count) continue;
      if (next.a->refs > 1 && next.b->refs > 1) {
        memory = pairs_note(&done, next, &new);
        if (!memory || !new) continue;
      }
      memory = todo.count < todo.room || pairs_resize(&todo, todo.room ? todo.room * 2 : 64);
      if (memory) todo.at[todo.count++] = next;
    }
    if (!equal || !memory || !todo.count) break;
    now = todo.at[--todo.count];
  }
  pairs_resize(&todo, 0);
  pairs_resize(&done, 0);
  if (ok) *ok = memory;
  return equal && memory;
}
