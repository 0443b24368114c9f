/* Implements the natives of form-find and similar procedures. nets.scm calls them with checked arguments: a net,
 * which consists of points and members, as flat lists. Also implements triangulations and Voronoi cells of points in
 * a plane. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/operations.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "geometry/measure/bounds.h"
#include "geometry/nets/geodesic.h"
#include "geometry/nets/packing.h"
#include "geometry/nets/planarity.h"
#include "geometry/nets/relaxation.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/plane/skeleton.h"
#include "geometry/plane/voronoi.h"
#include "vm/machine/fail.h"

/* Returns the next number of a list, which nets.scm has checked, and advances *l. */
static double next(vs_scheme *vm, vs_value *l) {
  double d = 0;
  if (!vs_is_pair(*l)) return 0;
  vs_bind_take_number(vm, vs_car(*l), &d);
  *l = vs_cdr(*l);
  return d;
}

/* Sets *out to a list of n points. */
static bool point_list(vs_args *f, const vs_vec3 *at, size_t n, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = n; i-- > 0;)
    if (!vs_bind_give_point(f, at[i], &r[1]) || !vs_cons(vm, r[1], r[0], &r[0]) || !vs_poll_turn(vm, i, 4))
      return false;
  *out = r[0];
  return true;
}

static vs_status unsettled(vs_args *f, vs_relax_outcome outcome, const vs_relax_report *report, const vs_net *n) {
  vs_scheme *vm = vs_call_vm(f);
  char a[32], b[32];
  switch (outcome) {
  case VS_RELAX_LOOSE:
    return vs_fail(vm, vm->sym.range, "point %zu is loaded, and no members lead from that point to a fixed point",
                   report->where + 1);
  case VS_RELAX_SHORT: {
    const vs_net_member *m = &n->members[report->where];
    vs_bind_number_text(a, m->length);
    vs_bind_number_text(b, vs_v3_length(vs_v3_sub(n->at[m->b], n->at[m->a])));
    return vs_fail(
        vm, vm->sym.range,
        "the cables are too short between the fixed points: member %zu is to be %s long and is stretched to %s",
        report->where + 1, a, b);
  }
  case VS_RELAX_FAR:
    vs_bind_number_text(a, report->residual);
    return vs_fail(vm, vm->sym.range,
                   "no equilibrium was found in %zu steps: a share of %s of the forces is not balanced", report->steps,
                   a);
  case VS_RELAX_STOPPED: return VS_ERROR; /* vm->condition is already set */
  case VS_RELAX_MEMORY:
  case VS_RELAX_DONE: break;
  }
  return vs_fail_memory(vm);
}

/* (%form-find points members fixed loads weight stiffness tolerance): returns a list of the moved points, the forces of
 * the members, the residual force and the number of steps. The members are a flat list with four numbers for each:
 * from, to (indices from 0), length, density. The loads are gvectors. */
