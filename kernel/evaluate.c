/* Implements the evaluation of problems (evaluate.h): divides the leaves into clusters, evaluates each cluster
 * separately, and puts the results into one mesh or several.
 *
 * A cluster consists of leaves whose boxes intersect, directly or through others. Leaves of different clusters cannot
 * touch, so each cluster has its own frame and grid. All clusters use the same expression: within a cluster, every leaf
 * of another cluster counts as outside. */
#include "kernel/arrange/arrange_planes.h"
#include "kernel/arrange/classify.h"
#include "kernel/arrange/facets.h"
#include "kernel/arrange/intersect_patches.h"
#include "kernel/arrange/levels.h"
#include "kernel/arrange/patches.h"
#include "kernel/arrange/snap_to_grid.h"
#include "kernel/arrange/untouched_triangles.h"
#include "kernel/check.h"
#include "kernel/evaluate.h"
#include "kernel/clip.h"
#include "kernel/cluster.h"
#include "kernel/cluster_copies.h"
#include "kernel/assemble.h"
#include "kernel/cluster_cache.h"
#include "kernel/mesh/inspect.h"
#include "kernel/mesh/make_result.h"
#include "kernel/threads.h"
#include "model/store/cache.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool join(void *parent, uint32_t a, uint32_t b) {
  vs_unite(parent, a, b);
  return true;
}

static double least(const vs_bounds *b, int axis) { return axis == 0 ? b->min.x : axis == 1 ? b->min.y : b->min.z; }
static double most(const vs_bounds *b, int axis) { return axis == 0 ? b->max.x : axis == 1 ? b->max.y : b->max.z; }

enum {
  SERIAL = 10000, /* number of corners below which a single thread does all the work */
  LEAVES = 16     /* number of leaves that one task handles */
};

typedef struct { const vs_kernel_problem *problem; vs_bounds *bounds; } bounding;

static bool bound_some(vs_kernel *k, void *context, size_t index) {
  const bounding *b = context;
  size_t begin = index * LEAVES,
         end = b->problem->leaf_count - begin < LEAVES ? b->problem->leaf_count : begin + LEAVES;
  for (size_t i = begin; i < end; i++) {
    const vs_kernel_leaf *l = &b->problem->leaves[i];
    b->bounds[i] = l->mesh->triangle_count ? vs_mesh_placed_bounds(l->mesh, &l->placement) : vs_bounds_empty();
    if (!vs_kernel_report(k, 0)) return false;
  }
  return true;
}

static bool bound_leaves(vs_kernel *k, const vs_kernel_problem *p, vs_bounds *bounds) {
  size_t corners = 0;
  uint32_t threads = k->threads;
  for (uint32_t i = 0; i < p->leaf_count; i++) corners += p->leaves[i].mesh->vertex_count;
  if (corners < SERIAL) k->threads = 1;
  bool ok = vs_kernel_run(k, ((size_t)p->leaf_count + LEAVES - 1) / LEAVES, bound_some, &(bounding){ p, bounds });
  k->threads = threads;
  return ok;
}

/* Divides the leaves into clusters. `bounds[i]`: bounds of leaf i, which the function reduces to the region where the
 * leaf can influence the result. `order`: receives the *count leaves that have triangles, sorted by cluster.
 * `parent[i]`: receives the cluster of leaf order[i]. */
