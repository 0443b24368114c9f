/* Computes the differences between two drawings (changed_parts.h). Parts are paired by keys, which are hashes of
 * properties. The rules apply one after the other, each to the parts that are not yet paired. The first rule requires
 * that all properties are equal. The last requires only equal kind, form and look. */
#include "solids/changed_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "solids/solid_measures.h"
#include "solids/solid_meshes.h"
#include "model/walk.h"

enum { PART_WORK = 300 /* work for each part, in nanoseconds, passed to vs_store_going, which asks whether to stop */ };

/* ---- the parts of a drawing ---- */

static bool is_wrapper(const vs_node *n) {
  return n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
}

/* The placement, material and layer that a part inherits from the unions and wrappers around it. */
typedef struct { vs_affine place; const vs_material *material; const char *layer; } context;
typedef struct { context *at; size_t count, room; } context_stack;

static context inside_of(const context *c, const vs_node *n) {
  context in = *c;
  if (n->kind == VS_TRANSFORM) in.place = vs_affine_multiply(&c->place, &VS_AS(transform, n)->matrix);
  if (n->kind == VS_MATERIAL) in.material = VS_AS(material, n)->material;
  if (n->kind == VS_LAYER) in.layer = VS_AS(layer, n)->name;
  return in;
}

static bool take_part(vs_drawn_parts *p, vs_ref ref, const context *c) {
  if (ref.node->kind == VS_EMPTY || ref.node->class_ == VS_NOTHING) return true;
  if (p->count == p->room && !vs_store_grow(p->store, &p->at, &p->room, p->count + 1, sizeof *p->at)) return false;
  p->at[p->count++] = (vs_drawn_part){ ref, c->place, c->material, c->layer };
  vs_node_retain(ref.node);
  return true;
}

static bool take_one(vs_drawn_parts *p, vs_ref root, context_stack *stack, vs_error *e) {
  const context bare = { vs_affine_identity(), NULL, "" };
  vs_walk *w = vs_walk_new(p->store, root);
  vs_ref ref;
  bool ok = w != NULL;
  stack->count = 0;
  for (vs_walk_event event; ok && (event = vs_walk_next(w, &ref, NULL)) != VS_WALK_DONE;) {
    const context *c = stack->count ? &stack->at[stack->count - 1] : &bare;
    if (event == VS_WALK_LEAVE) {
      if (is_wrapper(ref.node)) stack->count--;
      continue;
    }
    ok = event == VS_WALK_ENTER;
    if (ok && !is_wrapper(ref.node)) {
      ok = take_part(p, ref, c);
      vs_walk_skip(w);
    } else if (ok) {
      context in = inside_of(c, ref.node);
      ok = vs_store_grow(p->store, &stack->at, &stack->room, stack->count + 1, sizeof in);
      if (ok) stack->at[stack->count++] = in;
    }
    if (ok && !vs_store_going(p->store, PART_WORK, e)) return vs_walk_free(w), false;
  }
  vs_walk_free(w);
  return ok || vs_error_memory(e, root.origin);
}

bool vs_drawn_parts_take(vs_drawn_parts *out, const vs_ref *refs, size_t count, vs_error *e) {
  context_stack stack = { 0 };
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) ok = take_one(out, refs[i], &stack, e);
  vs_store_realloc(out->store, stack.at, stack.room * sizeof *stack.at, 0);
  if (ok && out->count >= UINT32_MAX) return vs_error_set(e, VS_ERROR_MODEL, NULL, "too many parts to compare");
  return ok;
}

void vs_drawn_parts_free(vs_drawn_parts *p) {
  for (size_t i = 0; i < p->count; i++) vs_node_release(p->at[i].thing.node);
  vs_store_realloc(p->store, p->at, p->room * sizeof *p->at, 0);
  *p = (vs_drawn_parts){ .store = p->store };
}

/* ---- pairing ---- */

