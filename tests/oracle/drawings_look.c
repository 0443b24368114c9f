/* Computes the meaning of a random drawing, independent of the form of its tree: see drawings.h.
 *
 * A look is the tree with a separate copy for every path: sets and, below them, parts. A part is a primitive with the
 * placement, paint and wrapper nodes of its path. Two looks are compared part by part, and at points.
 *
 * A point belongs to the first member of a union that contains it, to all members of an intersection, and to the
 * minuend of a difference. A point that a difference removes belongs to the first subtrahend that contains it. The
 * comparison detects every pass that changes an order, a paint or a part's placement. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/oracle/drawings.h"

#include "model/order.h"

enum { PARTS_MOST = 1500, WINNERS = 6 };

typedef struct {
  const vs_node *node;
  vs_affine map;           /* transformation from the primitive's coordinates to the drawing's coordinates */
  vs_affine back;
  const vs_material *material; /* innermost material on the path; NULL if the path has none */
  const char *layer;
  uint64_t wrapper;          /* hash of the kinds of the native, custom, highlight, only and ghost nodes on the path, in
                              * order */
  vs_bounds bounds;
  size_t path, path_count; /* range in `paths` that contains the origins of the references from the root to the
                            * primitive */
  size_t shared;           /* index on the path of the first node with several users; path_count if there is no such
                            * node */
  vs_inside *inside;       /* function that tests whether a point is inside; NULL if the part contains no point */
  bool ghost;
  uint32_t coins;
} part;

typedef struct { const vs_node *node; size_t part; /* part: 1 + index of the part, or 0 if the entry is a set */ size_t next; /* next:
                                                                                                             * index of
                                                                                                             * the entry
                                                                                                             * after all
                                                                                                             * descendants
                                                                                                             * of this
                                                                                                             * entry */ } entry;

struct drawing_look {
  entry *entries;
  size_t entry_count, entry_room;
  part *parts;
  size_t part_count, part_room;
  const vs_origin **paths;
  size_t path_count, path_room;
  int trial;     /* -1: points are tested by the geometry of parts. Otherwise bit `trial` of a part's random bits
                  * decides whether the part contains a point */
  size_t *match; /* match[i]: index of the other look's part that equals part i (drawing_same_parts) */
};

/* ---- cached inside-tests of nodes ---- */

typedef struct { vs_node *node; vs_inside *inside; } asked;
typedef struct { vs_node *node; vs_affine map; vs_bounds bounds; } bounded;
struct drawing_memo {
  asked *asked;
  size_t asked_count, asked_room;
  bounded *bounded;
  size_t bounded_count, bounded_room;
};

static void grow(void *array, size_t *room, size_t count, size_t size) {
  void *old;
  if (count < *room) return;
  memcpy(&old, array, sizeof old);
  *room = *room ? *room * 2 : 64;
  old = realloc(old, *room * size);
  if (!old) abort();
  memcpy(array, &old, sizeof old);
}

drawing_memo *drawing_memo_new(void) {
  drawing_memo *m = calloc(1, sizeof *m);
  if (!m) abort();
  return m;
}

void drawing_memo_free(drawing_memo *m) {
  for (size_t i = 0; i < m->asked_count; i++) {
    vs_inside_free(m->asked[i].inside);
    vs_node_release(m->asked[i].node);
  }
  for (size_t i = 0; i < m->bounded_count; i++) vs_node_release(m->bounded[i].node);
  free(m->asked);
  free(m->bounded);
  free(m);
}

static vs_inside *inside_of(drawing_memo *m, const vs_node *n) {
  if (n->class_ != VS_SOLID) return NULL;
  for (size_t i = 0; i < m->asked_count; i++)
    if (m->asked[i].node == n) return m->asked[i].inside;
  grow(&m->asked, &m->asked_room, m->asked_count, sizeof *m->asked);
  m->asked[m->asked_count] = (asked){ vs_node_retain((vs_node *)(uintptr_t)n), vs_inside_new(n, NULL) };
  return m->asked[m->asked_count++].inside;
}

