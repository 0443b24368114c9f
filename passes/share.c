/* Implements the pass share. Equal subtrees at different places become one template with placements. The same holds for
 * subtrees that are rotated or mirrored (turn.c).
 *
 * Each distinct node gets an anchor and a key. The anchor is a point of the node that moves with it. The key is a hash
 * of 128 bits over the kind, the fields and the children's keys, with all positions relative to the anchor. Shapes with
 * equal keys count as equal: two different shapes get one key once in 2^64 models, and nothing else is compared.
 * Rounding makes the numbers of the same part at two places differ. Therefore positions within 2^-40 of the largest
 * number hash as the first of them that the pass visited. A plain grid would separate neighbours on the two sides of a
 * step, and a tree of a thousand numbers soon has such a pair. Other numbers are rounded to 40 bits in the same way.
 *
 * A moved shape, and a set with a single member, count as the shape within: they have its key, and no copy of their
 * own.
 *
 * Only repeated parts need a key. Each node stores its form, a hash without numbers and places. If no other node has a
 * set's form, and the set lies in no node whose form is repeated, the pass skips it. Therefore a million primitives in
 * one set cost nothing here.
 *
 * The pass computes keys twice. The first keys cover only some points of each array, which distinguish nearly all
 * shapes of a thousand points. Where two first keys are equal, the pass computes complete keys.
 *
 * Without a template, d copies of c commands cost d*c. With a template, d uses and d - 1 placements, they cost c + 2*d.
 * The pass makes a template if that costs less. If a part of a copy is a template in any case, only the uses of that
 * part count. The first copy is the template, so parts of shared parts are decided at the same time. */
#include "passes/share.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "passes/rewrite.h"
#include "model/store/hashes.h"
#include "model/store/patient_sort.h"
#include "passes/turn.h"

typedef struct { uint64_t a, b; } vs_share_key;
typedef struct {
  vs_share_key key;
  vs_vec3 anchor;
  double cost;        /* number of commands of one copy of the node's shape; a part that becomes a template in any case
                       * counts as one reference */
  bool alias;         /* true if the node is only a placement of its child, or a set of one member */
  bool wanted;        /* true if the node's key (hash of its shape) must be computed */
  bool again;         /* true if another node has an equal first key, which covers only some of the points */
  size_t group;       /* index of the first entry with an equal key, which represents all nodes with this key */
  size_t copies;      /* number of nodes with the key of this entry; valid only in the first entry with the key */
  double named;       /* number of references to all nodes with the key of this entry; valid only in the first entry
                       * with the key */
  size_t turn;        /* Number, counted from 1, of an element of `turns`: the map by which this shape is another shape
                       * rotated or mirrored; 0 if there is none. Valid in the first entry with the key. */
  vs_node *result;    /* new node for this shape, valid in the first entry with the key; not retained, because the
                       * rewriting holds a reference to it */
} vs_share_entry;
typedef struct { size_t head; vs_affine map; } vs_share_turn; /* A shape that is another shape moved. head: index of the
                                                               * first entry of that other shape; map: map from that
                                                               * shape to this one. */
typedef struct { double step, first; } vs_share_step; /* A step of rounded numbers: its number, and the first number in
                                                       * this step that was hashed. first is NaN if the slot of the hash
                                                       * table is free. */
/* The key and the anchor (point that moves with it) of a child, for its parent. They are stored for each numbered node.
 * For a leaf with a single reference they are computed when needed; only its key is cached, if it has many points. */
typedef struct { vs_share_key key; vs_vec3 anchor; } vs_share_child;
typedef struct { const vs_node *node; vs_share_child of; } vs_share_leaf;

enum {
  SKETCHED = 16, /* number of points of an array that a first key covers */
  LONG = 1024,   /* number of bytes of a leaf above which its key is cached */
  LEAVES = 64
};