static bool find_clusters(vs_kernel *k, const vs_kernel_problem *p, vs_bounds *bounds, uint32_t *parent,
                          uint32_t *order, uint32_t *count) {
  vs_bvh_box *boxes = NULL;
  uint32_t *scratch = NULL;
  size_t box_room = 0, scratch_room = 0;
  vs_bvh bvh = { 0 };
  uint32_t n = 0;
  bool ok = VS_ROOM(k, boxes, box_room, (size_t)p->leaf_count + 1) &&
            VS_ROOM(k, scratch, scratch_room, (size_t)p->leaf_count + 1);
  double size = 0;
  for (uint32_t i = 0; ok && i < p->leaf_count; i++) {
    if (p->leaves[i].mesh->triangle_count == 0) continue;
    if (p->within) {
      vs_bounds part = bounds[i];
      vs_bounds_meet(&part, &p->within[i]);
      if (vs_bounds_is_empty(&part) && !vs_bounds_is_empty(&bounds[i])) continue;
      bounds[i] = part;
    }
    for (int a = 0; a < 3; a++) {
      if (!isfinite(least(&bounds[i], a)) || !isfinite(most(&bounds[i], a)))
        ok = vs_kernel_fail(k, VS_KERNEL_NOT_FINITE, i, "a corner is not at a finite place");
      size = fmax(size, fmax(fabs(least(&bounds[i], a)), fabs(most(&bounds[i], a))));
    }
    order[n++] = i;
    ok = ok && vs_kernel_poll(k, 0);
  }
  /* The boxes are in units of 2^-28 of the extent of all leaves. They are enlarged by 64 units on each side, which is
   * at least two grid steps of any cluster. */
  double step = size > 0 ? size * 0x1p-28 : 1;
  for (uint32_t i = 0; ok && i < n; i++)
    for (int a = 0; a < 3; a++) {
      boxes[i].min[a] = (int32_t)floor(least(&bounds[order[i]], a) / step) - 64;
      boxes[i].max[a] = (int32_t)ceil(most(&bounds[order[i]], a) / step) + 64;
    }
  uint32_t *set = parent; /* during this function, the array contains the union-find parents of the leaves */
  vs_disjoint(set, n);
  ok = ok && vs_bvh_build(k, &bvh, boxes, n) && vs_bvh_pairs(k, &bvh, 0, UINT32_MAX, join, set);
  uint32_t *start = NULL, *sorted = NULL;
  size_t start_room = 0, sorted_room = 0;
  ok = ok && VS_ROOM(k, start, start_room, (size_t)n + 2) && VS_ROOM(k, sorted, sorted_room, (size_t)n + 1);
  if (ok) { /* Sorts the leaves by cluster, and within a cluster by number. The root of each union-find set is its
             * smallest number. Therefore the clusters are in order, too. */
    for (uint32_t i = 0; i < n + 2; i++) start[i] = 0;
    for (uint32_t i = 0; i < n; i++) scratch[i] = vs_find(set, i), start[scratch[i] + 2]++;
    for (uint32_t i = 2; i < n + 2; i++) start[i] += start[i - 1];
    for (uint32_t i = 0; i < n; i++) sorted[start[scratch[i] + 1]++] = i;
    for (uint32_t i = 0; i < n; i++) start[i] = order[sorted[i]], parent[i] = scratch[sorted[i]];
    for (uint32_t i = 0; i < n; i++) order[i] = start[i];
  }
  VS_FREE(k, start, start_room);
  VS_FREE(k, sorted, sorted_room);
  *count = n;
  vs_bvh_free(k, &bvh);
  VS_FREE(k, boxes, box_room);
  VS_FREE(k, scratch, scratch_room);
  return ok;
}

void vs_cluster_free(vs_kernel *k, vs_cluster *c) {
  vs_points_free(k, &c->points);
  vs_planes_free(k, &c->planes);
  VS_DROP(k, c->triangles);
  VS_DROP(k, c->facets);
  VS_DROP(k, c->facet_triangles);
  VS_DROP(k, c->sheets);
  VS_DROP(k, c->patches);
  VS_DROP(k, c->patch_corners);
  VS_DROP(k, c->boxes);
  vs_bvh_free(k, &c->bvh);
  for (size_t i = 0; i < c->placed.count; i++) {
    vs_bvh_free(k, &c->placed.at[i].bvh);
    VS_FREE(k, c->placed.at[i].bvh_boxes, c->placed.at[i].bvh_box_room);
  }
  VS_DROP(k, c->fate);
  VS_DROP(k, c->region_of);
  VS_DROP(k, c->regions);
  VS_DROP(k, c->point_of);
  VS_DROP(k, c->placed);
  VS_FREE(k, c->corners, c->corner_room);
  vs_bvh_free(k, &c->leaf_bvh);
  VS_DROP(k, c->leaf_boxes);
  VS_DROP(k, c->lids);
  VS_DROP(k, c->lid_boxes);
  VS_DROP(k, c->cuts);
  VS_DROP(k, c->edge_of);
  VS_DROP(k, c->faces);
  VS_DROP(k, c->covers);
  VS_DROP(k, c->uses);
  vs_halves_free(k, &c->edges);
  VS_DROP(k, c->kept);
  VS_DROP(k, c->side_cell);
  VS_DROP(k, c->wound);
  VS_DROP(k, c->sides);
  VS_DROP(k, c->lines);
  VS_DROP(k, c->use_line);
  VS_FREE(k, c->solid, c->solid_room);
  VS_FREE(k, c->layered, c->layered_room);
}

