/* Computes the bounds of drawn objects (drawn_bounds.h). The world cache stores computed bounds by the node and the
 * fineness. */
#include "solids/drawn_bounds.h"
#include "geometry/plane/outline.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/measure/node_measures.h"
#include "solids/solid_meshes.h"
#include "model/store/array.h"
#include "model/store/cache.h"
#include "model/job.h"

enum { BOX_LOOK = 1 << 20, KEPT_BOUNDS = 1000 /* BOX_LOOK: greatest number of nodes that box_is_exact visits.
                                               * KEPT_BOUNDS: a word in the keys of the cache (kind VS_CACHED_MEASURE),
                                               * which distinguishes bounds of drawn objects from other measures. */ };

/* ---- a stack of nodes ---- */

typedef struct { const vs_node **at; size_t count, room; } node_stack;

static bool push_children(node_stack *s, const vs_node *n) {
  if (!VS_GROW(s->at, s->room, s->count + n->child_count)) return false;
  for (uint32_t i = 0; i < n->child_count; i++) s->at[s->count++] = n->children[i].node;
  return true;
}

static bool spreads(const vs_node *n) {
  return n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
}

/* ---- exact bounds by formula ---- */

/* Returns true if the map maps axis-parallel boxes to axis-parallel boxes: it consists of rotations by quarter turns,
 * scalings and translations. */
static bool keeps_boxes(const vs_affine *a) {
  for (int i = 0; i < 3; i++)
    if ((a->m[i][0] != 0) + (a->m[i][1] != 0) + (a->m[i][2] != 0) != 1) return false;
  return true;
}

/* Sets *exact to false if the bounds of n by formulas may be larger than the object. Checks at most BOX_LOOK nodes; if
 * there are more, these count as exact. Returns false if memory is out. */
static bool box_is_exact(const vs_node *n, bool *exact) {
  node_stack s = { 0 };
  size_t seen = 0;
  bool ok = true;
  *exact = true;
  for (;;) {
    vs_level level = vs_kind_get((vs_kind)n->kind)->level;
    if (n->kind == VS_TRANSFORM) {
      vs_affine placed = vs_affine_identity();
      int steps = 0;
      for (; steps < 16 && (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n)); steps++) {
        if (n->kind == VS_TRANSFORM) placed = vs_affine_multiply(&placed, &VS_AS(transform, n)->matrix);
        n = n->children[0].node;
      }
      level = vs_kind_get((vs_kind)n->kind)->level;
      if (steps == 16 ||
          ((level == VS_LEVEL_SWEPT || level == VS_LEVEL_OPERATION || n->child_count > 0) && !keeps_boxes(&placed)))
        *exact = false;
    }
    if (n->kind == VS_DIFFERENCE || n->kind == VS_INTERSECTION || n->kind == VS_SLICE) *exact = false;
    if (!*exact || ++seen > BOX_LOOK) break;
    if (spreads(n)) ok = push_children(&s, n);
    if (!ok || s.count == 0) break;
    n = s.at[--s.count];
  }
  free(s.at);
  return ok;
}

/* ---- the cost of a boolean of shapes ---- */

/* Returns the additional cost of node n if it has more than the usual 64 facets in a full turn, as a number of shapes.
 * The number of a sphere's facets grows with the square of this number. */
static size_t segments_cost(const vs_node *n) {
  const vs_kind_info *k = vs_kind_get((vs_kind)n->kind);
  for (size_t i = 0; i < k->field_count; i++) {
    if (k->fields[i].type != VS_FIELD_integer || strcmp(k->fields[i].name, "segments") != 0) continue;
    int32_t segments;
    memcpy(&segments, (const char *)vs_node_data(n) + k->fields[i].offset, sizeof segments);
    return segments > 64 ? (size_t)segments * (size_t)segments / 4096 : 0;
  }
  return 0;
}

static size_t shape_cost(const vs_node *n) {
  if (n->kind == VS_POLYFACE_MESH) return 1 + VS_AS(polyface_mesh, n)->points->count / 100;
  if (vs_node_has(n, VS_IS_DEAR)) return 40;
  if (vs_node_has(n, VS_IS_COSTLY)) return 8;
  return n->child_count > 0 ? 0 : 1;
}

/* Counts the shapes below n, and each placement as one more shape, until the count reaches `most`. *cost: the count.
 * Returns false if memory is out. */
static bool combine_cost(const vs_node *n, size_t most, size_t *cost) {
  node_stack s = { 0 };
  bool ok = true;
  *cost = 0;
  for (size_t seen = 0; ok && *cost <= most && seen <= 8 * most; seen++) {
    *cost += shape_cost(n) + segments_cost(n);
    ok = push_children(&s, n);
    if (!ok || s.count == 0) break;
    n = s.at[--s.count];
    if (seen == 8 * most) *cost = most + 1;
  }
  free(s.at);
  return ok;
}