static vs_bounds bounds_of(drawing_memo *m, const vs_node *n, const vs_affine *map) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < m->bounded_count; i++)
    if (m->bounded[i].node == n && !memcmp(&m->bounded[i].map, map, sizeof *map)) return m->bounded[i].bounds;
  vs_node *placed = vs_node_new(n->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = *map }, &(vs_ref){ (vs_node *)(uintptr_t)n, NULL }, 1);
  if (!placed) abort();
  if (!vs_node_bounds(placed, &b, NULL)) b = vs_bounds_empty();
  vs_node_release(placed);
  grow(&m->bounded, &m->bounded_room, m->bounded_count, sizeof *m->bounded);
  m->bounded[m->bounded_count++] = (bounded){ vs_node_retain((vs_node *)(uintptr_t)n), *map, b };
  return b;
}

/* ---- making a look ---- */

typedef struct {
  drawing_look *look;
  drawing_memo *memo;
  const vs_order *order;
  const vs_origin *path[256];
  size_t depth, shared;
} looker;


static void look_part(looker *w, vs_ref ref, const part *here) {
  drawing_look *l = w->look;
  grow(&l->parts, &l->part_room, l->part_count, sizeof *l->parts);
  part *p = &l->parts[l->part_count++];
  *p = *here;
  p->node = ref.node;
  if (!vs_affine_invert(&p->map, &p->back)) p->back = vs_affine_identity();
  p->bounds = bounds_of(w->memo, ref.node, &p->map);
  p->path = l->path_count;
  p->path_count = w->depth;
  p->shared = w->shared < w->depth ? w->shared : w->depth;
  for (size_t i = 0; i < w->depth; i++) {
    grow(&l->paths, &l->path_room, l->path_count, sizeof *l->paths);
    l->paths[l->path_count++] = w->path[i];
  }
}

static bool look_at(looker *w, vs_ref ref, part here) { /* test trees are shallow, so recursion is safe */
  drawing_look *l = w->look;
  const vs_node *n = ref.node;
  if (l->part_count >= PARTS_MOST || l->entry_count >= 4 * PARTS_MOST || w->depth == sizeof w->path / sizeof *w->path) return false;
  size_t was_shared = w->shared;
  bool ok = true;
  w->path[w->depth++] = ref.origin;
  if (vs_order_uses(w->order, n) > 1 && w->shared > w->depth - 1) w->shared = w->depth - 1;
  if (n->kind == VS_TRANSFORM) here.map = vs_affine_multiply(&here.map, &VS_AS(transform, n)->matrix);
  if (n->kind == VS_MATERIAL) here.material = VS_AS(material, n)->material;
  if (n->kind == VS_LAYER) here.layer = VS_AS(layer, n)->name;
  bool through = n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER || vs_kind_get((vs_kind)n->kind)->level == VS_LEVEL_SUGAR;
  if (vs_kind_get((vs_kind)n->kind)->level == VS_LEVEL_SUGAR) { /* adds the wrapper node's kind to the hash; a native
                                                                 * node is also a part */
    here.wrapper = here.wrapper * 31 + n->kind + 1;
    here.ghost = here.ghost || n->kind == VS_GHOST;
    if (n->kind == VS_NATIVE) look_part(w, ref, &here);
  }
  if (through) {
    for (uint32_t i = 0; ok && i < n->child_count; i++) ok = look_at(w, n->children[i], here);
  } else if (n->kind != VS_EMPTY) {
    size_t at = l->entry_count++;
    grow(&l->entries, &l->entry_room, l->entry_count, sizeof *l->entries);
    l->entries[at] = (entry){ n, 0, 0 };
    if (vs_node_is_set(n)) {
      for (uint32_t i = 0; ok && i < n->child_count; i++) {
        /* Empty members keep their position: the first member of a difference is the minuend */
        size_t before = l->entry_count;
        ok = look_at(w, n->children[i], here);
        if (ok && l->entry_count == before) {
          grow(&l->entries, &l->entry_room, l->entry_count + 1, sizeof *l->entries);
          l->entries[before] = (entry){ NULL, 0, before + 1 };
          l->entry_count++;
        }
      }
    } else {
      here.inside = here.ghost ? NULL : inside_of(w->memo, n);
      look_part(w, ref, &here);
      l->entries[at].part = l->part_count;
    }
    l->entries[at].next = l->entry_count;
  }
  w->depth--;
  w->shared = was_shared;
  return ok;
}