enum { BY_THING = 1, BY_PLACE = 2, BY_PAINT = 4, BY_FORM = 8, BY_LAYER = 16 };
static const struct { unsigned by; vs_part_fate fate; } rules[] = {
  { BY_THING | BY_PLACE | BY_PAINT | BY_LAYER, VS_PART_SAME },
  { BY_THING | BY_PLACE, VS_PART_REPAINTED },
  { BY_THING | BY_PAINT | BY_LAYER, VS_PART_MOVED },
  { BY_FORM | BY_PAINT | BY_LAYER | BY_PLACE, VS_PART_CHANGED },
  { BY_FORM | BY_PAINT | BY_LAYER, VS_PART_CHANGED },
};

typedef struct { uint64_t key; uint32_t part; } keyed;

/* Returns the FNV-1a hash h continued with one word. */
static uint64_t mix(uint64_t h, uint64_t word) { return (h ^ word ^ word >> 29) * UINT64_C(0x100000001b3); }

static uint64_t key_of(const vs_drawn_part *p, unsigned by) {
  uint64_t h = UINT64_C(0xcbf29ce484222325);
  if (by & BY_THING) h = mix(h, p->thing.node->hash);
  if (by & BY_FORM) h = mix(mix(h, p->thing.node->form), p->thing.node->kind);
  for (int i = 0; by & BY_PLACE && i < 12; i++) {
    double x = p->place.m[i / 4][i % 4] + 0.0;
    uint64_t word;
    memcpy(&word, &x, sizeof word);
    h = mix(h, word);
  }
  if (by & BY_PAINT) h = mix(h, (uint64_t)(uintptr_t)p->material); /* materials and layers are interned, so their
                                                                    * addresses identify them */
  if (by & BY_LAYER) h = mix(h, *p->layer ? (uint64_t)(uintptr_t)p->layer : 0);
  return h;
}

static int by_key(const void *a, const void *b) {
  const keyed *p = a, *q = b;
  return p->key != q->key ? (p->key < q->key ? -1 : 1) : p->part < q->part ? -1 : p->part > q->part;
}

/* Writes the keys of a drawing's unpaired parts to out. A key is a hash of the properties that the bits `by` select.
 * Returns the number of keys. */
static size_t keys_of(const vs_drawn_parts *p, const vs_part_match *match, unsigned by, keyed *out) {
  size_t n = 0;
  for (size_t i = 0; i < p->count; i++)
    if (match[i].fate == VS_PART_ALONE) out[n++] = (keyed){ key_of(&p->at[i], by), (uint32_t)i };
  if (n) qsort(out, n, sizeof *out, by_key);
  return n;
}

/* ---- pairing the parts with one key ---- */

typedef struct {
  const vs_drawn_parts *a, *b;
  vs_part_match *before, *after;
  vs_bounds_memo boxes;
  double *numbers; /* working memory for the pairing of several equal parts */
  size_t room;
} matching;

/* Writes six numbers to out: centre and size of the bounding box of part p, or zeros for a part without bounds. Returns
 * false on failure. */
static bool box_of(matching *m, const vs_drawn_part *p, double *out, vs_error *e) {
  vs_bounds box;
  if (!vs_bounds_memo_get(&m->boxes, p->thing.node, &box, e)) return false;
  box = vs_bounds_transform(&box, &p->place);
  const double low[] = { box.min.x, box.min.y, box.min.z }, high[] = { box.max.x, box.max.y, box.max.z };
  for (int i = 0; i < 3; i++) {
    bool ends = isfinite(low[i]) && isfinite(high[i]);
    out[i] = ends ? (low[i] + high[i]) / 2 : 0;
    out[3 + i] = ends ? high[i] - low[i] : 0;
  }
  return true;
}

/* Returns a measure of the difference of two boxes, each given by centre and size: the distance of the centres plus the
 * distance of the sizes. */
static double apart(const double *a, const double *b) {
  double sum[2] = { 0, 0 };
  for (int i = 0; i < 6; i++) sum[i / 3] += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum[0]) + sqrt(sum[1]);
}