typedef struct {
  const vs_kernel_problem *problem;
  vs_parts parts;
  vs_expression expression;
  vs_bounds gate; /* bounds in world coordinates outside of which the expression is false, because an operand limits the
                   * result (a gate); empty if there is none */
  vs_bounds *bounds; /* bounds of each leaf; NULL once they are no longer needed */
  vs_remember remember;
  vs_placing placing;
  vs_kernel_counts counts;
  size_t triangles; /* number of triangles in all meshes of the result, so far */
} whole;

/* Frees the patches and their boxes once the patches are intersected. The next steps need about as much memory
 * again. */
static void forget_patches(vs_kernel *k, vs_cluster *c) {
  VS_DROP(k, c->patches);
  VS_DROP(k, c->patch_corners);
  VS_DROP(k, c->boxes);
  vs_bvh_free(k, &c->bvh);
  vs_planes_forget(k, &c->planes);
}

/* Returns true if the leaf can be united with other leaves two by two before the whole cluster is arranged
 * (levels.c). */
static bool can_be_layered(const vs_cluster *c, uint32_t place) {
  return c->expression->forces.at[c->leaves[place]] && c->placed.at[place].star && c->placed.at[place].part->volume > 0;
}

static bool arrange_at_once(vs_kernel *k, vs_cluster *c) {
  bool ok = vs_patches_build(k, c) && vs_kernel_lap(k, VS_STEP_PATCHES) && vs_kernel_report(k, 0.1);
  VS_ASSERT(!ok || vs_holds_patches(c));
  ok = ok && vs_meet_patches(k, c) && vs_kernel_report(k, 0.3);
  VS_ASSERT(!ok || vs_holds_cuts(c));
  forget_patches(k, c);
  return ok && vs_kernel_lap(k, VS_STEP_MEET) && vs_arrange_planes(k, c);
}

/* Discards the arrangement of the cluster, and arranges its triangles again level by level (levels.c). */
static bool arrange_in_levels(vs_kernel *k, vs_cluster *c, vs_expression *e) {
  size_t leaves = c->problem->leaf_count;
  forget_patches(k, c);
  vs_points_free(k, &c->points);
  vs_planes_free(k, &c->planes);
  VS_DROP(k, c->triangles);
  VS_DROP(k, c->facets);
  VS_DROP(k, c->facet_triangles);
  VS_DROP(k, c->fate);
  VS_DROP(k, c->point_of);
  VS_DROP(k, c->cuts);
  VS_DROP(k, c->edge_of);
  VS_DROP(k, c->faces);
  VS_DROP(k, c->covers);
  VS_DROP(k, c->uses);
  c->plain_count = 0;
  c->crowded = false;
  if (!VS_ROOM(k, c->layered, c->layered_room, leaves + 1) ||
      !VS_ROOM(k, c->solid, c->solid_room, leaves + 1)) return false;
  memset(c->layered, 0, leaves);
  vs_disjoint(c->solid, (uint32_t)leaves);
  for (uint32_t i = 0; i < c->leaf_count; i++) c->layered[c->leaves[i]] = can_be_layered(c, i);
  return vs_plain_find(k, c) && vs_facets_build(k, c) && vs_kernel_lap(k, VS_STEP_PATCHES) &&
      vs_unite_levels(k, c, e) && vs_kernel_lap(k, VS_STEP_MEET) && vs_arrange_planes(k, c);
}