drawing_look *drawing_look_new(const drawing *d, drawing_memo *m) {
  drawing_look *l = calloc(1, sizeof *l);
  vs_order order = { .store = d->at[0].node->store };
  if (l) l->trial = -1;
  if (!l || !vs_order_make(&order, d->at, d->count, NULL)) abort();
  looker *w = calloc(1, sizeof *w);
  if (!w) abort();
  *w = (looker){ .look = l, .memo = m, .order = &order, .shared = SIZE_MAX };
  bool ok = true;
  for (size_t i = 0; ok && i < d->count; i++) ok = look_at(w, d->at[i], (part){ .map = vs_affine_identity() });
  free(w);
  vs_order_free(&order);
  if (ok) return l;
  drawing_look_free(l);
  return NULL;
}

void drawing_look_free(drawing_look *l) {
  if (!l) return;
  free(l->entries);
  free(l->parts);
  free(l->paths);
  free(l->match);
  free(l);
}

vs_vec3 drawing_look_point(const drawing_look *l, double which, double x, double y, double z) {
  vs_vec3 p = { 8 * x - 4, 8 * y - 4, 8 * z - 4 };
  const part *at = l->part_count ? &l->parts[(size_t)(which * (double)l->part_count)] : NULL;
  if (!at || vs_bounds_is_empty(&at->bounds) || !isfinite(vs_bounds_diagonal(&at->bounds))) return p;
  vs_bounds both = at->bounds, *b = &both;
  /* mostly chooses a point in the overlap of this part and the next, where faults are more likely */
  if (at + 1 < l->parts + l->part_count && x + y < z + 1) vs_bounds_meet(&both, &at[1].bounds);
  if (vs_bounds_is_empty(&both)) both = at->bounds;
  return vs_v3(b->min.x + x * (b->max.x - b->min.x), b->min.y + y * (b->max.y - b->min.y), b->min.z + z * (b->max.z - b->min.z));
}

/* ---- comparing parts ---- */

static const char *name_of(const part *p) { return vs_kind_get((vs_kind)p->node->kind)->name; }

/* Returns true if the bounds of a placed node n are only approximate: computed from the corners of another bounding
 * box, or from sample points. A pass that applies the placement to n itself makes such bounds tighter. */
static bool bounds_are_loose(const vs_node *n) {
  return n->kind == VS_SPLINE || n->child_count > 0;
}

static bool near(vs_vec3 a, vs_vec3 b, double slack) { return fabs(a.x - b.x) <= slack && fabs(a.y - b.y) <= slack && fabs(a.z - b.z) <= slack; }

static bool same_bounds(const part *a, const part *b) { /* Compares the bounds of the parts a, before the pass, and b,
                                                         * after the pass */
  vs_bounds x = a->bounds, y = b->bounds;
  if (vs_bounds_is_empty(&x) || vs_bounds_is_empty(&y)) return vs_bounds_is_empty(&x) == vs_bounds_is_empty(&y);
  if (a->node->kind == VS_HALF_SPACE) { /* a half-space is compared by its plane */
    vs_vec3 p = VS_AS(half_space, a->node)->point, n = VS_AS(half_space, a->node)->normal, q = VS_AS(half_space, b->node)->point, k = VS_AS(half_space, b->node)->normal;
    return vs_affine_plane(&a->map, &p, &n) && vs_affine_plane(&b->map, &q, &k) && near(vs_v3_unit(n), vs_v3_unit(k), 1e-9) &&
           fabs(vs_v3_dot(vs_v3_unit(n), vs_v3_sub(p, q))) < 1e-9 * (1 + vs_v3_length(p) + vs_v3_length(q));
  }
  double size = 1 + vs_v3_length(x.min) + vs_v3_length(x.max), slack = 1e-9 * size;
  if (!bounds_are_loose(a->node)) return near(x.min, y.min, slack) && near(x.max, y.max, slack);
  slack = 1e-4 * size;
  return y.min.x >= x.min.x - slack && y.min.y >= x.min.y - slack && y.min.z >= x.min.z - slack && y.max.x <= x.max.x + slack && y.max.y <= x.max.y + slack && y.max.z <= x.max.z + slack;
}