/* An assignment problem: each row gets a column of its own, so that the sum of costs is least. The cost of a row and a
 * column is the difference of their boxes (apart). */
typedef struct {
  size_t rows, columns;                    /* numbers of rows and columns; rows <= columns */
  const double *row_boxes, *column_boxes;  /* centres and sizes of boxes, six numbers for the part of each row, and of
                                            * each column */
  double *work;                            /* working memory of 3 rows + 4 columns + 7 numbers */
  uint32_t *row;                           /* row[j]: row that is assigned to column j, counted from 1; 0: none */
} assignment;

/* Assigns a column of its own to each row, so that the sum of costs is least (H. Kuhn's Hungarian method, by shortest
 * augmenting paths with potentials: O(rows^2 columns)). Returns false when interrupted. */
static bool assign(vs_store *s, const assignment *a, vs_error *e) {
  size_t n = a->rows, m = a->columns;
  uint32_t *row = a->row;
  double *u = a->work, *v = u + n + 1, *least = v + m + 1;
  uint32_t *way = (uint32_t *)(void *)(least + m + 1);
  bool *used = (bool *)(way + m + 1);
  memset(u, 0, (n + m + 2) * sizeof *u);
  memset(row, 0, (m + 1) * sizeof *row);
  for (size_t i = 1; i <= n; i++) {
    size_t at = 0;
    row[0] = (uint32_t)i;
    memset(used, 0, m + 1);
    for (size_t k = 0; k <= m; k++) least[k] = INFINITY;
    do {
      used[at] = true;
      size_t r = row[at], next = 0;
      double step = INFINITY;
      for (size_t k = 1; k <= m; k++) {
        if (used[k]) continue;
        double cost = apart(a->row_boxes + 6 * (r - 1), a->column_boxes + 6 * (k - 1)) - u[r] - v[k];
        if (cost < least[k]) least[k] = cost, way[k] = (uint32_t)at;
        if (least[k] < step) step = least[k], next = k;
      }
      for (size_t k = 0; k <= m; k++) {
        if (used[k]) u[row[k]] += step, v[k] -= step;
        else least[k] -= step;
      }
      at = next;
      if (!vs_store_going(s, (unsigned)m * 10, e)) return false;
    } while (row[at]);
    for (; at; at = way[at]) row[at] = row[way[at]];
  }
  return true;
}

/* Pairs part p of the first drawing with part q of the second drawing, unless they are different shapes whose hashes
 * happen to be equal. */
static bool pair(matching *m, size_t rule, uint32_t p, uint32_t q, vs_error *e) {
  bool memory = true;
  if (rules[rule].by & BY_THING && !vs_node_equal(m->a->at[p].thing.node, m->b->at[q].thing.node, &memory))
    return memory || vs_error_memory(e, NULL);
  m->before[p] = (vs_part_match){ rules[rule].fate, q };
  m->after[q] = (vs_part_match){ rules[rule].fate, p };
  return true;
}

/* greatest number of steps for pairing equal parts by position; if more would be needed, parts are paired in the order
 * of drawing */
static const double MOST_STEPS = 1e8;

/* All parts of one drawing with the same key (hash of properties). */
typedef struct { const keyed *at; size_t count; } alike;

/* Pairs parts of the first drawing, `one`, with parts of the second, `other`, which all have the same key. If several
 * pairings are possible, chooses the one with the least sum of differences in position and size. */