static bool run_cluster(vs_kernel *k, whole *w, vs_group group, vs_mesh *out) {
  const uint32_t *leaves = group.at, count = group.count;
  vs_cluster c = {
    .problem = w->problem, .parts = &w->parts, .expression = &w->expression, .leaves = leaves, .leaf_count = count
  };
  if (w->expression.gate_count) c.gate = &w->gate;
  uint32_t threads = k->threads;
  size_t triangles = 0, first = out->triangle_count;
  for (uint32_t i = 0; i < count; i++) triangles += w->problem->leaves[leaves[i]].mesh->triangle_count;
  if (triangles < SERIAL) k->threads = 1;
  if (!vs_kernel_report(k, 0)) return k->threads = threads, false;
  vs_check check = { .leaves = { 0 } };
  bool ok = vs_snap_to_grid(k, &c) && vs_kernel_report(k, 0) && vs_check_leaves(k, &c, &check, &w->counts) &&
            vs_kernel_lap(k, VS_STEP_GRID);
  VS_ASSERT(!ok || vs_holds_grid(&c));
  if (c.triangles.count + c.plain_count < SERIAL) k->threads = 1;
  for (uint32_t i = 0; ok && i < count; i++) {
    c.crowd += can_be_layered(&c, i);
    ok = vs_kernel_poll(k, 0);
  }
  c.crowded = k->options && k->options->in_levels && c.crowd > 0;
  bool arranged = ok && !c.crowded && arrange_at_once(k, &c);
  bool too_much = ok && !arranged && c.crowded && k->error->status == VS_KERNEL_FINE;
  if (too_much) arranged = arrange_in_levels(k, &c, &w->expression);
  ok = arranged && vs_plain_regions(k, &c);
  VS_DROP(k, c.cuts);
  VS_DROP(k, c.edge_of);
  VS_ASSERT(!ok || vs_holds_faces(&c));
  ok = ok && vs_kernel_lap(k, VS_STEP_ARRANGE) && vs_kernel_report(k, 0.7) && vs_classify_faces(k, &c, &w->expression);
  VS_ASSERT(!ok || vs_holds_kept(&c));
  ok = ok && vs_kernel_lap(k, VS_STEP_CLASSIFY) && vs_kernel_report(k, 0.9);
  ok = ok && vs_output_faces(k, &c, out) && vs_check_result(k, &c, &check, out, first);
  w->counts.straightened += c.straightened;
  VS_ASSERT(!ok || vs_holds_result(out, first));
  k->threads = threads;
  if (!ok && k->error->status == VS_KERNEL_INTERNAL) k->error->leaf = leaves[0]; /* the faulty leaf is unknown, so the
                                                                                  * error names the first leaf of the
                                                                                  * cluster */
  vs_check_free(k, &check);
  vs_cluster_free(k, &c);
  vs_kernel_lap(k, VS_STEP_OUTPUT);
  return ok;
}

/* Computes w->gate, the bounds outside of which the result is empty, from the bounds of all terms. Returns false when
 * memory is out. */
static bool find_gate(vs_kernel *k, whole *w, const vs_bounds *leaves) {
  VS_LIST(vs_bounds) terms = { 0 };
  const vs_kernel_problem *p = w->problem;
  if (!w->expression.gate_count) return true;
  if (!VS_ROOM(k, terms.at, terms.room, (size_t)p->term_count + 1)) return false;
  for (uint32_t i = 0; i < p->term_count; i++) {
    const vs_kernel_term *t = &p->terms[i];
    vs_bounds b = t->kind == VS_TERM_LEAF ? leaves[t->first] : vs_bounds_empty();
    for (uint32_t j = 0; t->kind != VS_TERM_LEAF && j < t->count; j++) {
      const vs_bounds *o = &terms.at[p->operands[t->first + j]];
      if (j == 0) b = *o;
      else if (t->kind == VS_TERM_UNION) vs_bounds_unite(&b, o);
      else if (t->kind == VS_TERM_INTERSECTION) vs_bounds_meet(&b, o);
    }
    terms.at[i] = b;
  }
  w->gate = terms.at[w->expression.gates[0]];
  for (uint32_t i = 1; i < w->expression.gate_count; i++) vs_bounds_meet(&w->gate, &terms.at[w->expression.gates[i]]);
  VS_DROP(k, terms);
  return true;
}

