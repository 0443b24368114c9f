/* Owns the kernel's driver: clusters of leaves that touch, each evaluated by itself; the results side by side.
 *
 * Leaves whose boxes are apart cannot meet, so each cluster has its own frame and grid. The one expression serves all: in a cluster's cells the
 * leaves of the others are outside. */
#include "kernel/cluster.h"

#include <math.h>
#include <stdlib.h>

static bool join(void *parent, uint32_t a, uint32_t b) {
  vs_unite(parent, a, b);
  return true;
}

static void leaf_bounds(const vs_kernel_leaf *l, double low[3], double high[3]) {
  for (int a = 0; a < 3; a++) low[a] = INFINITY, high[a] = -INFINITY;
  for (size_t i = 0; i < l->mesh->vertex_count; i++) {
    vs_vec3 v = vs_affine_point(&l->placement, l->mesh->vertices[i]);
    double x[3] = { v.x, v.y, v.z };
    for (int a = 0; a < 3; a++) {
      if (x[a] < low[a]) low[a] = x[a];
      if (x[a] > high[a]) high[a] = x[a];
    }
  }
}

/* order: leaves by cluster, those without triangles left out; parent: beside it, which cluster. */
static bool find_clusters(vs_kernel *k, const vs_kernel_problem *p, uint32_t *parent, uint32_t *order, uint32_t *count) {
  struct { double low[3], high[3]; } *bounds = NULL, all;
  vs_box *boxes = NULL;
  uint32_t *scratch = NULL;
  size_t bounds_room = 0, box_room = 0, scratch_room = 0;
  vs_bvh bvh = { 0 };
  uint32_t n = 0;
  bool ok = VS_ROOM(k, bounds, bounds_room, (size_t)p->leaf_count + 1) && VS_ROOM(k, boxes, box_room, (size_t)p->leaf_count + 1) &&
            VS_ROOM(k, scratch, scratch_room, (size_t)p->leaf_count + 1);
  double size = 0;
  for (int a = 0; a < 3; a++) all.low[a] = INFINITY, all.high[a] = -INFINITY;
  for (uint32_t i = 0; ok && i < p->leaf_count; i++) {
    if (p->leaves[i].mesh->triangle_count == 0) continue;
    leaf_bounds(&p->leaves[i], bounds[n].low, bounds[n].high);
    for (int a = 0; a < 3; a++) {
      if (!isfinite(bounds[n].low[a]) || !isfinite(bounds[n].high[a]))
        ok = vs_kernel_fail(k, VS_KERNEL_NOT_FINITE, i, "a corner is not at a finite place");
      all.low[a] = fmin(all.low[a], bounds[n].low[a]);
      all.high[a] = fmax(all.high[a], bounds[n].high[a]);
      size = fmax(size, fmax(fabs(all.low[a]), fabs(all.high[a])));
    }
    order[n++] = i;
  }
  /* boxes in steps finer than the finest grid can be coarse here, widened by two of a cluster's own steps at the largest */
  double step = size > 0 ? size * 0x1p-28 : 1;
  for (uint32_t i = 0; ok && i < n; i++)
    for (int a = 0; a < 3; a++) {
      boxes[i].min[a] = (int32_t)floor(bounds[i].low[a] / step) - 64;
      boxes[i].max[a] = (int32_t)ceil(bounds[i].high[a] / step) + 64;
    }
  uint32_t *set = parent; /* by place in order, for now */
  for (uint32_t i = 0; i < n; i++) set[i] = i;
  ok = ok && vs_bvh_build(k, &bvh, boxes, n) && vs_bvh_pairs(&bvh, join, set);
  uint32_t *start = NULL, *sorted = NULL;
  size_t start_room = 0, sorted_room = 0;
  ok = ok && VS_ROOM(k, start, start_room, (size_t)n + 2) && VS_ROOM(k, sorted, sorted_room, (size_t)n + 1);
  if (ok) { /* bucket by root; roots are the smallest of their sets, so clusters and leaves keep their order */
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
  VS_FREE(k, bounds, bounds_room);
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
  VS_DROP(k, c->boxes);
  vs_bvh_free(k, &c->bvh);
  VS_DROP(k, c->cuts);
  VS_DROP(k, c->faces);
  VS_DROP(k, c->covers);
  VS_DROP(k, c->uses);
  VS_DROP(k, c->kept);
  VS_DROP(k, c->side_cell);
  VS_DROP(k, c->wound);
}

static bool use_before(const void *context, uint32_t a, uint32_t b) { /* of one smaller end */
  const vs_use *x = (const vs_use *)context + a, *y = (const vs_use *)context + b;
  uint32_t xh = x->from < x->to ? x->to : x->from, yh = y->from < y->to ? y->to : y->from;
  return xh != yh ? xh < yh : a < b;
}

bool vs_uses_sort(vs_kernel *k, const vs_use *uses, uint32_t *at, size_t count, size_t point_count) {
  uint32_t *first = NULL, *scratch = NULL;
  size_t first_room = 0, scratch_room = 0;
  bool ok = VS_ROOM(k, first, first_room, point_count + 2) && VS_ROOM(k, scratch, scratch_room, count + 1);
  if (ok) {
    for (size_t i = 0; i < point_count + 2; i++) first[i] = 0;
    for (size_t i = 0; i < count; i++) {
      const vs_use *u = &uses[at[i]];
      first[(u->from < u->to ? u->from : u->to) + 2]++;
      scratch[i] = at[i];
    }
    for (size_t i = 2; i < point_count + 2; i++) first[i] += first[i - 1];
    for (size_t i = 0; i < count; i++) {
      const vs_use *u = &uses[scratch[i]];
      at[first[(u->from < u->to ? u->from : u->to) + 1]++] = scratch[i];
    }
    for (size_t p = 0; p < point_count; p++) vs_kernel_sort(at + first[p], scratch, first[p + 1] - first[p], use_before, uses);
  }
  VS_FREE(k, first, first_room);
  VS_FREE(k, scratch, scratch_room);
  return ok;
}

static bool run_cluster(vs_kernel *k, const vs_kernel_problem *p, const uint32_t *leaves, uint32_t count, vs_expression *e, vs_mesh *out) {
  vs_cluster c = { .problem = p, .leaves = leaves, .leaf_count = count };
  bool ok = vs_soup_build(k, &c) && vs_kernel_report(k, 0.1) && vs_meet_triangles(k, &c) && vs_kernel_report(k, 0.3) && vs_arrange_planes(k, &c) &&
            vs_kernel_report(k, 0.7) && vs_classify_faces(k, &c, e) && vs_kernel_report(k, 0.9) && vs_output_faces(k, &c, out);
  vs_cluster_free(k, &c);
  return ok;
}

static bool want_tags(vs_kernel *k, vs_mesh *m) {
  if (m->tags || (vs_mesh_reserve(m, 0, m->triangle_count + 1) && (m->tags = calloc(m->triangle_room, sizeof *m->tags)) != NULL)) return true;
  return vs_kernel_fail(k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
}

bool vs_kernel_evaluate(const vs_kernel_problem *p, const vs_kernel_options *options, vs_mesh *out, vs_kernel_error *error) {
  vs_kernel_error ignored;
  vs_kernel k = { .options = options, .error = error ? error : &ignored };
  k.error->status = VS_KERNEL_FINE;
  k.error->leaf = 0;
  k.error->message[0] = 0;
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  vs_expression e = { 0 };
  uint32_t *parent = NULL, *order = NULL, n = 0;
  size_t parent_room = 0, order_room = 0;
  bool ok = VS_ROOM(&k, parent, parent_room, (size_t)p->leaf_count + 1) && VS_ROOM(&k, order, order_room, (size_t)p->leaf_count + 1) &&
            want_tags(&k, out) && vs_expression_build(&k, &e, p) && find_clusters(&k, p, parent, order, &n);
  for (uint32_t i = 0, end; ok && i < n; i = end) {
    for (end = i + 1; end < n && parent[end] == parent[i];) end++;
    k.done = (double)i / n;
    k.share = (double)(end - i) / n;
    ok = run_cluster(&k, p, order + i, end - i, &e, out);
  }
  vs_expression_free(&k, &e);
  VS_FREE(&k, parent, parent_room);
  VS_FREE(&k, order, order_room);
  if (!ok) out->vertex_count = vertices, out->triangle_count = triangles;
  return ok;
}
