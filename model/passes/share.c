/* Owns share: subtrees that are equal but for their place become one template and its placements.
 *
 * Each distinct node gets an anchor, a point of it that moves along when it is moved, and a key of 128 bits: a hash of kind, fields and
 * children's keys in which every position stands relative to the anchor. Equal keys are equal shapes (two that differ meet in one key once
 * in 2^64 models; nothing else is compared). The same part written at two places differs by rounding: positions are rounded to 2^-40 of the
 * drawing's largest number before they are hashed, other numbers to 40 bits; what falls on either side of a step is not shared.
 *
 * d copies of c commands cost d*c apart and c + 2*d with a template, d uses and d - 1 placements: shared where that is less. The first copy
 * met is the template, so that parts of shared parts settle by themselves. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/passes/rewrite.h"
#include "model/store.h"

typedef struct { uint64_t a, b; } vs_share_key;
typedef struct {
  vs_share_key key;
  vs_vec3 anchor;
  double cost;        /* commands */
  size_t group;       /* the first entry with this key */
  size_t copies;      /* of the group, at its first entry */
  vs_node *result;    /* what that first entry became; not retained: the rewriting holds it */
} vs_share_entry;
typedef struct {
  vs_store *store;
  vs_share_entry *at;
  size_t count, room;
  vs_nodemap places;
  double quantum;
} vs_share;

/* ---- rounding and hashing ---- */

static void vs_share_mix(vs_share_key *k, uint64_t v) {
  k->a = vs_hash_mix(k->a, v);
  k->b = vs_hash_mix(k->b ^ UINT64_C(0xA5A5A5A5A5A5A5A5), v);
}

static void vs_share_mix_place(vs_share_key *k, double x, double quantum) {
  double steps = floor(x / quantum + 0.3819660113); /* what modellers write lies on neither side of such a step */
  vs_share_mix(k, vs_hash_real(6, steps));
}

static void vs_share_mix_vector(vs_share_key *k, vs_vec3 v, double quantum) {
  vs_share_mix_place(k, v.x, quantum);
  vs_share_mix_place(k, v.y, quantum);
  vs_share_mix_place(k, v.z, quantum);
}

static void vs_share_mix_real(vs_share_key *k, double x) {
  int exponent;
  double mantissa = frexp(x, &exponent);
  if (!isfinite(x) || x == 0) vs_share_mix(k, vs_hash_real(7, x));
  else vs_share_mix_place(k, ldexp(mantissa, 40), 1), vs_share_mix(k, (uint64_t)(int64_t)exponent);
}

/* ---- keys ---- */

static const vs_share_entry *vs_share_of(const vs_share *s, const vs_node *n) { return &s->at[*vs_nodemap_get(&s->places, n)]; }

/* The node's own first point, or its first child's anchor */
static vs_vec3 vs_share_anchor(const vs_share *s, const vs_node *n, const vs_kind_info *info) {
  if (n->kind == VS_SWEEP && n->child_count > 1) return vs_share_of(s, n->children[1].node)->anchor; /* a sweep lies where its path does */
  if (n->kind == VS_TRANSFORM) return vs_affine_point(&VS_AS(transform, n)->matrix, vs_share_of(s, n->children[0].node)->anchor);
  for (size_t i = 0; n->kind != VS_SWEEP && i < info->field_count; i++) {
    const void *at = (const char *)n->data + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_point) return *(const vs_vec3 *)at;
    if (info->fields[i].type == VS_FIELD_points && (*(const vs_points *const *)at)->count) return (*(const vs_points *const *)at)->at[0];
  }
  return n->child_count ? vs_share_of(s, n->children[0].node)->anchor : vs_v3(0, 0, 0);
}

