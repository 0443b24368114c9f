/* Implements the search for clashes (clashes.h).
 *
 * A tree of the parts' boxes finds the pairs that are near each other. Pairs between which lies a plane of a face do
 * not overlap. The kernel intersects the others. Of pairs without an intersection, the gap is measured. */
#include "solids/clashes.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/measure/bounds.h"
#include "geometry/measure/measure.h"
#include "geometry/measure/mesh_gap.h"
#include "geometry/measure/mesh_parts.h"
#include "model/store/array.h"
#include "solids/near_boxes.h"
#include "solids/solid_measures.h"

#define CONTACT 1e-7 /* two parts touch if their distance is at most this fraction of their size */

enum {
  PLAIN = 60 /* an intersection with at most this number of triangles is not meshed again more finely */
};

typedef struct { uint32_t a, b; } pair;

typedef struct {
  const vs_refs *parts;
  const vs_clash_rule *rule;
  const vs_kernel_options *options;
  vs_bounds *boxes;
  vs_gap_tree **trees; /* trees of the parts' meshes, made when they are needed */
  pair *pairs;
  size_t pair_count, pair_room;
  vs_clash_list *out;
  vs_error *error;
} search;

static bool note(void *context, uint32_t a, uint32_t b) {
  search *s = context;
  if (!VS_GROW(s->pairs, s->pair_room, s->pair_count + 1)) return false;
  s->pairs[s->pair_count++] = a < b ? (pair){ a, b } : (pair){ b, a };
  return true;
}

static int by_numbers(const void *p, const void *q) {
  const pair *x = p, *y = q;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  return x->b < y->b ? -1 : x->b > y->b;
}

/* Finds the pairs of parts whose bounding boxes are at most the clearance apart. */
static bool find_pairs(search *s) {
  uint32_t n = (uint32_t)s->parts->count;
  vs_bounds all = vs_bounds_empty();
  for (uint32_t i = 0; i < n; i++) vs_bounds_unite(&all, &s->boxes[i]);
  double apart = s->rule->clearance + 2 * CONTACT * (vs_bounds_diagonal(&all) + s->rule->clearance);
  if (!vs_near_boxes(s->boxes, n, apart, s->options, note, s, s->error)) return false;
  if (s->pair_count) qsort(s->pairs, s->pair_count, sizeof *s->pairs, by_numbers);
  return true;
}

static double size_of(const search *s, pair p) {
  vs_bounds b = s->boxes[p.a];
  vs_bounds_unite(&b, &s->boxes[p.b]);
  return vs_bounds_diagonal(&b);
}

static vs_fineness fineness(const search *s, const vs_bounds *b) {
  vs_fineness f = { .tolerance = s->rule->tolerance, .segments = s->rule->segments };
  if (!(f.tolerance > 0)) f.tolerance = fmax(vs_fineness_tolerance(b) / 4, 1e-300);
  return f;
}

static bool make_tree(search *s, uint32_t i) {
  vs_solid solid = { 0 };
  if (s->trees[i]) return true;
  vs_fineness f = fineness(s, &s->boxes[i]);
  if (!vs_solid_evaluate(&s->parts->at[i], 1, &f, s->options, &solid, s->error)) return false;
  s->trees[i] = vs_gap_tree_new(&solid.mesh, s->parts->at[i].node->store, s->error);
  vs_solid_free(&solid);
  return s->trees[i] != NULL;
}

/* Sets *out to the centroid of the largest connected piece of the mesh. */
static bool largest_part(search *s, const vs_mesh *m, vs_vec3 *out) {
  vs_mesh_parts parts = { 0 };
  vs_mesh one = { 0 };
  vs_measure most = { .volume = -1 }, each;
  bool ok = vs_mesh_parts_find(m, &parts);
  for (uint32_t i = 0; ok && i < parts.count; i++) {
    ok = vs_mesh_parts_copy(m, &parts, i, &one);
    vs_mesh_measure(&one, &each);
    if (ok && each.volume > most.volume) most = each;
    vs_mesh_free(&one);
  }
  vs_mesh_parts_free(&parts);
  *out = most.centroid;
  return ok || vs_error_memory(s->error, NULL);
}

/* Sets c->volume and c->place if the parts of pair p overlap. Ignores a very thin intersection, which the rounding to
 * the kernel's grid may cause. */