vs_status vs_p_form_find(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count;
  vs_value l = vs_arg_value(f, 1);
  int64_t numbers = vs_list_length(l);
  vs_net net = { .count = n, .member_count = numbers > 0 ? (size_t)numbers / 4 : 0, .weight = vs_arg_point(f, 4) };
  vs_relax_report report;
  VS_ROOTS(vm, r, 3);
  net.at = vs_bind_scratch(f, (n + 1) * sizeof *net.at);
  bool *fixed = vs_bind_scratch(f, (n + 1) * sizeof *fixed);
  vs_vec3 *load = vs_bind_scratch(f, (n + 1) * sizeof *load);
  net.members = vs_bind_scratch(f, (net.member_count + 1) * sizeof *net.members);
  if (!net.at || !fixed || !load || !net.members) return VS_ERROR;
  memcpy(net.at, vs_arg_points(f, 0).at, n * sizeof *net.at);
  for (size_t k = 0; k < net.member_count; k++) {
    double a = next(vm, &l), b = next(vm, &l), length = next(vm, &l), density = next(vm, &l);
    net.members[k] = (vs_net_member){ .a = (uint32_t)a, .b = (uint32_t)b, .length = length, .density = density };
    if (net.members[k].a >= n || net.members[k].b >= n)
      return vs_fail(vm, vm->sym.range, "a member ends at none of the points");
  }
  memset(fixed, 0, n * sizeof *fixed);
  for (l = vs_arg_value(f, 2); vs_is_pair(l);) {
    size_t i = (size_t)next(vm, &l);
    if (i < n) fixed[i] = true;
  }
  l = vs_arg_value(f, 3);
  for (size_t i = 0; i < n; i++) {
    load[i].x = next(vm, &l), load[i].y = next(vm, &l), load[i].z = next(vm, &l);
  }
  net.fixed = fixed, net.load = load, net.stiffness = vs_arg_real(f, 5);
  vs_relax_outcome outcome = vs_net_relax(&net, vs_arg_real(f, 6), (vs_long_work){ vs_bind_keep_going, vm }, &report);
  if (outcome != VS_RELAX_DONE) return unsettled(f, outcome, &report, &net);
  r[0] = r[1] = VS_NIL;
  bool ok = vs_cons(vm, vs_fix((int64_t)report.steps), r[1], &r[1]) &&
            vs_cons(vm, vs_flonum(report.residual), r[1], &r[1]);
  for (size_t k = net.member_count; ok && k-- > 0;)
    ok = vs_cons(vm, vs_flonum(net.members[k].force), r[0], &r[0]) && vs_poll_turn(vm, k, 4);
  return ok && vs_cons(vm, r[0], r[1], &r[1]) && point_list(f, net.at, n, &r[2]) && vs_cons(vm, r[2], r[1], out);
}

/* (%planarise points faces fixed tolerance): returns the moved points, and the greatest distance of a corner from the
 * plane of its face. The faces are a flat list: for each face the number of its corners, then their indices from 0. */
vs_status vs_p_planarise(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count, corners = 0, faces = 0;
  int64_t numbers = vs_list_length(vs_arg_value(f, 1));
  if (numbers < 0) return vs_fail(vm, vm->sym.type, "faces must be a list");
  vs_vec3 *at = vs_bind_scratch(f, (n + 1) * sizeof *at);
  bool *fixed = vs_bind_scratch(f, (n + 1) * sizeof *fixed);
  uint32_t *corner = vs_bind_scratch(f, ((size_t)numbers + 1) * sizeof *corner);
  uint32_t *start = vs_bind_scratch(f, ((size_t)numbers + 1) * sizeof *start);
  if (!at || !fixed || !corner || !start) return VS_ERROR;
  memcpy(at, vs_arg_points(f, 0).at, n * sizeof *at);
  memset(fixed, 0, n * sizeof *fixed);
  start[0] = 0;
  for (vs_value l = vs_arg_value(f, 1); vs_is_pair(l); start[++faces] = (uint32_t)corners)
    for (size_t k = (size_t)next(vm, &l); k-- > 0; corners++) {
      double i = next(vm, &l);
      if (!(i >= 0 && i < (double)n)) return vs_fail(vm, vm->sym.range, "a face has no corner");
      corner[corners] = (uint32_t)i;
    }
  for (vs_value l = vs_arg_value(f, 2); vs_is_pair(l);) {
    size_t i = (size_t)next(vm, &l);
    if (i < n) fixed[i] = true;
  }
  vs_net_faces net = { .at = at, .count = n, .fixed = fixed, .corner = corner, .start = start, .face_count = faces };
  double worst;
  vs_long_work work = { vs_bind_keep_going, vm };
  vs_plane_outcome outcome = vs_net_planarise(&net, vs_arg_real(f, 3), work, &worst);
  VS_ROOTS(vm, r, 2);
  switch (outcome) {
  case VS_PLANE_STOPPED: return VS_ERROR; /* vm->condition is already set */
  case VS_PLANE_MEMORY: return vs_fail_memory(vm);
  case VS_PLANE_FAR: {
    char text[32];
    vs_bind_number_text(text, worst);
    return vs_fail(vm, vm->sym.range,
                   "the faces cannot be made plane: after %d rounds a corner still lies %s from its face's plane",
                   VS_PLANE_ROUNDS, text);
  }
  case VS_PLANE_DONE: break;
  }
  return point_list(f, at, n, &r[0]) && vs_cons(vm, vs_flonum(worst), VS_NIL, &r[1]) &&
         vs_cons(vm, r[0], r[1], out);
}

