/* Owns the triangulations and cells of points in a plane. */
#include "bind/build.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>

#include "geometry/plane/voronoi.h"

static vs_vec2 *flat_points(vs_args *f, const vs_affine *to_plane) {
  size_t n = f->arg[0].points.count;
  vs_vec2 *flat = vs_bind_scratch(f, (n + 1) * sizeof *flat);
  for (size_t i = 0; flat && i < n; i++) {
    vs_vec3 p = vs_affine_point(to_plane, f->arg[0].points.at[i]);
    flat[i] = (vs_vec2){ p.x, p.y };
  }
  return flat;
}

/* (delaunay points): triangles as lists of three of the points, counter-clockwise seen from above */
vs_status vs_p_delaunay(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].points.count, count;
  vs_affine identity = vs_affine_identity();
  uint32_t(*triangles)[3];
  vs_error e = { 0 };
  VS_ROOTS(f->vm, r, 3);
  if (n < 3) return vs_bind_refuse(f, "points", "three points or more", f->arg[0].value);
  vs_vec2 *flat = flat_points(f, &identity);
  if (!flat) return VS_ERROR;
  if (!vs_points_delaunay(flat, n, &triangles, &count, &e)) return vs_bind_error(f, &e);
  bool ok = true;
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;) {
    r[1] = VS_NIL;
    for (int k = 2; ok && k >= 0; k--)
      ok = vs_bind_point(f, f->arg[0].points.at[triangles[i][k]], &r[2]) && vs_cons(f->vm, r[2], r[1], &r[1]);
    ok = ok && vs_cons(f->vm, r[1], r[0], &r[0]) && vs_poll(f->vm, 16);
  }
  free(triangles);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* An area of the plane as a region node: loops are polylines. NULL: out of memory. */
static vs_node *region_of(vs_args *f, const vs_area *a, const vs_affine *frame) {
  vs_store *s = f->store;
  if (!a->loop_count) return vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  vs_ref *loops = vs_bind_scratch(f, a->loop_count * sizeof *loops);
  vs_vec3 *at = vs_bind_scratch(f, (a->count + 1) * sizeof *at);
  for (size_t l = 0, first = 0; loops && at && l < a->loop_count; first += a->size[l++]) {
    for (size_t i = 0; i < a->size[l]; i++)
      at[i] = vs_affine_point(frame, vs_v3(a->at[first + i].x, a->at[first + i].y, 0));
    vs_points *p = vs_points_new(s, at, a->size[l]);
    vs_node *line = p ? vs_node_new(s, VS_LINE, &(struct vs_line){ .points = p, .closed = true }, NULL, 0) : NULL;
    if (p) vs_points_release(s, p);
    if (!vs_bind_keep(f, line)) return NULL;
    loops[l] = (vs_ref){ line, NULL };
  }
  return loops && at ? vs_node_new(s, VS_REGION, &(struct vs_region){ 0 }, loops, a->loop_count) : NULL;
}

/* (voronoi points region): a region for each point, in their order; empty where nothing of a cell lies in the region */
vs_status vs_p_voronoi(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].points.count;
  vs_error e = { 0 };
  vs_outline o = { 0 };
  vs_affine back;
  vs_bounds b;
  if (!n) return vs_bind_refuse(f, "points", "one point or more", f->arg[0].value);
  vs_node *region = f->arg[1].ref.node;
  if (region->class_ == VS_CURVE && !(region->flags & VS_NODE_CLOSED))
    return vs_bind_refuse(f, "region", "a region or a closed curve", f->arg[1].value);
  if (!vs_bind_uncrossed(f, f->arg[1].ref, "region")) return VS_ERROR;
  if (!vs_node_bounds(region, &b, &e)) return vs_bind_error(f, &e);
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->bind), .segments = vs_bind_segments(f->bind) };
  if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_fineness_tolerance(&b) / 16, 1e-300);
  if (!vs_region_outline(region, &facets, &o, &e)) return vs_bind_error(f, &e);
  vs_area whole = { 0 };
  bool ok = (vs_affine_invert(&o.frame, &back) && vs_area_of_outline(&o, &o.frame, &whole)) || vs_fail_memory(f->vm);
  vs_vec2 box[2] = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (size_t i = 0; ok && i < whole.count; i++) {
    box[0].x = fmin(box[0].x, whole.at[i].x), box[0].y = fmin(box[0].y, whole.at[i].y);
    box[1].x = fmax(box[1].x, whole.at[i].x), box[1].y = fmax(box[1].y, whole.at[i].y);
  }
  double grow = ok && whole.count ? .01 * hypot(box[1].x - box[0].x, box[1].y - box[0].y) : 0;
  box[0].x -= grow, box[0].y -= grow, box[1].x += grow, box[1].y += grow;
  vs_vec2 *flat = ok ? flat_points(f, &back) : NULL;
  vs_voronoi cells = { 0 };
  ok = flat && (vs_voronoi_make(flat, n, box, &cells, &e) || vs_bind_error(f, &e));
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = n; ok && i-- > 0;) {
    vs_area pair[2] = { { 0 }, { 0 } }, met = { 0 };
    for (size_t k = cells.start[i]; ok && k < cells.start[i + 1]; k++)
      ok = vs_area_point(&pair[0], cells.at[k].x, cells.at[k].y) || vs_fail_memory(f->vm);
    ok = ok && (vs_area_loop(&pair[0], false) || vs_fail_memory(f->vm));
    pair[1] = whole;
    if (ok && pair[0].loop_count && whole.loop_count)
      ok = vs_area_combine(VS_AREA_INTERSECTION, pair, 2, "Voronoi cells", &met, &e) || vs_bind_error(f, &e);
    ok = ok && vs_bind_node(f, region_of(f, &met, &o.frame), &r[1]) && vs_cons(f->vm, r[1], r[0], &r[0]) &&
         vs_poll(f->vm, 256);
    vs_area_free(&pair[0]), vs_area_free(&met);
  }
  vs_voronoi_free(&cells);
  vs_area_free(&whole);
  vs_outline_free(&o);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