typedef struct {
  vs_store *store;
  const vs_order *order;
  vs_share_leaf leaves[LEAVES]; /* cache of the keys of leaves with many points, indexed by hash; a slot contains the
                                 * leaf that was entered last */
  bool sketches, sketched; /* sketches: true while keys cover only some points of each array; sketched: true if some
                            * array had more points */
  vs_share_entry *at; /* at[i]: entry of the node with the number i */
  size_t count, room;
  double quantum;
  vs_share_step *steps; /* hash table of steps (intervals of nearly equal numbers); a step's entry has the first number
                         * in it that was hashed */
  size_t step_count, step_room;
  vs_share_turn *turns;
  size_t turn_count, turn_room;
  bool starved;         /* true if the hash table `steps` could not be enlarged, because memory is out */
} vs_share;

/* ---- rounding and hashing ---- */

static void share_mix(vs_share_key *k, uint64_t v) {
  k->a = vs_hash_mix(k->a, v);
  k->b = vs_hash_mix(k->b ^ UINT64_C(0xA5A5A5A5A5A5A5A5), v);
}

static vs_share_step *share_find(const vs_share *s, double step) {
  size_t i = (size_t)vs_hash_real(6, step) & (s->step_room - 1);
  while (!isnan(s->steps[i].first) && s->steps[i].step != step) i = (i + 1) & (s->step_room - 1);
  return &s->steps[i];
}

static bool share_grow(vs_share *s) {
  vs_share_step *old = s->steps;
  size_t old_room = s->step_room, room = old_room ? 2 * old_room : 256;
  vs_share_step *grown =
      room <= SIZE_MAX / 2 / sizeof *grown ? vs_store_realloc(s->store, NULL, 0, room * sizeof *grown) : NULL;
  if (!grown) return false;
  for (size_t i = 0; i < room; i++) grown[i] = (vs_share_step){ 0, (double)NAN };
  s->steps = grown;
  s->step_room = room;
  for (size_t i = 0; i < old_room; i++)
    if (!isnan(old[i].first)) *share_find(s, old[i].step) = old[i];
  vs_store_realloc(s->store, old, old_room * sizeof *old, 0);
  return true;
}

/* Returns the number that is hashed instead of x, so that nearly equal numbers have equal hashes. It is the nearest
 * earlier number in the step (interval) of x, or at most half a step away. If there is none, it is x itself, which is
 * entered for its step. */
static double share_snap(vs_share *s, double x) {
  if (!isfinite(x) || s->starved) return 0;
  double step = floor(x), best = (double)NAN, reach = 1;
  if (s->step_room && share_find(s, step)->first == x) return x; /* Nearly always, x equals the number that was
                                                                  * entered for its step, because models repeat their
                                                                  * numbers. */
  for (int side = -1; side <= 1 && s->step_room; side++) {
    double first = share_find(s, step + side)->first; /* if a slot is free, `first` is NaN, and the comparisons below
                                                       * are false */
    if (fabs(first - x) < (side ? fmin(reach, 0.5) : reach)) reach = fabs(first - x), best = first;
  }
  if (!isnan(best)) return best;
  if (2 * (s->step_count + 1) > s->step_room && !share_grow(s)) {
    s->starved = true;
    return 0;
  }
  *share_find(s, step) = (vs_share_step){ step, x };
  s->step_count++;
  return x;
}

static void share_mix_place(vs_share *s, vs_share_key *k, double x, double quantum) {
  share_mix(k, vs_hash_real(6, share_snap(s, x / quantum)));
}

static void share_mix_vector(vs_share *s, vs_share_key *k, vs_vec3 v) {
  share_mix_place(s, k, v.x, s->quantum);
  share_mix_place(s, k, v.y, s->quantum);
  share_mix_place(s, k, v.z, s->quantum);
}

static void share_mix_real(vs_share *s, vs_share_key *k, double x) {
  int exponent;
  double mantissa = ldexp(frexp(x, &exponent), 40);
  if (!isfinite(x) || x == 0) {
    share_mix(k, vs_hash_real(7, x));
    return;
  }
  if (fabs(mantissa) > ldexp(1, 40) - 0.5) mantissa /= 2, exponent++; /* a number just below a power of two would round
                                                                       * to a larger mantissa, so the next exponent is
                                                                       * used */
  share_mix(k, (uint64_t)(int64_t)exponent);
  share_mix_place(s, k, mantissa, 1);
}