/* Returns true if the cluster extends beyond w->gate, the bounds outside of which the result is empty. */
static bool gate_cuts(const whole *w, vs_group leaves) {
  if (!w->expression.gate_count) return false;
  if (w->problem->within) return true; /* The leaves' bounds were already reduced to the bounds outside of which the
                                        * result is empty. Therefore a comparison would not show that the cluster
                                        * extends beyond them. */
  vs_bounds all = w->gate;
  for (uint32_t i = 0; i < leaves.count; i++) vs_bounds_unite(&all, &w->bounds[leaves.at[i]]);
  return memcmp(&all, &w->gate, sizeof all) != 0;
}

static bool no_room(vs_kernel *k) {
  return vs_kernel_no_memory(k);
}

static bool want_tags(vs_kernel *k, vs_mesh *m) { return vs_mesh_want_tags(m) || no_room(k); }

/* Sets *alone to true if the cluster is one leaf that touches neither another leaf nor itself. The kernel then copies
 * or drops this leaf without a grid. Returns false on failure. */
static bool stands_alone(vs_kernel *k, whole *w, vs_group leaves, bool *alone) {
  enum { FLAT = 1 << 20 }; /* greatest factor by which a placement may flatten the mesh; up to this factor, the
                            * inspection of the mesh is valid for the placed leaf */
  const vs_kernel_leaf *l = &w->problem->leaves[leaves.at[0]];
  vs_part *part = &w->parts.all.at[w->parts.of_leaf.at[leaves.at[0]]];
  *alone = false;
  if (leaves.count != 1) return true;
  double size = 1;
  for (int i = 0; i < 3; i++) {
    const double x = l->placement.m[0][i], y = l->placement.m[1][i], z = l->placement.m[2][i];
    size *= sqrt(x * x + y * y + z * z);
  }
  if (!(fabs(vs_affine_determinant(&l->placement)) * FLAT > size)) return true;
  if (l->mesh->settled) part->alone = VS_GOOD;
  if (!part->star && part->alone == VS_UNASKED) {
    bool good;
    if (!vs_part_plainly_good(k, part, &good)) return false;
    part->alone = good ? VS_GOOD : VS_DOUBTFUL;
  }
  *alone = part->star || part->alone == VS_GOOD;
  return true;
}

/* If the expression is true inside the leaf, reserves space for a copy of the leaf in the mesh `out`. into: index of
 * this mesh among the results. */
static bool place_leaf(vs_kernel *k, whole *w, const uint32_t *leaf, vs_mesh *out, uint32_t into) {
  const vs_kernel_leaf *l = &w->problem->leaves[*leaf];
  vs_placement p = { .mesh = l->mesh,
                     .from = { 0, 0, l->mesh->vertex_count, l->mesh->triangle_count },
                     .into = into,
                     .vertex = out->vertex_count,
                     .triangle = out->triangle_count,
                     .map = l->placement,
                     .leaves = leaf };
  if (!vs_expression_add(k, &w->expression, *leaf, 1)) return false;
  bool inside = vs_expression_value(&w->expression);
  if (!vs_expression_add(k, &w->expression, *leaf, -1)) return false;
  return !inside || (vs_placing_room(k, out, p.from.vertices, p.from.triangles) && VS_PUSH(k, w->placing.meshes, p));
}

/* Appends the cluster's triangles to out: a copy from the cache if the cache contains the cluster; otherwise the result
 * of a new evaluation. */
static bool make_cluster(vs_kernel *k, whole *w, vs_copies *copies, vs_group leaves, vs_mesh *out, uint32_t into) {
  bool alone;
  if (!stands_alone(k, w, leaves, &alone)) return false;
  if (alone) return w->counts.combined++, place_leaf(k, w, leaves.at, out, into);
  bool asked = w->bounds != NULL, found = false;
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  if (asked && !vs_remember_key(k, &w->remember, copies, leaves, gate_cuts(w, leaves) ? &w->gate : NULL, &asked))
    return false;
  if (asked && !(vs_kernel_report(k, 0) && vs_remember_find(k, &w->remember, out, &found) && vs_kernel_report(k, 0)))
    return false;
  ++*(found ? &w->counts.remembered : &w->counts.combined);
  w->counts.straightened += found && k->options->straight; /* The cache does not store how many bends (corners where a
                                                            * cut passes between two facets) were removed. Therefore
                                                            * each cached cluster counts as one. */
  return found || (run_cluster(k, w, leaves, out) &&
                   (!asked || vs_remember_keep(k, &w->remember, out, vertices, triangles)));
}