static bool pair_alike(matching *m, size_t rule, alike one, alike other, vs_error *e) {
  size_t n = one.count, k = other.count;
  bool free_choice = n * k > 1 && (rules[rule].by & (BY_THING | BY_PLACE)) != (BY_THING | BY_PLACE);
  bool turned = n > k; /* true if the second drawing has fewer parts, and so supplies the rows of the assignment */
  const keyed *few = turned ? other.at : one.at, *many = turned ? one.at : other.at;
  size_t rows = turned ? k : n, columns = turned ? n : k, wanted = 9 * rows + 12 * columns + 16;
  if (!free_choice || (double)rows * (double)rows * (double)columns > MOST_STEPS) {
    for (size_t i = 0; i < n && i < k; i++)
      if (!vs_store_going(m->a->store, PART_WORK, e) || !pair(m, rule, one.at[i].part, other.at[i].part, e))
        return false;
    return true;
  }
  if (!vs_store_grow(m->a->store, &m->numbers, &m->room, wanted, sizeof *m->numbers)) return vs_error_memory(e, NULL);
  double *row_boxes = m->numbers, *column_boxes = row_boxes + 6 * rows, *work = column_boxes + 6 * columns;
  uint32_t *row = (uint32_t *)(void *)(work + 3 * rows + 4 * columns + 7);
  for (size_t i = 0; i < rows + columns; i++) {
    const keyed *part = i < rows ? &few[i] : &many[i - rows];
    const vs_drawn_parts *of = (i < rows) != turned ? m->a : m->b;
    if (!box_of(m, &of->at[part->part], row_boxes + 6 * i, e)) return false;
  }
  const assignment all = { rows, columns, row_boxes, column_boxes, work, row };
  if (!assign(m->a->store, &all, e)) return false;
  for (size_t c = 0; c < columns; c++) {
    if (!row[c + 1]) continue;
    uint32_t p = few[row[c + 1] - 1].part, q = many[c].part;
    if (!pair(m, rule, turned ? q : p, turned ? p : q, e)) return false;
  }
  return true;
}

bool vs_drawn_parts_match(const vs_drawn_parts *a, const vs_drawn_parts *b, vs_part_match *before, vs_part_match *after,
                          vs_error *e) {
  size_t bytes = (a->count + b->count + 1) * sizeof(keyed);
  keyed *ka = vs_store_realloc(a->store, NULL, 0, bytes), *kb = ka + a->count;
  if (!ka) return vs_error_memory(e, NULL);
  matching m = { .a = a, .b = b, .before = before, .after = after, .boxes.places.store = a->store };
  for (size_t i = 0; i < a->count; i++) before[i] = (vs_part_match){ VS_PART_ALONE, 0 };
  for (size_t i = 0; i < b->count; i++) after[i] = (vs_part_match){ VS_PART_ALONE, 0 };
  bool ok = true;
  for (size_t r = 0; ok && r < sizeof rules / sizeof *rules; r++) {
    size_t na = keys_of(a, before, rules[r].by, ka), nb = keys_of(b, after, rules[r].by, kb);
    for (size_t i = 0, k = 0; ok && i < na && k < nb;) {
      size_t to = i, end = k;
      if (ka[i].key < kb[k].key) i++;
      else if (ka[i].key > kb[k].key) k++;
      else {
        while (to < na && ka[to].key == ka[i].key) to++;
        while (end < nb && kb[end].key == ka[i].key) end++;
        ok = pair_alike(&m, r, (alike){ ka + i, to - i }, (alike){ kb + k, end - k }, e);
        i = to, k = end;
      }
    }
  }
  vs_bounds_memo_free(&m.boxes);
  vs_store_realloc(a->store, m.numbers, m.room * sizeof *m.numbers, 0);
  vs_store_realloc(a->store, ka, bytes, 0);
  return ok;
}

/* ---- the solids that show the differences ---- */

/* A list of references that will be the operands of a boolean. It holds a reference to each node. */
typedef struct { vs_store *store; vs_ref *at; size_t count, room; bool failed; } refs;

static void refs_free(refs *r) {
  for (size_t i = 0; i < r->count; i++) vs_node_release(r->at[i].node);
  vs_store_realloc(r->store, r->at, r->room * sizeof *r->at, 0);
}

/* Adds node n to the list, which takes over the caller's reference. If n is NULL, because memory is out, marks the list
 * as failed. */