static bool same_map(const vs_affine *a, const vs_affine *b) {
  for (int i = 0; i < 12; i++)
    if (fabs(a->m[i / 4][i % 4] - b->m[i / 4][i % 4]) > 1e-9 * (1 + fabs(a->m[i / 4][i % 4]))) return false;
  return true;
}

/* Returns six times the volume that the part's faces enclose; negative if the faces point inwards. Meshing reverses the
 * faces of a mirrored part. */
static double facing(const part *p) {
  const struct vs_polyface_mesh *m = VS_AS(polyface_mesh, p->node);
  const uint32_t *starts = vs_faces_starts(m->faces), *corners = vs_faces_corners(m->faces);
  double six = 0;
  for (uint32_t f = 0; f < m->faces->count; f++)
    for (uint32_t i = starts[f] + 1; i + 1 < starts[f + 1]; i++)
      six += vs_v3_dot(m->points->at[corners[starts[f]]], vs_v3_cross(m->points->at[corners[i]], m->points->at[corners[i + 1]]));
  return six;
}

static bool holds_at(const part *x, vs_vec3 p) { return vs_inside_test(x->inside, vs_affine_point(&x->back, p)); }

static bool same_inside(const part *a, const part *b) {
  if (a->node->kind == VS_POLYFACE_MESH && VS_AS(polyface_mesh, a->node)->closed && (facing(a) > 0) != (facing(b) > 0)) return false;
  if (!a->inside || !b->inside) return a->inside == b->inside;
  if (a->node == b->node && !memcmp(&a->map, &b->map, sizeof a->map)) return true;
  vs_bounds box = a->node->kind == VS_HALF_SPACE ? (vs_bounds){ { -4, -4, -4 }, { 4, 4, 4 } } : a->bounds;
  if (vs_bounds_is_empty(&box)) return true;
  for (int i = 0; i < 7; i++) { /* compares seven points of Halton's sequence, which covers the box evenly */
    double at[3], step = 1e-4 * vs_bounds_diagonal(&box);
    static const int bases[] = { 2, 3, 5 };
    for (int axis = 0; axis < 3; axis++) {
      double f = 1;
      at[axis] = 0.013;
      for (int k = i + 1; k; k /= bases[axis]) at[axis] += (f /= bases[axis]) * (k % bases[axis]);
    }
    vs_vec3 p = { box.min.x + at[0] * (box.max.x - box.min.x), box.min.y + at[1] * (box.max.y - box.min.y), box.min.z + at[2] * (box.max.z - box.min.z) };
    bool was = holds_at(a, p), close = false;
    if (was == holds_at(b, p)) continue;
    for (int k = 0; !close && k < 27; k++)
      close = holds_at(a, vs_v3(p.x + (k % 3 - 1) * step, p.y + (k / 3 % 3 - 1) * step, p.z + (k / 9 - 1) * step)) != was;
    if (!close) return false;
  }
  return true;
}

/* Returns the name of the first property in which the parts a and b differ, or NULL if they are equal. */
static const char *difference_of(const part *a, const part *b) {
  if (a->node->kind != b->node->kind) return "kind";
  if (a->material != b->material) return "material";
  if (a->layer != b->layer) return "layer";
  if (a->wrapper != b->wrapper) return "wrapper";
  if (a->node->kind == VS_NATIVE) return VS_AS(native, a->node)->code == VS_AS(native, b->node)->code && same_map(&a->map, &b->map) ? NULL : "place of native text";
  const vs_kind_info *info = vs_kind_get((vs_kind)a->node->kind);
  for (size_t i = 0; i < info->field_count; i++) { /* compares the fields that no transformation changes */
    const char *x = (const char *)vs_node_data(a->node) + info->fields[i].offset, *y = (const char *)vs_node_data(b->node) + info->fields[i].offset;
    vs_field_type type = info->fields[i].type;
    size_t size = type == VS_FIELD_integer ? sizeof(vs_field_integer) : type == VS_FIELD_boolean ? sizeof(vs_field_boolean) : type == VS_FIELD_text ? sizeof(vs_field_text) : 0;
    if (memcmp(x, y, size) != 0) return info->fields[i].argument;
  }
  return !same_bounds(a, b) ? "bounds" : same_inside(a, b) ? NULL : "shape";
}