static void vs_share_mix_fields(const vs_share *s, vs_share_key *k, const vs_node *n, const vs_kind_info *info, vs_vec3 anchor) {
  vs_vec3 from = n->kind == VS_SWEEP ? vs_v3(0, 0, 0) : anchor; /* the profile of a sweep and its base stay where they are drawn */
  for (size_t i = 0; i < info->field_count; i++) {
    const void *at = (const char *)n->data + info->fields[i].offset;
    switch (info->fields[i].type) {
      case VS_FIELD_real: vs_share_mix_real(k, *(const double *)at); break;
      case VS_FIELD_integer: vs_share_mix(k, (uint64_t)(int64_t)*(const int32_t *)at); break;
      case VS_FIELD_boolean: vs_share_mix(k, *(const bool *)at); break;
      case VS_FIELD_point: vs_share_mix_vector(k, vs_v3_sub(*(const vs_vec3 *)at, from), s->quantum); break;
      case VS_FIELD_vector: vs_share_mix_vector(k, *(const vs_vec3 *)at, s->quantum); break;
      case VS_FIELD_affine: /* the linear part; the rest is in the anchor */
        for (int r = 0; r < 3; r++)
          for (int c = 0; c < 3; c++) vs_share_mix_place(k, ((const vs_affine *)at)->m[r][c], ldexp(1, -40));
        break;
      case VS_FIELD_points: {
        const vs_points *p = *(const vs_points *const *)at;
        vs_share_mix(k, p->count);
        for (uint32_t j = 0; j < p->count; j++) vs_share_mix_vector(k, vs_v3_sub(p->at[j], from), s->quantum);
        break;
      }
      case VS_FIELD_faces: {
        const vs_faces *f = *(const vs_faces *const *)at;
        vs_share_mix(k, vs_hash_bytes(8, f->data, (f->count + 1 + (size_t)f->corner_count) * sizeof *f->data));
        break;
      }
      case VS_FIELD_text: vs_share_mix(k, vs_text_hash(*(const char *const *)at)); break;
      case VS_FIELD_material: vs_share_mix(k, vs_material_hash(*(const vs_material *const *)at)); break;
    }
  }
}