/* ---- keys ---- */

static vs_share_child share_of(vs_share *s, const vs_node *n);

/* Returns the point of n that moves with it: its first point, or the anchor of its first child. */
static vs_vec3 share_anchor(vs_share *s, const vs_node *n, const vs_kind_info *info) {
  /* a sweep has the anchor (point that moves with it) of its path */
  if (n->kind == VS_SWEEP && n->child_count > 1) return share_of(s, n->children[1].node).anchor;
  if (n->kind == VS_TRANSFORM)
    return vs_affine_point(&VS_AS(transform, n)->matrix, share_of(s, n->children[0].node).anchor);
  if (n->kind == VS_NATIVE) return vs_v3(0, 0, 0); /* native text for a format cannot be moved, so it has no anchor of
                                                    * its own */
  for (size_t i = 0; n->kind != VS_SWEEP && i < info->field_count; i++) {
    const void *at = (const char *)vs_node_data(n) + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_point) return *(const vs_vec3 *)at;
    if (info->fields[i].type == VS_FIELD_points && (*(const vs_points *const *)at)->count)
      return (*(const vs_points *const *)at)->at[0];
  }
  return n->child_count ? share_of(s, n->children[0].node).anchor : vs_v3(0, 0, 0);
}

static void share_mix_fields(vs_share *s, vs_share_key *k, const vs_node *n, const vs_kind_info *info, vs_vec3 anchor) {
  /* positions in the profile of a sweep, and its base, are hashed unchanged, because they do not move with the
   * anchor */
  vs_vec3 from = n->kind == VS_SWEEP ? vs_v3(0, 0, 0) : anchor;
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)vs_node_data(n) + info->fields[i].offset;
    switch (info->fields[i].type) {
      case VS_FIELD_real:
        /* the lowest height of a height field moves with the field, as its other heights do */
        if (n->kind == VS_HEIGHT_FIELD) share_mix_place(s, k, *(const double *)at - from.z, s->quantum);
        else share_mix_real(s, k, *(const double *)at);
        break;
      case VS_FIELD_integer: share_mix(k, (uint64_t)(int64_t)*(const int32_t *)at); break;
      case VS_FIELD_boolean: share_mix(k, *(const bool *)at); break;
      case VS_FIELD_point: share_mix_vector(s, k, vs_v3_sub(*(const vs_vec3 *)at, from)); break;
      case VS_FIELD_vector: share_mix_vector(s, k, *(const vs_vec3 *)at); break;
      case VS_FIELD_affine: /* hashes only the linear part of the map, because the anchor contains its translation */
        for (int r = 0; r < 3; r++)
          for (int c = 0; c < 3; c++) share_mix_place(s, k, ((const vs_affine *)at)->m[r][c], ldexp(1, -40));
        break;
      case VS_FIELD_points: {
        const vs_points *p = *(const vs_points *const *)at;
        share_mix(k, p->count);
        s->sketched |= s->sketches && p->count > SKETCHED;
        for (uint32_t j = 0; j < p->count && (j < SKETCHED || !s->sketches); j++)
          share_mix_vector(s, k, vs_v3_sub(p->at[j], from));
        break;
      }
      case VS_FIELD_faces: {
        share_mix(k, (*(const vs_faces *const *)at)->hash);
        break;
      }
      case VS_FIELD_text: share_mix(k, vs_text_hash(*(const char *const *)at)); break;
      case VS_FIELD_ticket: share_mix(k, (*(const vs_ticket *const *)at)->id); break;
      case VS_FIELD_material: share_mix(k, vs_material_hash(*(const vs_material *const *)at)); break;
    }
  }
}

static bool share_is_alias(const vs_node *n) {
  if (n->kind == VS_TRANSFORM) return vs_affine_is_translation(&VS_AS(transform, n)->matrix);
  bool set = vs_node_is_set(n);
  /* A set of one child equals the child, except for the union of one closed curve, which is a region. */
  return set && n->child_count == 1 && n->children[0].node->class_ == n->class_;
}