static uint32_t line_at(const drawing_look *l, const part *p, size_t i) { return l->paths[p->path + i] ? l->paths[p->path + i]->line : 0; }

/* Returns a description of the fault in the origins of b, or NULL if there is none. b is the part of `after` that
 * equals the part a of `before`.
 *
 * Consider the references on b's path, up to the first node with several users (a template). Their origins must occur,
 * in order, on a's path. With `pruned` only the first must, because the pass may have removed the place from which a
 * template was made. The primitive keeps its origin, unless it is in a template or the pass has made templates
 * (`made`). */
static const char *origin_trouble(const drawing_look *before, const part *a, const drawing_look *after, const part *b, bool made, bool pruned) {
  size_t last = b->path_count - 1, k = 0;
  for (size_t i = 0; i <= last; i++)
    if (!line_at(after, b, i)) return "a reference has no origin";
  size_t own = b->shared < last ? b->shared : last;
  for (size_t i = 0; i <= own; i++) {
    while (k < a->path_count && line_at(before, a, k) != line_at(after, b, i)) k++;
    if (k == a->path_count && (!pruned || i == 0)) return "a reference has the origin of another";
  }
  if (!made && a->shared >= a->path_count && b->shared > last && line_at(before, a, a->path_count - 1) != line_at(after, b, last)) return "the primitive has another origin";
  return NULL;
}

bool drawing_same_parts(const drawing_look *before, const drawing_look *after, bool less, bool templates, char *why, size_t room) {
  size_t k = 0;
  drawing_look *later = (drawing_look *)(uintptr_t)after;
  free(later->match);
  later->match = calloc(after->part_count + 1, sizeof *later->match);
  if (!later->match) abort();
  for (size_t i = 0; i < after->part_count; i++, k++) {
    const part *b = &after->parts[i];
    const char *what = k < before->part_count ? difference_of(&before->parts[k], b) : "number";
    const char *first = what;
    size_t at = k;
    while (less && what && k + 1 < before->part_count) what = difference_of(&before->parts[++k], b);
    if (what || k >= before->part_count) {
      const part *a = at < before->part_count ? &before->parts[at] : NULL;
      snprintf(why, room, "part %zu, %s of line %u: another %s (it was part %zu, %s of line %u)", i, name_of(b), (unsigned)line_at(after, b, b->path_count - 1), first ? first : "?", at,
               a ? name_of(a) : "none", a ? (unsigned)line_at(before, a, a->path_count - 1) : 0u);
      return false;
    }
    what = origin_trouble(before, &before->parts[k], after, b, templates, templates && less);
    /* if parts may be missing, b may equal a later part of `before`: tries the next equal part */
    for (size_t other = k + 1; what && less && other < before->part_count; other++)
      if (!difference_of(&before->parts[other], b) && !origin_trouble(before, &before->parts[other], after, b, templates, templates && less)) what = NULL, k = other;
    if (what) {
      snprintf(why, room, "part %zu, %s of line %u: %s", i, name_of(b), (unsigned)line_at(before, &before->parts[k], before->parts[k].path_count - 1), what);
      return false;
    }
    later->match[i] = k;
  }
  if (!less && k != before->part_count) {
    snprintf(why, room, "there were %zu parts, and are %zu", before->part_count, after->part_count);
    return false;
  }
  return true;
}

/* ---- comparing at points ---- */

typedef struct { bool in; size_t count, who[WINNERS]; } verdict;

static size_t next_of(const drawing_look *l, size_t at) { return l->entries[at].next; }

static void add_winners(verdict *v, const verdict *more) {
  for (size_t i = 0; i < more->count && v->count < WINNERS; i++) v->who[v->count++] = more->who[i];
}