static void refs_add(refs *r, vs_node *n, const vs_origin *origin) {
  if (!n || !vs_store_grow(r->store, &r->at, &r->room, r->count + 1, sizeof *r->at)) {
    vs_node_release(n);
    r->failed = true;
    return;
  }
  r->at[r->count++] = (vs_ref){ n, origin };
}

/* Adds part p of a drawing to the list in its placement, without its material. */
static void refs_add_part(refs *r, const vs_drawn_part *p) {
  if (vs_affine_is_identity(&p->place)) refs_add(r, vs_node_retain(p->thing.node), p->thing.origin);
  else refs_add(r, vs_node_new(r->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = p->place }, &p->thing, 1),
                p->thing.origin);
}

/* Computes the box that contains all nodes in the list r. */
static bool refs_bounds(const refs *r, vs_bounds_memo *memo, vs_bounds *out, vs_error *e) {
  *out = vs_bounds_empty();
  for (size_t i = 0; i < r->count; i++) {
    vs_bounds b;
    if (!vs_bounds_memo_get(memo, r->at[i].node, &b, e)) return false;
    vs_bounds_unite(out, &b);
  }
  return true;
}

/* Appends to r each reference of `from` whose bounds intersect the box or are close to it. Returns false on failure. */
static bool refs_add_near(refs *r, const refs *from, const vs_bounds *box, vs_bounds_memo *memo, vs_error *e) {
  for (size_t i = 0; i < from->count; i++) {
    vs_bounds b;
    if (!vs_bounds_memo_get(memo, from->at[i].node, &b, e)) return false;
    if (vs_bounds_overlap(&b, box, 0)) refs_add(r, vs_node_retain(from->at[i].node), from->at[i].origin);
  }
  return true;
}

static vs_node *set_of(refs *r, vs_kind kind) {
  if (r->failed) return NULL;
  if (r->count == 1) return vs_node_retain(r->at[0].node);
  return vs_node_new(r->store, kind, &(struct vs_union){ 0 }, r->at, r->count);
}

/* Appends to out the solids of `whole`, without the space that is in solids of `first` or `second`. Returns false on
 * failure. */
static bool add_rest(refs *out, refs *whole, const refs *first, const refs *second, vs_bounds_memo *memo, vs_error *e) {
  vs_bounds box;
  if (!whole->count) return true;
  if (!refs_bounds(whole, memo, &box, e)) return false;
  refs operands = { .store = out->store };
  refs_add(&operands, set_of(whole, VS_UNION), whole->at[0].origin);
  bool ok = refs_add_near(&operands, first, &box, memo, e) && refs_add_near(&operands, second, &box, memo, e);
  if (ok) refs_add(out, operands.failed ? NULL : set_of(&operands, VS_DIFFERENCE), whole->at[0].origin);
  refs_free(&operands);
  return ok;
}

/* Appends to out the space that is in a solid of a and also in a solid of b. Returns false on failure. */
static bool add_common(refs *out, refs *a, refs *b, vs_bounds_memo *memo, vs_error *e) {
  vs_bounds boxes[2];
  if (!a->count || !b->count) return true;
  if (!refs_bounds(a, memo, &boxes[0], e) || !refs_bounds(b, memo, &boxes[1], e)) return false;
  if (!vs_bounds_overlap(&boxes[0], &boxes[1], 0)) return true;
  refs operands = { .store = out->store };
  refs_add(&operands, set_of(a, VS_UNION), a->at[0].origin);
  refs_add(&operands, set_of(b, VS_UNION), b->at[0].origin);
  refs_add(out, operands.failed ? NULL : set_of(&operands, VS_INTERSECTION), b->at[0].origin);
  refs_free(&operands);
  return true;
}

static bool stays(vs_part_fate fate) { return fate == VS_PART_SAME || fate == VS_PART_REPAINTED; }

/* Sorts the parts of a drawing into three lists. kept: unchanged parts, which are dropped if kept is NULL; solids:
 * other solids; whole: other objects, which booleans cannot handle. */