/* (%shortest-path ways n from to): returns the indices, from 0, of the points on the path. ways is a flat list with
 * three numbers for each way between two points. */
vs_status vs_p_shortest_path(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  int64_t numbers = vs_list_length(vs_arg_value(f, 0));
  size_t count = numbers > 0 ? (size_t)numbers / 3 : 0, found;
  vs_way *ways = vs_bind_scratch(f, (count + 1) * sizeof *ways);
  if (!ways) return VS_ERROR;
  vs_value l = vs_arg_value(f, 0);
  double points = (double)vs_arg_integer(f, 1);
  for (size_t i = 0; i < count; i++) {
    double a = next(vm, &l), b = next(vm, &l), length = next(vm, &l);
    if (!(a >= 0 && a < points && b >= 0 && b < points))
      return vs_fail(vm, vm->sym.range, "a member ends at none of the points");
    ways[i] = (vs_way){ (uint32_t)a, (uint32_t)b, length };
  }
  uint32_t *at;
  vs_way_net net = { ways, count, (size_t)vs_arg_integer(f, 1) };
  if (!vs_ways_shortest(&net, (uint32_t)vs_arg_integer(f, 2), (uint32_t)vs_arg_integer(f, 3), &at, &found))
    return vs_fail_memory(vm);
  VS_ROOTS(vm, r, 1);
  bool ok = true;
  r[0] = VS_NIL;
  while (ok && found-- > 0) ok = vs_cons(vm, vs_fix((int64_t)at[found]), r[0], &r[0]);
  free(at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* The region or closed curve of an argument, in its plane. If all bytes are zero, the area is empty. */
typedef struct {
  vs_outline outline; /* its loops in space, with the frame of their plane */
  vs_affine back;     /* the map from space to the frame of the plane */
  vs_area whole;      /* its area in the coordinates of the plane */
} flat_region;

static void flat_region_free(flat_region *r) {
  vs_area_free(&r->whole);
  vs_outline_free(&r->outline);
}

/* Samples the region or closed curve of argument i, and maps it to its plane. The fineness is the one that the program
 * has set, otherwise `finer` times that of drawings. If it fails, sets the error; *out then needs no freeing. */
static bool flatten(vs_args *f, int i, double finer, flat_region *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_error e = { 0 };
  vs_bounds b;
  vs_node *region = vs_arg_ref(f, i).node;
  *out = (flat_region){ .outline = { 0 } };
  if (region->class_ == VS_CURVE && !(region->flags & VS_NODE_CLOSED))
    return vs_bind_refuse(f, "region", "a region or a closed curve", vs_arg_value(f, i));
  if (!vs_bind_uncrossed(f, vs_arg_ref(f, i), "region")) return false;
  if (!vs_node_bounds(region, &b, &e)) return vs_bind_error(vm, &e);
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_fineness_tolerance(&b) / finer, 1e-300);
  if (!vs_region_outline(region, &facets, &out->outline, &e)) return vs_bind_error(vm, &e);
  const vs_affine *frame = &out->outline.frame;
  if (vs_affine_invert(frame, &out->back) && vs_area_of_outline(&out->outline, frame, &out->whole)) return true;
  flat_region_free(out);
  return vs_fail_memory(vm);
}

/* (%pack-circles region n least gap): returns a list of pairs (centre . radius), beginning with the largest circle. */
vs_status vs_p_pack_circles(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  flat_region g;
  size_t n = (size_t)vs_arg_integer(f, 1), count = 0;
  if (!flatten(f, 0, 4, &g)) return VS_ERROR;
  vs_packed *circles = vs_bind_scratch(f, (n + 1) * sizeof *circles);
  bool stopped = false, ok = circles != NULL;
  vs_packing_rule rule = { n, vs_arg_real(f, 2), vs_arg_real(f, 3) };
  vs_long_work work = { vs_bind_keep_going, vm };
  if (ok && !vs_area_pack(&g.whole, &rule, work, circles, &count, &stopped))
    ok = stopped ? VS_ERROR : vs_fail_memory(vm);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;)
    ok = vs_bind_give_point(f, vs_affine_point(&g.outline.frame, vs_v3(circles[i].at.x, circles[i].at.y, 0)), &r[1]) &&
         vs_cons(vm, r[1], vs_flonum(circles[i].radius), &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  flat_region_free(&g);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- triangulations and Voronoi cells ---- */

static vs_vec2 *flat_points(vs_args *f, const vs_affine *to_plane) {
  size_t n = vs_arg_points(f, 0).count;
  vs_vec2 *flat = vs_bind_scratch(f, (n + 1) * sizeof *flat);
  for (size_t i = 0; flat && i < n; i++) {
    vs_vec3 p = vs_affine_point(to_plane, vs_arg_points(f, 0).at[i]);
    flat[i] = (vs_vec2){ p.x, p.y };
  }
  return flat;
}

/* (delaunay points): returns the triangles of the Delaunay triangulation as lists of three points, counterclockwise as
 * seen from above. */
vs_status vs_p_delaunay(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count, count;
  vs_affine identity = vs_affine_identity();
  uint32_t(*triangles)[3];
  vs_error e = { 0 };
  VS_ROOTS(vm, r, 3);
  if (n < 3) return vs_bind_refuse(f, "points", "three points or more", vs_arg_value(f, 0));
  vs_vec2 *flat = flat_points(f, &identity);
  if (!flat) return VS_ERROR;
  if (!vs_points_delaunay(flat, n, &triangles, &count, &e)) return vs_bind_error(vm, &e);
  bool ok = true;
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;) {
    r[1] = VS_NIL;
    for (int k = 2; ok && k >= 0; k--)
      ok = vs_bind_give_point(f, vs_arg_points(f, 0).at[triangles[i][k]], &r[2]) && vs_cons(vm, r[2], r[1], &r[1]);
    ok = ok && vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, 16);
  }
  free(triangles);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* Returns a region node, bounded by polylines, for an area of the plane with this frame. Returns NULL when memory is
 * out. */
static vs_node *region_of(vs_args *f, const vs_area *a, const vs_affine *frame) {
  vs_store *s = vs_call_store(f);
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

/* (voronoi points region): returns a list with the Voronoi cell of each point as a region, in the order of the points.
 * A cell outside of the given region is empty. */
vs_status vs_p_voronoi(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count;
  vs_error e = { 0 };
  flat_region g;
  if (!n) return vs_bind_refuse(f, "points", "one point or more", vs_arg_value(f, 0));
  if (!flatten(f, 1, 16, &g)) return VS_ERROR;
  vs_vec2 box[2] = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
  for (size_t i = 0; i < g.whole.count; i++) {
    box[0].x = fmin(box[0].x, g.whole.at[i].x), box[0].y = fmin(box[0].y, g.whole.at[i].y);
    box[1].x = fmax(box[1].x, g.whole.at[i].x), box[1].y = fmax(box[1].y, g.whole.at[i].y);
  }
  double grow = g.whole.count ? .01 * hypot(box[1].x - box[0].x, box[1].y - box[0].y) : 0;
  box[0].x -= grow, box[0].y -= grow, box[1].x += grow, box[1].y += grow;
  vs_vec2 *flat = flat_points(f, &g.back);
  vs_voronoi cells = { 0 };
  bool ok = flat && (vs_voronoi_make(flat, n, box, &cells, &e) || vs_bind_error(vm, &e));
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = n; ok && i-- > 0;) {
    vs_area pair[2] = { { 0 }, { 0 } }, met = { 0 };
    for (size_t k = cells.start[i]; ok && k < cells.start[i + 1]; k++)
      ok = vs_area_point(&pair[0], cells.at[k].x, cells.at[k].y) || vs_fail_memory(vm);
    ok = ok && (vs_area_loop(&pair[0], false) || vs_fail_memory(vm));
    pair[1] = g.whole;
    if (ok && pair[0].loop_count && g.whole.loop_count)
      ok = vs_area_combine(VS_AREA_INTERSECTION, pair, 2, "Voronoi cells", &met, &e) || vs_bind_error(vm, &e);
    ok = ok && vs_bind_give_node(f, region_of(f, &met, &g.outline.frame), &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) &&
         vs_poll(vm, 256);
    vs_area_free(&pair[0]), vs_area_free(&met);
  }
  vs_voronoi_free(&cells);
  flat_region_free(&g);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- straight skeletons ---- */

/* If the outcome is a failure, sets the error and returns false. where: the two edges of the outline that caused the
 * failure. */
static bool no_skeleton(vs_args *f, vs_skeleton_outcome outcome, const vs_vec2 *at, const size_t where[2]) {
  vs_scheme *vm = vs_call_vm(f);
  char n[4][32];
  switch (outcome) {
  case VS_SKELETON_STOPPED: return false; /* vm->condition is already set */
  case VS_SKELETON_MEMORY: return vs_fail_memory(vm);
  case VS_SKELETON_CROSSES:
    for (int i = 0; i < 2; i++)
      vs_bind_number_text(n[2 * i], at[where[i]].x), vs_bind_number_text(n[2 * i + 1], at[where[i]].y);
    vs_fail(vm, vm->sym.range,
            "the outline crosses or touches itself: see the edges that begin at (xy %s %s) and (xy %s %s)", n[0], n[1],
            n[2], n[3]);
    return false;
  case VS_SKELETON_OPEN:
    vs_fail(vm, vm->sym.range, "the edges never meet: more edges must move inwards");
    return false;
  case VS_SKELETON_RING:
    vs_fail(vm, vm->sym.range, "the face of one edge would enclose others: make the speeds more equal");
    return false;
  case VS_SKELETON_FAILED:
    vs_fail(vm, vm->sym.range, "the outline has details too fine to compute");
    return false;
  case VS_SKELETON_DONE: break;
  }
  return true;
}

/* (%straight-skeleton points speeds sizes): returns a list for each face of the straight skeleton: the number of its
 * edge from 1, or 0, then its points. The z of a point is the time at which the moving edges reach it. */
vs_status vs_p_straight_skeleton(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  size_t n = vs_arg_points(f, 0).count, loops = 0, where[2] = { 0, 0 };
  int64_t most = vs_list_length(vs_arg_value(f, 2));
  double *speed = vs_bind_scratch(f, (n + 1) * sizeof *speed);
  size_t *size = vs_bind_scratch(f, ((size_t)(most > 0 ? most : 0) + 1) * sizeof *size);
  vs_vec2 *at = vs_bind_scratch(f, (n + 1) * sizeof *at);
  if (!speed || !size || !at) return VS_ERROR;
  vs_value l = vs_arg_value(f, 1);
  for (size_t i = 0; i < n; i++) {
    at[i] = (vs_vec2){ vs_arg_points(f, 0).at[i].x, vs_arg_points(f, 0).at[i].y };
    speed[i] = next(vm, &l);
  }
  for (l = vs_arg_value(f, 2); vs_is_pair(l);) size[loops++] = (size_t)next(vm, &l);
  vs_skeleton k;
  vs_long_work work = { vs_bind_keep_going, vm };
  vs_skeleton_outcome outcome = vs_skeleton_make(&(vs_skeleton_outline){ at, speed, size, loops }, work, &k, where);
  if (outcome != VS_SKELETON_DONE) return no_skeleton(f, outcome, at, where), VS_ERROR;
  VS_ROOTS(vm, r, 3);
  r[0] = VS_NIL;
  bool ok = true;
  for (size_t i = k.face_count; ok && i-- > 0;) {
    const vs_skeleton_face *face = &k.face[i];
    r[1] = VS_NIL;
    for (size_t c = face->count; ok && c-- > 0;)
      ok = vs_bind_give_point(f, k.at[k.corner[face->first + c]], &r[2]) && vs_cons(vm, r[2], r[1], &r[1]);
    vs_value edge = vs_fix(face->edge == VS_SKELETON_STEP ? 0 : (int64_t)face->edge + 1);
    ok = ok && vs_cons(vm, edge, r[1], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, 16);
  }
  vs_skeleton_free(&k);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