static verdict verdict_at(const drawing_look *l, size_t at, vs_vec3 p) {
  const entry *e = &l->entries[at];
  verdict v = { 0 };
  if (!e->node) return v;
  if (e->part) {
    const part *x = &l->parts[e->part - 1];
    v.in = l->trial >= 0 ? x->inside && x->coins >> l->trial & 1 : x->inside && vs_inside_test(x->inside, vs_affine_point(&x->back, p));
    if (v.in) v.who[v.count++] = e->part - 1;
    return v;
  }
  size_t first = at + 1;
  if (e->node->kind == VS_DIFFERENCE) {
    if (first < e->next) v = verdict_at(l, first, p);
    for (size_t k = v.in ? next_of(l, first) : e->next; k < e->next; k = next_of(l, k)) {
      verdict cut = verdict_at(l, k, p);
      if (!cut.in) continue;
      cut.in = false;
      return cut;
    }
    return v;
  }
  if (e->node->kind == VS_INTERSECTION) {
    bool all = first < e->next;
    for (size_t k = first; all && k < e->next; k = next_of(l, k)) {
      verdict x = verdict_at(l, k, p);
      if (next_of(l, first) == e->next) return x;
      all = x.in;
      add_winners(&v, &x);
    }
    v.in = all;
    if (!all) v.count = 0;
    return v;
  }
  for (size_t k = first; k < e->next; k = next_of(l, k)) {
    verdict x = verdict_at(l, k, p);
    if (x.in) return x;
    if (!v.count) v = x;
  }
  return v;
}

static verdict verdict_of(const drawing_look *l, vs_vec3 p) { /* a drawing is the union of its top-level entries, so the
                                                               * first entry that contains p decides */
  verdict v = { 0 };
  for (size_t k = 0; k < l->entry_count; k = next_of(l, k)) {
    verdict x = verdict_at(l, k, p);
    if (x.in) return x;
    if (!v.count) v = x;
  }
  return v;
}

static bool verdicts_equal(const verdict *a, const drawing_look *before, const verdict *b, const size_t *match) {
  if (a->in != b->in || a->count != b->count) return false;
  for (size_t i = 0; i < a->count; i++)
    if (difference_of(&before->parts[a->who[i]], &before->parts[match ? match[b->who[i]] : b->who[i]])) return false;
  return true;
}

/* Compares two looks as combinations of parts of any shape: a random bit decides whether a part contains a point. */
bool drawing_same_sets(drawing_look *before, drawing_look *after, uint64_t seed, char *why, size_t room) {
  bool same = true;
  for (size_t i = 0; i < before->part_count; i++) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    before->parts[i].coins = (uint32_t)(seed >> 32);
  }
  for (size_t i = 0; i < after->part_count; i++) after->parts[i].coins = before->parts[after->match[i]].coins;
  for (before->trial = after->trial = 0; same && before->trial < 32; before->trial++, after->trial++) {
    verdict a = verdict_of(before, vs_v3(0, 0, 0)), b = verdict_of(after, vs_v3(0, 0, 0));
    same = a.in == b.in && a.count == b.count;
    for (size_t i = 0; same && i < a.count; i++) same = a.who[i] == after->match[b.who[i]];
    if (!same) snprintf(why, room, "of other parts it would be another set: part %d, now part %d", a.count ? (int)a.who[0] : -1, b.count ? (int)after->match[b.who[0]] : -1);
  }
  before->trial = after->trial = -1;
  return same;
}

bool drawing_same_at(drawing_look *before, drawing_look *after, vs_vec3 p, bool *inside, bool *close, char *why, size_t room) {
  const double step = 2e-3;
  verdict a = verdict_of(before, p), b = verdict_of(after, p);
  *inside = a.in;
  *close = false;
  if (verdicts_equal(&a, before, &b, after->match)) return true;
  for (int i = 0; i < 26; i++) { /* tests 26 points of a cube around p, to detect a surface close to p */
    int k = i < 13 ? i : i + 1;
    verdict there = verdict_of(before, vs_v3(p.x + (k % 3 - 1) * step, p.y + (k / 3 % 3 - 1) * step, p.z + (k / 9 - 1) * step));
    if (verdicts_equal(&a, before, &there, NULL)) continue;
    *close = true;
    return true;
  }
  snprintf(why, room, "at %.4f %.4f %.4f it was %s by part %d, and is %s by part %d", p.x, p.y, p.z, a.in ? "inside" : "outside", a.count ? (int)a.who[0] : -1, b.in ? "inside" : "outside",
           b.count ? (int)after->match[b.who[0]] : -1);
  return false;
}