/* Computes the key of node n, and its anchor (the point that moves with it). The keys and anchors of its children must
 * be known. */
static void share_find_key(vs_share *s, const vs_node *n, vs_share_key *key, vs_vec3 *anchor) {
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  *anchor = share_anchor(s, n, info);
  if (share_is_alias(n)) {
    *key = share_of(s, n->children[0].node).key;
    return;
  }
  *key = (vs_share_key){ 0, 0 };
  share_mix(key, vs_hash_bytes(9, info->name, strlen(info->name)));
  share_mix(key, n->child_count);
  share_mix_fields(s, key, n, info, *anchor);
  if (n->kind == VS_NATIVE) share_mix(key, n->hash); /* native text for a format is shared only with equal text, because
                                                      * it cannot be moved */
  for (uint32_t i = 0; i < n->child_count; i++) {
    vs_share_child child = share_of(s, n->children[i].node);
    share_mix(key, child.key.a);
    share_mix(key, child.key.b);
    if (n->kind == VS_SWEEP) share_mix_vector(s, key, i ? vs_v3(0, 0, 0) : child.anchor);
    else if (n->kind != VS_TRANSFORM && (n->kind != VS_EXTRUDE || i == 0))
      share_mix_vector(s, key, vs_v3_sub(child.anchor, *anchor));
  }
}

static vs_share_child share_of(vs_share *s, const vs_node *n) {
  if (vs_order_has(s->order, n)) {
    const vs_share_entry *x = &s->at[vs_order_of(n)];
    return (vs_share_child){ x->key, x->anchor };
  }
  vs_share_leaf lone, *held = vs_node_bytes(n) > LONG ? &s->leaves[n->hash % LEAVES] : &lone;
  if (held != &lone && held->node && (held->node == n || vs_node_equal(held->node, n, NULL))) return held->of;
  share_find_key(s, n, &held->of.key, &held->of.anchor); /* n is a leaf, so this call does not recurse further */
  held->node = n;
  return held->of;
}

/* Fills in the entry of node n, except its key. Its cost is the highest possible: that of a copy without templates. The
 * children's entries must have been filled in before. */
static void share_enter(vs_share *s, const vs_node *n, bool inner) {
  bool set = vs_kind_get((vs_kind)n->kind)->level == VS_LEVEL_OPERATION;
  vs_share_entry x = { .cost = 1, .group = s->count, .alias = share_is_alias(n) };
  if (set && n->child_count > 1) x.cost = n->child_count - 1;
  if (set && !inner) x.cost += n->child_count;
  for (uint32_t i = 0; set && inner && i < n->child_count; i++) {
    const vs_node *child = n->children[i].node;
    x.cost += vs_order_has(s->order, child) ? s->at[vs_order_of(child)].cost : 1;
  }
  if (x.cost > 1e15) x.cost = 1e15; /* limits the cost, because the number of paths through a DAG may overflow it */
  s->at[s->count++] = x;
}

/* Returns true if the node is large enough that a template of it saves commands, given enough copies. */
static bool share_is_worth(const vs_share_entry *x) { return !x->alias && x->cost > 2; }

static int share_by_form(const void *p, const void *q) {
  uint64_t x = *(const uint64_t *)p, y = *(const uint64_t *)q;
  return x < y ? -1 : x > y;
}

/* Marks the nodes whose form (hash without numbers and places) another node has, too, and all nodes below them. *any:
 * true if there are any. Returns false if memory is out or the run is interrupted. */