static bool intersect(search *s, pair p, vs_clash *c) {
  vs_ref both[2] = { s->parts->at[p.a], s->parts->at[p.b] };
  vs_bounds common = s->boxes[p.a];
  vs_measure sum, finer;
  vs_solid solid = { 0 };
  vs_bounds_unite(&common, &s->boxes[p.b]);
  vs_node *n = vs_node_new(both[0].node->store, VS_INTERSECTION, &(struct vs_intersection){ 0 }, both, 2);
  if (!n) return vs_error_memory(s->error, NULL);
  vs_ref ref = { n, both[0].origin };
  vs_fineness f = fineness(s, &common);
  bool ok = n->kind == VS_EMPTY || vs_solid_evaluate(&ref, 1, &f, s->options, &solid, s->error);
  vs_mesh_measure(&solid.mesh, &sum);
  if (ok && sum.volume > 0 && 2 * sum.volume > CONTACT * vs_bounds_diagonal(&common) * sum.area) {
    c->volume = sum.volume;
    ok = largest_part(s, &solid.mesh, &c->place);
    if (ok && solid.mesh.triangle_count > PLAIN && !(s->rule->tolerance > 0) && !s->rule->segments) {
      ok = vs_solid_measure(ref, VS_ASK_VOLUME, 0, s->options, &finer, s->error);
      c->volume = finer.volume;
    }
  }
  vs_solid_free(&solid);
  vs_node_release(n);
  return ok;
}

static bool examine(search *s, pair p) {
  vs_clash c = { .a = p.a, .b = p.b, .kind = VS_CLASH_OVERLAP };
  vs_mesh_gap gap;
  if (!make_tree(s, p.a) || !make_tree(s, p.b)) return false;
  double touching = CONTACT * size_of(s, p);
  if (!vs_mesh_gap_separated(s->trees[p.a], s->trees[p.b], touching) && !intersect(s, p, &c)) return false;
  if (c.volume == 0) {
    if (!vs_mesh_gap_find(s->trees[p.a], s->trees[p.b], s->rule->clearance, touching, &gap)) return true;
    c.kind = gap.distance <= touching ? VS_CLASH_TOUCH : VS_CLASH_NEAR;
    if (c.kind == VS_CLASH_NEAR) c.gap = gap.distance;
    c.area = gap.area;
    c.place = gap.area > 0 ? gap.centre : vs_v3_scale(vs_v3_add(gap.at[0], gap.at[1]), 0.5);
    if (c.kind == VS_CLASH_NEAR && !(c.gap < s->rule->clearance - touching)) return true;
  }
  if (!VS_GROW(s->out->at, s->out->room, s->out->count + 1)) return vs_error_memory(s->error, NULL);
  s->out->at[s->out->count++] = c;
  return true;
}

/* Orders clashes for qsort: overlaps by falling volume, then touches by falling area, then gaps by rising distance. */
static int by_weight(const void *p, const void *q) {
  const vs_clash *x = p, *y = q;
  if (x->kind != y->kind) return x->kind < y->kind ? -1 : 1;
  if (x->volume != y->volume) return x->volume > y->volume ? -1 : 1;
  if (x->area != y->area) return x->area > y->area ? -1 : 1;
  if (x->gap != y->gap) return x->gap < y->gap ? -1 : 1;
  return by_numbers(&(pair){ x->a, x->b }, &(pair){ y->a, y->b });
}

bool vs_clashes_find(const vs_refs *parts, const vs_clash_rule *rule, const vs_kernel_options *options,
                     vs_clash_list *out, vs_error *e) {
  search s = { .parts = parts, .rule = rule, .options = options, .out = out, .error = e };
  bool ok = (VS_FRESH(s.boxes, parts->count) && (s.trees = vs_zeros(parts->count, sizeof *s.trees)) != NULL) ||
            vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < parts->count; i++) ok = vs_node_bounds(parts->at[i].node, &s.boxes[i], e);
  ok = ok && find_pairs(&s);
  for (size_t i = 0; ok && i < s.pair_count; i++) {
    ok = examine(&s, s.pairs[i]);
    if (ok && i % 16 == 0 && options && !vs_job_done(options->job, (double)i / (double)s.pair_count))
      ok = vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
  }
  if (ok && out->count) qsort(out->at, out->count, sizeof *out->at, by_weight);
  for (size_t i = 0; s.trees && i < parts->count; i++) vs_gap_tree_free(s.trees[i]);
  free(s.trees), free(s.boxes), free(s.pairs);
  return ok;
}