static bool vs_share_enter(void *context, vs_ref at, vs_error *e) {
  vs_share *s = context;
  const vs_node *n = at.node;
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  if (s->count == s->room) {
    size_t room = s->room ? s->room * 2 : 64;
    vs_share_entry *grown = vs_store_realloc(s->store, s->at, s->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return vs_error_memory(e, at.origin);
    s->at = grown;
    s->room = room;
  }
  vs_share_entry x = { .anchor = vs_share_anchor(s, n, info), .cost = 1, .group = s->count };
  vs_share_mix(&x.key, vs_hash_bytes(9, info->name, strlen(info->name)));
  vs_share_mix(&x.key, n->child_count);
  vs_share_mix_fields(s, &x.key, n, info, x.anchor);
  if (n->child_count > 1 && info->level == VS_LEVEL_OPERATION) x.cost = n->child_count - 1;
  for (uint32_t i = 0; i < n->child_count; i++) {
    const vs_share_entry *child = vs_share_of(s, n->children[i].node);
    vs_share_mix(&x.key, child->key.a);
    vs_share_mix(&x.key, child->key.b);
    if (n->kind == VS_SWEEP) vs_share_mix_vector(&x.key, i ? vs_v3(0, 0, 0) : child->anchor, s->quantum);
    else if (n->kind != VS_TRANSFORM && (n->kind != VS_EXTRUDE || i == 0)) vs_share_mix_vector(&x.key, vs_v3_sub(child->anchor, x.anchor), s->quantum);
    if (info->level == VS_LEVEL_OPERATION) x.cost += child->cost;
  }
  if (x.cost > 1e15) x.cost = 1e15; /* a DAG's paths may be without number */
  uint64_t *place = vs_nodemap_put(&s->places, n, NULL);
  if (!place) return vs_error_memory(e, at.origin);
  *place = s->count;
  s->at[s->count++] = x;
  return true;
}

static void vs_share_largest(double *most, const double *x, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (isfinite(x[i])) *most = fmax(*most, fabs(x[i]));
}

static bool vs_share_measure(void *context, vs_ref at, vs_error *e) { /* the drawing's largest number */
  const vs_kind_info *info = vs_kind_get((vs_kind)at.node->kind);
  (void)e;
  for (size_t i = 0; i < info->field_count; i++) {
    const void *field = (const char *)at.node->data + info->fields[i].offset;
    if (info->fields[i].type == VS_FIELD_point) vs_share_largest(context, field, 3);
    if (info->fields[i].type == VS_FIELD_affine) vs_share_largest(context, field, 12);
    if (info->fields[i].type == VS_FIELD_points && (*(const vs_points *const *)field)->count)
      vs_share_largest(context, &(*(const vs_points *const *)field)->at[0].x, 3 * (size_t)(*(const vs_points *const *)field)->count);
  }
  return true;
}

/* ---- groups ---- */

typedef struct { vs_share_key key; size_t entry; } vs_share_order;

static int vs_share_compare(const void *p, const void *q) {
  const vs_share_order *x = p, *y = q;
  if (x->key.a != y->key.a) return x->key.a < y->key.a ? -1 : 1;
  if (x->key.b != y->key.b) return x->key.b < y->key.b ? -1 : 1;
  return x->entry < y->entry ? -1 : x->entry > y->entry;
}

static bool vs_share_group(vs_share *s) {
  vs_share_order *order = vs_store_realloc(s->store, NULL, 0, (s->count + 1) * sizeof *order);
  if (!order) return false;
  for (size_t i = 0; i < s->count; i++) order[i] = (vs_share_order){ s->at[i].key, i };
  qsort(order, s->count, sizeof *order, vs_share_compare);
  for (size_t i = 0, first = 0; i < s->count; i++) {
    if (order[i].key.a != order[first].key.a || order[i].key.b != order[first].key.b) first = i;
    s->at[order[i].entry].group = order[first].entry;
    s->at[order[first].entry].copies++;
  }
  vs_store_realloc(s->store, order, (s->count + 1) * sizeof *order, 0);
  return true;
}

bool vs_share_begin(vs_rewrite *w, const vs_ref *refs, size_t count) {
  vs_share *s = vs_store_realloc(w->store, NULL, 0, sizeof *s);
  if (!s) return vs_error_memory(w->error, NULL);
  *s = (vs_share){ .store = w->store, .places = { .store = w->store } };
  w->state = s;
  double most = 0;
  if (!vs_rewrite_visit(w->store, refs, count, vs_share_measure, &most, w->error)) return false;
  s->quantum = most > 0 ? ldexp(most, -40) : 1;
  if (!(s->quantum > 0)) s->quantum = ldexp(1, -1000);
  return vs_rewrite_visit(w->store, refs, count, vs_share_enter, s, w->error) && (vs_share_group(s) || vs_error_memory(w->error, NULL));
}

void vs_share_end(vs_rewrite *w) {
  vs_share *s = w->state;
  if (!s) return;
  vs_nodemap_free(&s->places);
  vs_store_realloc(w->store, s->at, s->room * sizeof *s->at, 0);
  vs_store_realloc(w->store, s, sizeof *s, 0);
}

vs_node *vs_pass_share(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  vs_share *s = w->state;
  vs_share_entry *mine = &s->at[*vs_nodemap_get(&s->places, n)], *first = &s->at[mine->group];
  (void)origin;
  double copies = (double)first->copies;
  if (mine == first || !first->result || (copies - 1) * first->cost <= 2 * copies) {
    vs_node *kept = vs_rewrite_keep(w, n, kids);
    if (mine == first) first->result = kept;
    return kept;
  }
  w->changed++;
  vs_vec3 shift = vs_v3_sub(mine->anchor, first->anchor);
  if (fmax(fabs(shift.x), fmax(fabs(shift.y), fabs(shift.z))) < 2 * s->quantum) return vs_node_retain(first->result);
  struct vs_transform moved = { .matrix = vs_affine_translation(shift) };
  return vs_node_new(w->store, VS_TRANSFORM, &moved, &(vs_ref){ first->result, NULL }, 1);
}