static bool share_want(vs_share *s, bool *any, vs_error *e) {
  const vs_order *o = s->order;
  size_t count = 0;
  uint64_t *forms = vs_store_realloc(s->store, NULL, 0, (s->count + 1) * sizeof *forms);
  if (!forms) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < s->count; i++)
    if (share_is_worth(&s->at[i])) forms[count++] = (uint64_t)o->at[i].node->form << 32 | i;
  bool ok = vs_store_sort(s->store, forms, count, sizeof *forms, share_by_form, e);
  *any = false;
  for (size_t i = 0; ok && i < count; i++) {
    uint64_t form = forms[i] >> 32;
    bool again = (i > 0 && forms[i - 1] >> 32 == form) || (i + 1 < count && forms[i + 1] >> 32 == form);
    s->at[forms[i] & UINT32_MAX].wanted = again;
    *any |= again;
  }
  vs_store_realloc(s->store, forms, (s->count + 1) * sizeof *forms, 0);
  for (size_t i = ok ? s->count : 0; i-- > 0;) {
    const vs_node *n = o->at[i].node;
    for (uint32_t k = 0; s->at[i].wanted && o->note[i].inner && k < n->child_count; k++)
      if (vs_order_has(o, n->children[k].node)) s->at[vs_order_of(n->children[k].node)].wanted = true;
  }
  return ok;
}

static void share_largest(double *most, const double *x, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (isfinite(x[i])) *most = fmax(*most, fabs(x[i]));
}

static void share_measure(double *most, const vs_node *n) { /* enlarges *most to the largest coordinate in the node */
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  for (size_t i = 0; i < info->field_count; i++) {
    const void *field = (const char *)vs_node_data(n) + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_point) share_largest(most, field, 3);
    if (info->fields[i].type == VS_FIELD_affine) share_largest(most, field, 12);
    if (info->fields[i].type == VS_FIELD_points && (*(const vs_points *const *)field)->count)
      share_largest(most, &(*(const vs_points *const *)field)->at[0].x,
                    3 * (size_t)(*(const vs_points *const *)field)->count);
  }
}

/* ---- groups ---- */

typedef struct { vs_share_key key; size_t entry; } vs_share_order;

static int share_compare(const void *p, const void *q) {
  const vs_share_order *x = p, *y = q;
  if (x->key.a != y->key.a) return x->key.a < y->key.a ? -1 : 1;
  if (x->key.b != y->key.b) return x->key.b < y->key.b ? -1 : 1;
  return x->entry < y->entry ? -1 : x->entry > y->entry;
}

/* Returns the entry that represents all shapes equal to the one at `index`, including rotated and mirrored shapes. */
static vs_share_entry *share_head(const vs_share *s, size_t index) {
  vs_share_entry *first = &s->at[s->at[index].group];
  return first->turn ? &s->at[s->turns[first->turn - 1].head] : first;
}

static bool share_pays(const vs_share_entry *first) {
  double copies = (double)first->copies;
  return (copies - 1) * first->cost > 2 * copies;
}

/* Returns the number of commands of a copy of the node at `index`. named: number of references to the node's shape. A
 * part with more references counts only as a reference to a template. */
static double share_cost(const vs_share *s, size_t index, double named) {
  const vs_node *n = s->order->at[index].node;
  double cost = 1;
  if (vs_kind_get((vs_kind)n->kind)->level != VS_LEVEL_OPERATION) return cost;
  if (n->child_count > 1) cost = n->child_count - 1;
  if (!s->order->note[index].inner) return cost + n->child_count;
  for (uint32_t i = 0; i < n->child_count; i++) {
    const vs_node *below = n->children[i].node;
    if (!vs_order_has(s->order, below)) {
      cost++;
      continue;
    }
    const vs_share_entry *child = &s->at[vs_order_of(below)], *first = share_head(s, vs_order_of(below));
    bool template = first->named > named && (share_pays(first) || first->named > (double)first->copies);
    cost += template ? fmin(child->cost, first->copies > 1 ? 2 : 1) : child->cost;
  }
  return fmin(cost, 1e15); /* limits the cost, because the number of paths through a DAG may overflow it */
}

static bool share_group(vs_share *s, vs_error *e) {
  vs_share_order *order = vs_store_realloc(s->store, NULL, 0, (s->count + 1) * sizeof *order);
  if (!order) return vs_error_memory(e, NULL);
  size_t count = 0;
  for (size_t i = 0; i < s->count; i++) {
    s->at[i].group = i;
    s->at[i].copies = 0;
    if (s->at[i].wanted && !s->at[i].alias) order[count++] = (vs_share_order){ s->at[i].key, i };
  }
  bool ok = vs_store_sort(s->store, order, count, sizeof *order, share_compare, e);
  for (size_t i = 0, first = 0; ok && i < count; i++) {
    if (order[i].key.a != order[first].key.a || order[i].key.b != order[first].key.b) first = i;
    s->at[order[i].entry].group = order[first].entry;
    s->at[order[first].entry].copies++;
  }
  vs_store_realloc(s->store, order, (s->count + 1) * sizeof *order, 0);
  return ok;
}