/* ---- bounds of the points of a drawn object ---- */

static bool drawn_solid(const vs_ref *ref, const vs_fineness *facets, const vs_kernel_options *options, vs_bounds *out,
                        vs_error *e) {
  vs_solid solid = { 0 };
  vs_cache *cache = vs_store_cache(ref->node->store);
  const uint64_t words[] = { KEPT_BOUNDS, vs_cache_real(facets->tolerance), (uint64_t)(int64_t)facets->segments };
  const vs_cache_key key = { VS_CACHED_MEASURE, ref->node, words, 3, 0 };
  const vs_cached *held = vs_cache_find(cache, &key);
  if (held) {
    memcpy(out, held->data, sizeof *out);
    vs_cache_let_go(cache, held);
    return true;
  }
  vs_tally *tally = vs_store_tally(ref->node->store);
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  bool ok = vs_solid_evaluate(ref, 1, facets, options, &solid, e);
  vs_tally_enter(tally, was);
  if (!ok) return false;
  for (size_t i = 0; i < solid.mesh.triangle_count; i++)
    for (int k = 0; k < 3; k++) vs_bounds_add(out, solid.mesh.vertices[solid.mesh.triangles[i][k]]);
  vs_solid_free(&solid);
  vs_cache_let_go(cache, vs_cache_keep(cache, &key, &(vs_cache_piece){ out, sizeof *out }, 1));
  return true;
}

static bool drawn_region(const vs_node *n, const vs_fineness *facets, vs_bounds *out, vs_error *e) {
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(n, facets, &o, e)) return false;
  for (size_t i = 0; i < o.count; i++)
    for (size_t k = 0; k < o.loops[i].count; k++) vs_bounds_add(out, o.loops[i].at[k]);
  vs_outline_free(&o);
  return true;
}

static double drawn_in(double wide, double drawn, double near) { return fabs(wide - drawn) <= near ? wide : drawn; }

bool vs_drawn_bounds(const vs_ref *ref, vs_drawn_search *search, vs_bounds *out, vs_error *e) {
  const vs_node *n = ref->node;
  vs_bounds drawn = vs_bounds_empty();
  vs_fineness f = *search->facets;
  size_t *budget = search->budget;
  bool exact;
  size_t cost = 0;
  if (!vs_node_bounds(n, out, e)) return false;
  if (vs_bounds_is_empty(out) || (n->class_ != VS_SOLID && n->class_ != VS_REGION_CLASS)) return true;
  if (!box_is_exact(n, &exact)) return vs_error_memory(e, ref->origin);
  if (exact) return true;
  if (budget && !combine_cost(n, *budget, &cost)) return vs_error_memory(e, ref->origin);
  if (budget && cost > *budget) return search->at_most = true;
  if (budget) *budget -= cost;
  if (f.tolerance <= 0) f.tolerance = vs_fineness_tolerance(out);
  if (!(n->class_ == VS_SOLID ? drawn_solid(ref, &f, search->options, &drawn, e) : drawn_region(n, &f, &drawn, e))) {
    /* The mesher refuses the solid, so its bounds by formula are used. A format without meshes can draw the solid; a
     * format with meshes reports the refusal itself. */
    if (e->kind != VS_ERROR_MODEL) return false;
    *e = (vs_error){ VS_ERROR_NONE, NULL, "" };
    return search->at_most = true;
  }
  if (vs_bounds_is_empty(&drawn)) return *out = drawn, true;
  double near = 2 * f.tolerance;
  out->min = vs_v3(drawn_in(out->min.x, drawn.min.x, near), drawn_in(out->min.y, drawn.min.y, near),
                   drawn_in(out->min.z, drawn.min.z, near));
  out->max = vs_v3(drawn_in(out->max.x, drawn.max.x, near), drawn_in(out->max.y, drawn.max.y, near),
                   drawn_in(out->max.z, drawn.max.z, near));
  return true;
}

bool vs_drawn_bounds_all(const vs_ref *refs, size_t count, vs_drawn_search *search, vs_bounds *out, vs_error *e) {
  node_stack s = { 0 };
  bool ok = true;
  *out = vs_bounds_empty();
  for (size_t i = 0; ok && i < count; i++) {
    s.count = 0;
    for (const vs_node *n = refs[i].node; ok; n = s.at[--s.count]) {
      vs_bounds one;
      if (n->kind == VS_UNION || vs_node_is_wrapper(n)) {
        ok = push_children(&s, n) || vs_error_memory(e, refs[i].origin);
      } else {
        ok = vs_drawn_bounds(&(vs_ref){ (vs_node *)(uintptr_t)n, refs[i].origin }, search, &one, e);
        if (ok) vs_bounds_unite(out, &one);
      }
      if (s.count == 0) break;
    }
  }
  free(s.at);
  return ok;
}