/* Destination of the results: the mesh `one` for all clusters, or the array `many` with a separate mesh for each
 * original cluster. */
typedef struct {
  vs_mesh *one;
  vs_kernel_copies *many;
  VS_LIST(vs_range) ranges; /* ranges[i]: range of vertices and triangles of the mesh `one` that originals[i] (a cluster
                             * without an earlier copy) has made */
} sink;

static bool add_mesh(vs_kernel *k, vs_kernel_copies *c, vs_mesh **made) {
  if (!VS_ROOM(k, c->meshes, c->mesh_room, c->mesh_count + 1)) return false;
  *made = &c->meshes[c->mesh_count++];
  **made = (vs_mesh){ 0 };
  return want_tags(k, *made);
}

/* Adds the triangles of the mesh `made` to the count. Returns false and sets the error if all meshes of the result
 * together exceed the limit on triangles. */
static bool count_result(vs_kernel *k, whole *w, const vs_mesh *made) {
  size_t limit = k->options ? k->options->max_triangles : 0;
  w->triangles += made->triangle_count;
  return !limit || w->triangles <= limit ||
         vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
}

static bool give_cluster(vs_kernel *k, whole *w, vs_copies *copies, sink *to, vs_group leaves) {
  vs_cluster_copy copy;
  if (!vs_copies_find(k, copies, leaves, &copy)) return false;
  vs_kernel_lap(k, VS_STEP_CLUSTERS);
  w->counts.clusters++;
  w->counts.copied += !copy.is_new;
  if (to->many) {
    vs_mesh *made;
    if (copy.is_new && (!add_mesh(k, to->many, &made) || !make_cluster(k, w, copies, leaves, made, copy.original) ||
                        !count_result(k, w, made)))
      return false;
    if (to->many->meshes[copy.original].triangle_count == 0) return true;
    return VS_ROOM(k, to->many->copies, to->many->copy_room, to->many->copy_count + 1) &&
           (to->many->copies[to->many->copy_count++] = (vs_kernel_copy){ copy.original, copy.map }, true);
  }
  if (!copy.is_new) { /* the copied cluster may have other tags than the original cluster, with the same paints */
    vs_placement p = { .from = to->ranges.at[copy.original],
                       .vertex = to->one->vertex_count,
                       .triangle = to->one->triangle_count,
                       .map = copy.map,
                       .were = copies->originals.at[copy.original].leaves.at,
                       .leaves = leaves.at,
                       .leaf_count = leaves.count };
    return vs_placing_room(k, to->one, p.from.vertices, p.from.triangles) && VS_PUSH(k, w->placing.again, p) &&
           vs_kernel_report(k, 0);
  }
  vs_range range = { .vertex = to->one->vertex_count, .triangle = to->one->triangle_count };
  if (!make_cluster(k, w, copies, leaves, to->one, 0)) return false;
  range.vertices = to->one->vertex_count - range.vertex;
  range.triangles = to->one->triangle_count - range.triangle;
  return VS_PUSH(k, to->ranges, range);
}

static void count_in(vs_kernel_counts *sum, const vs_kernel_counts *c, size_t peak) {
  sum->clusters += c->clusters;
  sum->combined += c->combined;
  sum->copied += c->copied;
  sum->remembered += c->remembered;
  if (sum->coarse == 0)
    sum->coarse_leaf = c->coarse_leaf, sum->coarse_step = c->coarse_step, sum->coarse_by = c->coarse_by;
  sum->coarse += c->coarse;
  sum->straightened += c->straightened;
  for (int i = 0; i < VS_STEP_COUNT; i++) sum->seconds[i] += c->seconds[i];
  if (peak > sum->peak) sum->peak = peak;
}