/* Computes the keys of all nodes that need one. again: computes complete keys, only for nodes whose first key (which
 * covers some of the points) equals that of another node. Returns false if memory is out or the run is interrupted. */
static bool share_keys(vs_share *s, bool again, vs_error *e) {
  const vs_order *o = s->order;
  for (size_t i = 0; i < LEAVES; i++) s->leaves[i].node = NULL;
  for (size_t i = 0; i < s->count; i++) {
    if (again ? s->at[i].again : s->at[i].wanted) share_find_key(s, o->at[i].node, &s->at[i].key, &s->at[i].anchor);
    if (s->starved) return vs_error_memory(e, o->at[i].origin);
    if (!vs_store_going(s->store, VS_NODE_WORK, e)) return false;
  }
  return share_group(s, e);
}

/* Marks the nodes whose first key (which covers some of the points) equals that of another node, and all nodes below
 * them. */
static void share_doubt(vs_share *s) {
  const vs_order *o = s->order;
  for (size_t i = 0; i < s->count; i++)
    s->at[i].again = s->at[i].wanted && !s->at[i].alias && s->at[s->at[i].group].copies > 1;
  for (size_t i = s->count; i-- > 0;) {
    const vs_node *n = o->at[i].node;
    for (uint32_t k = 0; s->at[i].again && o->note[i].inner && k < n->child_count; k++)
      if (vs_order_has(o, n->children[k].node)) s->at[vs_order_of(n->children[k].node)].again = true;
  }
}

static bool share_add_turn(vs_share *s, size_t index, size_t head, const vs_affine *map) {
  if (s->turn_count == s->turn_room) {
    size_t room = s->turn_room ? 2 * s->turn_room : 16;
    vs_share_turn *grown = vs_store_realloc(s->store, s->turns, s->turn_room * sizeof *grown, room * sizeof *grown);
    if (!grown) return false;
    s->turns = grown;
    s->turn_room = room;
  }
  s->turns[s->turn_count++] = (vs_share_turn){ head, *map };
  s->at[index].turn = s->turn_count;
  s->at[head].copies += s->at[index].copies;
  return true;
}

/* Merges groups of nodes whose shapes are equal up to rotation and reflection. Limits the comparisons, so that the cost
 * does not grow with the square of the number of shapes. Returns false if memory is out or the run is interrupted. */
static bool share_turns(vs_share *s, vs_error *e) {
  enum { HEADS_MOST = 6 };
  size_t count = 0, heads[HEADS_MOST], head_count = 0, work = 0, most = 100000 + 50 * s->count;
  uint64_t *forms = vs_store_realloc(s->store, NULL, 0, (s->count + 1) * sizeof *forms);
  if (!forms) return vs_error_memory(e, NULL);
  bool ok = true;
  for (size_t i = 0; i < s->count; i++)
    if (s->at[i].wanted && s->at[i].group == i && share_is_worth(&s->at[i]))
      forms[count++] = (uint64_t)s->order->at[i].node->form << 32 | i;
  ok = vs_store_sort(s->store, forms, count, sizeof *forms, share_by_form, e);
  for (size_t i = 0; ok && i < count && work < most; i++) {
    size_t mine = forms[i] & UINT32_MAX;
    bool found = false;
    vs_affine map;
    if (i == 0 || forms[i - 1] >> 32 != forms[i] >> 32) head_count = 0;
    for (size_t k = 0; !found && ok && k < head_count; k++) {
      vs_turn_pair pair = { s->order->at[heads[k]].node, s->order->at[mine].node };
      found = vs_turn_find(pair, s->quantum, &map, &work, e);
      ok = found ? share_add_turn(s, mine, heads[k], &map) || vs_error_memory(e, NULL) : e->kind == VS_ERROR_NONE;
    }
    if (!found && head_count < HEADS_MOST) heads[head_count++] = mine;
  }
  vs_store_realloc(s->store, forms, (s->count + 1) * sizeof *forms, 0);
  return ok;
}