static void sort_parts(const vs_drawn_parts *p, const vs_part_match *match, refs *kept, refs *solids, refs *whole) {
  for (size_t i = 0; i < p->count; i++) {
    const vs_drawn_part *part = &p->at[i];
    bool solid = part->thing.node->class_ == VS_SOLID && !(part->thing.node->flags & VS_NODE_ENDLESS);
    if (!stays(match[i].fate)) refs_add_part(solid ? solids : whole, part);
    else if (kept) refs_add_part(kept, part);
  }
}

/* Copies to out each reference of `from` that is a solid. Returns false on failure. */
static bool only_solids(refs *out, const refs *from) {
  for (size_t i = 0; i < from->count; i++)
    if (from->at[i].node->class_ == VS_SOLID) refs_add(out, vs_node_retain(from->at[i].node), from->at[i].origin);
  return !out->failed;
}

bool vs_drawn_parts_change(const vs_drawn_parts *a, const vs_drawn_parts *b, const vs_part_match *before,
                          const vs_part_match *after,
                     vs_node *out[VS_CHANGES], vs_error *e) {
  vs_store *s = b->store;
  refs shown[VS_CHANGES] = { { .store = s }, { .store = s }, { .store = s } };
  refs old = { .store = s }, new = { .store = s }, kept = { .store = s };
  vs_bounds_memo memo = { .places.store = s };
  for (int i = 0; i < VS_CHANGES; i++) out[i] = NULL;
  sort_parts(a, before, NULL, &old, &shown[VS_CHANGE_REMOVED]);
  sort_parts(b, after, &shown[VS_CHANGE_KEPT], &new, &shown[VS_CHANGE_ADDED]);
  bool ok = only_solids(&kept, &shown[VS_CHANGE_KEPT]) && !old.failed && !new.failed;
  if (!ok) vs_error_memory(e, NULL);
  ok = ok && add_rest(&shown[VS_CHANGE_ADDED], &new, &kept, &old, &memo, e) &&
       add_rest(&shown[VS_CHANGE_REMOVED], &old, &kept, &new, &memo, e) &&
       add_common(&shown[VS_CHANGE_KEPT], &old, &new, &memo, e);
  for (int i = 0; ok && i < VS_CHANGES; i++) {
    if (!shown[i].count && !shown[i].failed) continue;
    out[i] = set_of(&shown[i], VS_UNION);
    if (!out[i]) ok = vs_error_memory(e, NULL);
  }
  for (int i = 0; i < VS_CHANGES; i++) {
    refs_free(&shown[i]);
    if (!ok) vs_node_release(out[i]), out[i] = NULL;
  }
  refs_free(&old);
  refs_free(&new);
  refs_free(&kept);
  vs_bounds_memo_free(&memo);
  return ok;
}

/* Adds the solids below n to `solids`, and all other objects to `rest`. If `rest` is NULL, drops these other objects.
 * Returns false on failure. */
static bool part_solids(vs_node *n, refs *solids, refs *rest, vs_error *e) {
  vs_drawn_parts parts = { .store = n->store };
  bool ok = vs_drawn_parts_take(&parts, &(vs_ref){ n, NULL }, 1, e);
  for (size_t i = 0; ok && i < parts.count; i++)
    if (parts.at[i].thing.node->class_ == VS_SOLID) refs_add_part(solids, &parts.at[i]);
    else if (rest) refs_add_part(rest, &parts.at[i]);
  vs_drawn_parts_free(&parts);
  return ok && (!(solids->failed || (rest && rest->failed)) || vs_error_memory(e, NULL));
}

/* Moves every corner of mesh m outwards by the length `by`, along the mean of its triangles' normals, weighted by area.
 * Returns false if memory is out. */