static bool evaluate(const vs_kernel_problem *given, const vs_kernel_options *options, sink *to,
                     vs_kernel_error *error) {
  vs_kernel_error ignored;
  vs_kernel k = { .options = options, .error = error ? error : &ignored, .threads = vs_kernel_threads(options) };
  k.error->status = VS_KERNEL_FINE;
  k.error->leaf = 0;
  k.error->message[0] = 0;
  vs_clipped clipped = { .problem = *given };
  const vs_kernel_problem *p = &clipped.problem;
  whole w = { .problem = p, .gate = vs_bounds_empty() };
  vs_kernel_time(&k, options && options->counts ? w.counts.seconds : NULL);
  vs_copies copies = { .problem = p };
  vs_bounds *bounds = NULL;
  uint32_t *parent = NULL, *order = NULL, n = 0;
  size_t parent_room = 0, order_room = 0, bounds_room = 0, most_leaves = (size_t)p->leaf_count + 1;
  bool ok = VS_ROOM(&k, parent, parent_room, most_leaves) && VS_ROOM(&k, order, order_room, most_leaves) &&
            VS_ROOM(&k, bounds, bounds_room, most_leaves) && (to->many || want_tags(&k, to->one)) &&
            bound_leaves(&k, given, bounds) && vs_clip_leaves(&k, given, bounds, &clipped) &&
            vs_expression_build(&k, &w.expression, p) && find_clusters(&k, p, bounds, parent, order, &n) &&
            find_gate(&k, &w, bounds) && vs_kernel_lap(&k, VS_STEP_CLUSTERS) &&
            vs_parts_prepare(&k, &w.parts, p, order, parent, n) && vs_kernel_lap(&k, VS_STEP_PARTS) &&
            vs_copies_begin(&k, &copies, p, &w.parts, &w.expression);
  w.bounds = ok && options && vs_cache_asks(options->cache) && p->identities ? bounds : NULL;
  if (!w.bounds) VS_FREE(&k, bounds, bounds_room);
  for (uint32_t i = 0, end; ok && i < n; i = end) {
    for (end = i + 1; end < n && parent[end] == parent[i];) end++;
    k.done = (double)i / n;
    k.share = (double)(end - i) / n;
    ok = give_cluster(&k, &w, &copies, to, (vs_group){ order + i, end - i });
  }
  ok = ok && vs_kernel_lap(&k, VS_STEP_CLUSTERS) &&
       vs_placing_finish(&k, &w.placing, p->leaves, to->one ? to->one : to->many->meshes) &&
       vs_kernel_lap(&k, VS_STEP_PLACE);
  if (options && options->counts) count_in(options->counts, &w.counts, k.peak);
  vs_remember_free(&k, &w.remember);
  VS_FREE(&k, bounds, bounds_room);
  VS_DROP(&k, to->ranges);
  vs_placing_free(&k, &w.placing);
  vs_copies_free(&k, &copies);
  vs_expression_free(&k, &w.expression);
  vs_parts_free(&k, &w.parts);
  VS_FREE(&k, parent, parent_room);
  VS_FREE(&k, order, order_room);
  vs_clipped_free(&k, &clipped);
  return ok;
}

bool vs_kernel_evaluate(const vs_kernel_problem *p, const vs_kernel_options *options, vs_mesh *out,
                        vs_kernel_error *error) {
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  if (evaluate(p, options, &(sink){ .one = out }, error)) return true;
  out->vertex_count = vertices;
  out->triangle_count = triangles;
  return false;
}

bool vs_kernel_evaluate_copies(const vs_kernel_problem *p, const vs_kernel_options *options, vs_kernel_copies *out,
                               vs_kernel_error *error) {
  *out = (vs_kernel_copies){ .mesh_count = 0 };
  if (evaluate(p, options, &(sink){ .many = out }, error)) return true;
  vs_kernel_copies_free(out);
  return false;
}

void vs_kernel_copies_free(vs_kernel_copies *c) {
  for (size_t i = 0; i < c->mesh_count; i++) vs_mesh_free(&c->meshes[i]);
  free(c->meshes);
  free(c->copies);
  *c = (vs_kernel_copies){ .mesh_count = 0 };
}