bool vs_share_begin(vs_rewrite *w) {
  const vs_order *o = &w->order;
  vs_share *s = vs_store_realloc(w->store, NULL, 0, sizeof *s);
  if (!s) return vs_error_memory(w->error, NULL);
  *s = (vs_share){ .store = w->store, .order = o };
  w->state = s;
  s->at = vs_store_realloc(w->store, NULL, 0, (o->count + 1) * sizeof *s->at);
  if (!s->at) return vs_error_memory(w->error, NULL);
  s->room = o->count + 1;
  for (size_t i = 0; i < o->count; i++) {
    if (!vs_store_going(w->store, VS_ORDER_WORK, w->error)) return false;
    share_enter(s, o->at[i].node, o->note[i].inner);
  }
  bool any = false;
  if (!share_want(s, &any, w->error)) return false;
  w->idle = !any;
  if (!any) return true;
  double most = 0;
  for (size_t i = 0; i < o->count; i++) {
    const vs_node *n = o->at[i].node;
    if (!s->at[i].wanted) continue;
    if (!vs_store_going(w->store, VS_ORDER_WORK, w->error)) return false;
    share_measure(&most, n);
    for (uint32_t k = 0; k < n->child_count; k++)
      if (!vs_order_has(o, n->children[k].node)) share_measure(&most, n->children[k].node);
  }
  s->quantum = most > 0 ? ldexp(most, -40) : 1;
  if (!(s->quantum > 0)) s->quantum = ldexp(1, -1000);
  s->sketches = true;
  if (!share_keys(s, false, w->error)) return false;
  s->sketches = false;
  if (s->sketched) {
    share_doubt(s);
    if (!share_keys(s, true, w->error)) return false;
  }
  if (!share_turns(s, w->error)) return false;
  for (size_t i = 0; i < o->count; i++) {
    if (!vs_store_going(w->store, VS_ORDER_WORK, w->error)) return false;
    share_head(s, i)->named += o->note[i].uses;
  }
  for (size_t i = 0; i < o->count; i++) {
    if (!vs_store_going(w->store, VS_ORDER_WORK, w->error)) return false;
    s->at[i].cost = share_cost(s, i, share_head(s, i)->named);
  }
  return true;
}

void vs_share_end(vs_rewrite *w) {
  vs_share *s = w->state;
  if (!s) return;
  vs_store_realloc(w->store, s->steps, s->step_room * sizeof *s->steps, 0);
  vs_store_realloc(w->store, s->turns, s->turn_room * sizeof *s->turns, 0);
  vs_store_realloc(w->store, s->at, s->room * sizeof *s->at, 0);
  vs_store_realloc(w->store, s, sizeof *s, 0);
}

vs_node *vs_pass_share(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  vs_share *s = w->state;
  vs_share_entry *mine = &s->at[vs_order_of(n)], *first = &s->at[mine->group], *head = share_head(s, vs_order_of(n));
  (void)origin;
  if (mine == head || !head->result || !share_pays(head)) {
    vs_node *kept = vs_rewrite_keep(w, n, kids);
    if (mine == head) head->result = kept;
    return kept;
  }
  w->changed++;
  vs_vec3 shift = vs_v3_sub(mine->anchor, first->anchor);
  if (head == first && fmax(fabs(shift.x), fmax(fabs(shift.y), fabs(shift.z))) < 2 * s->quantum)
    return vs_node_retain(first->result);
  struct vs_transform moved = { .matrix = vs_affine_translation(shift) };
  if (head != first) moved.matrix = vs_affine_multiply(&moved.matrix, &s->turns[first->turn - 1].map);
  return vs_node_new(w->store, VS_TRANSFORM, &moved, &(vs_ref){ head->result, w->order.at[vs_order_of(n)].origin }, 1);
}