static bool push_out(vs_store *s, vs_mesh *m, double by) {
  size_t bytes = (m->vertex_count + 1) * sizeof(vs_vec3);
  vs_vec3 *out = vs_store_realloc(s, NULL, 0, bytes);
  if (!out) return false;
  memset(out, 0, bytes);
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    vs_vec3 a = m->vertices[t[0]];
    vs_vec3 n = vs_v3_cross(vs_v3_sub(m->vertices[t[1]], a), vs_v3_sub(m->vertices[t[2]], a));
    for (int k = 0; k < 3; k++) out[t[k]] = vs_v3_add(out[t[k]], n);
  }
  for (size_t i = 0; i < m->vertex_count; i++)
    m->vertices[i] = vs_v3_add(m->vertices[i], vs_v3_scale(vs_v3_unit(out[i]), by));
  vs_store_realloc(s, out, bytes, 0);
  return true;
}

static vs_node *mesh_node(vs_store *s, const vs_mesh *m) {
  size_t bytes = (m->triangle_count + 1) * sizeof(uint32_t);
  uint32_t *starts = vs_store_realloc(s, NULL, 0, bytes);
  if (!starts) return NULL;
  for (size_t i = 0; i <= m->triangle_count; i++) starts[i] = 3 * (uint32_t)i;
  struct vs_polyface_mesh mesh = {
    .points = vs_points_new(s, m->vertices, m->vertex_count),
    .faces = vs_faces_new(s, starts, m->triangle_count, m->triangles[0], 3 * m->triangle_count), .closed = true
  };
  vs_node *n = mesh.points && mesh.faces ? vs_node_new(s, VS_POLYFACE_MESH, &mesh, NULL, 0) : NULL;
  if (mesh.points) vs_points_release(s, mesh.points);
  if (mesh.faces) vs_faces_release(s, mesh.faces);
  vs_store_realloc(s, starts, bytes, 0);
  return n;
}

bool vs_drawn_parts_swell(vs_node *n, double tolerance, const vs_kernel_options *options, vs_node **out, vs_error *e) {
  refs solids = { .store = n->store }, shown = { .store = n->store };
  vs_fineness facets = { .tolerance = tolerance };
  vs_solid solid = { 0 };
  *out = NULL;
  vs_bounds whole;
  bool ok = vs_node_bounds(n, &whole, e) && part_solids(n, &solids, &shown, e);
  if (ok && tolerance <= 0) facets.tolerance = vs_fineness_tolerance(&whole);
  double reach = facets.tolerance / 2; /* The tolerance of facets is a quarter of `reach`. Therefore the enlarged mesh
                                        * is outside the object everywhere. */
  facets.tolerance /= 8;
  if (ok && solids.count) ok = vs_solid_evaluate(solids.at, solids.count, &facets, options, &solid, e);
  if (ok && solid.mesh.triangle_count) {
    bool pushed = push_out(n->store, &solid.mesh, reach);
    refs_add(&shown, pushed ? mesh_node(n->store, &solid.mesh) : NULL, NULL);
  }
  if (ok) *out = set_of(&shown, VS_UNION);
  if (ok && !*out) ok = vs_error_memory(e, NULL);
  vs_solid_free(&solid);
  refs_free(&solids);
  refs_free(&shown);
  return ok;
}

bool vs_drawn_parts_volume(vs_node *n, double tolerance, const vs_kernel_options *options, double *volume,
                          vs_error *e) {
  *volume = 0;
  if (!n) return true;
  refs solids = { .store = n->store };
  bool ok = part_solids(n, &solids, NULL, e);
  vs_node *all = ok && solids.count ? set_of(&solids, VS_UNION) : NULL;
  if (ok && solids.count && !all) ok = vs_error_memory(e, NULL);
  vs_measure m = { 0 };
  if (all) ok = vs_solid_measure((vs_ref){ all, solids.at[0].origin }, VS_ASK_VOLUME, tolerance, options, &m, e);
  if (ok) *volume = m.volume;
  vs_node_release(all);
  refs_free(&solids);
  return ok;
}
