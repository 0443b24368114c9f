/* Implements the natives for intersections and nearest points: curve-intersections, the probes of probes.scm, and the
 * distance from a solid as a field. */

#include <math.h>
#include <stdlib.h>

#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/functions/function_values.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/queries.h"
#include "bind/shapes/along_curves.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/measure/mesh_distance.h"
#include "geometry/measure/ray_tree.h"
#include "geometry/nets/geodesic.h"
#include "geometry/nets/offset_curve.h"
#include "geometry/plane/meetings.h"
#include "model/store/array.h"
#include "solids/solid_meshes.h"

/* ---- intersections of curves ---- */

/* (curve-intersections a b): returns the common points of two curves, in order along a. */
vs_status vs_p_curve_intersections(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_stations a, b;
  vs_meeting *found = NULL;
  size_t count = 0;
  vs_vec3 at;
  VS_ROOTS(vm, r, 2);
  if (!vs_bind_stations(f, 0, &a)) return VS_ERROR;
  if (!vs_bind_stations(f, 1, &b)) return vs_stations_close(&a), VS_ERROR;
  double near = 1e-7 * fmax(a.length, b.length);
  vs_meetings_outcome outcome = vs_curves_meet(&a, &b, near, &found, &count, &at);
  vs_stations_close(&a), vs_stations_close(&b);
  if (outcome == VS_MEETINGS_MEMORY) return vs_fail_memory(vm);
  if (outcome == VS_MEETINGS_ALONG) {
    char x[32], y[32], z[32];
    vs_bind_number_text(x, at.x), vs_bind_number_text(y, at.y), vs_bind_number_text(z, at.z);
    return vs_fail(vm, vm->sym.range, "the curves lie on each other about (xyz %s %s %s)", x, y, z);
  }
  bool ok = true;
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;)
    ok = vs_bind_give_point(f, found[i].at, &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  free(found);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- probes: meshes that are made once and used for many tests ---- */

typedef struct {
  vs_mesh mesh;
  vs_ray_tree tree;
  vs_mesh_distance *distance;
  double size;
} probe;

static void probe_free(void *p) {
  probe *w = p;
  if (!w) return;
  vs_ray_tree_free(&w->tree);
  vs_mesh_distance_free(w->distance);
  vs_mesh_free(&w->mesh);
  free(w);
}
static const vs_foreign_type probe_type = { .name = "an object's triangles", .release = probe_free };

/* (%probe o): returns a probe, the mesh of the solid or surface o. */
vs_status vs_p_probe(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  probe *w = NULL;
  size_t room = 0;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_node *o = vs_arg_ref(f, 0).node;
  if (vs_node_is_empty(o) || (o->class_ != VS_SOLID && o->class_ != VS_SURFACE))
    return vs_bind_refuse(f, "o", "a solid or a surface", vs_arg_value(f, 0));
  if (!VS_GROW(w, room, 1)) return vs_fail_memory(vm);
  *w = (probe){ 0 };
  if (!vs_bend_triangles(vm, vs_arg_ref(f, 0), &w->mesh)) return probe_free(w), VS_ERROR;
  vs_bounds b = vs_mesh_bounds(&w->mesh);
  w->size = vs_bounds_diagonal(&b);
  w->distance = vs_mesh_distance_new(&w->mesh);
  if (!w->distance) return probe_free(w), vs_fail_memory(vm);
  if (!vs_ray_tree_make(&w->tree, vs_call_store(f), &w->mesh, &e)) return probe_free(w), vs_bind_error(vm, &e);
  return vs_make_foreign(vm, &probe_type, w, 0, out);
}

/* (%probe-near probe p): returns the point nearest to p on the probe's triangles. */
vs_status vs_p_probe_near(vs_args *f, vs_value *out) {
  const probe *w = vs_foreign_get(vs_arg_value(f, 0), &probe_type);
  vs_vec3 p = vs_arg_point(f, 1), slope = { 0, 0, 0 };
  double d = vs_mesh_distance_at(w->distance, p, &slope);
  return vs_bind_give_point(f, vs_v3_sub(p, vs_v3_scale(slope, d)), out);
}

/* (%probe-ray probe p v): returns the first intersection of the ray from p along v with the probe's triangles, or
 * #f. */
vs_status vs_p_probe_ray(vs_args *f, vs_value *out) {
  const probe *w = vs_foreign_get(vs_arg_value(f, 0), &probe_type);
  vs_vec3 p = vs_arg_point(f, 1), v = vs_v3_unit(vs_arg_point(f, 2));
  double at;
  *out = VS_FALSE;
  if (vs_ray_tree_meet(&w->tree, p, v, INFINITY, false, &at) == w->mesh.triangle_count) return VS_OK;
  return vs_bind_give_point(f, vs_v3_add(p, vs_v3_scale(v, at)), out);
}

/* Returns the signed distance of p from the plane of triangle t. */
static double above(const probe *w, size_t t, vs_vec3 p) {
  const uint32_t *k = w->mesh.triangles[t];
  vs_vec3 a = w->mesh.vertices[k[0]], b = w->mesh.vertices[k[1]], c = w->mesh.vertices[k[2]];
  return vs_v3_dot(vs_v3_unit(vs_v3_cross(vs_v3_sub(b, a), vs_v3_sub(c, a))), vs_v3_sub(p, a));
}

/* Returns the distance along the curve, between low and high, at which it intersects the plane of triangle t. */
static double passes(const probe *w, const vs_stations *c, size_t t, double low, double high) {
  bool below = above(w, t, vs_station_at(c, low).at) < 0;
  for (int i = 0; i < 60; i++) {
    double middle = .5 * (low + high);
    if ((above(w, t, vs_station_at(c, middle).at) < 0) == below)
      low = middle;
    else
      high = middle;
  }
  return .5 * (low + high);
}

/* (%probe-curve probe c): returns the intersections of the curve with the probe's triangles, in order along the
 * curve. */
vs_status vs_p_probe_curve(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const probe *w = vs_foreign_get(vs_arg_value(f, 0), &probe_type);
  vs_stations c;
  double *found = NULL;
  size_t count = 0, room = 0;
  if (!vs_bind_stations(f, 1, &c)) return VS_ERROR;
  double blur = 1e-7 * fmax(c.length, w->size);
  bool ok = true;
  size_t n = c.path.count - (c.path.closed ? 0 : 1);
  for (size_t i = 0; ok && i < n; i++) {
    double low = c.along[i], high = c.along[i + 1], begin = 0;
    vs_vec3 p = c.path.at[i].at, q = c.path.at[i + 1 < c.path.count ? i + 1 : 0].at, way = vs_v3_sub(q, p);
    while (ok && begin <= 1) {
      double at;
      size_t t = vs_ray_tree_meet(&w->tree, vs_v3_add(p, vs_v3_scale(way, begin)), way, 1 - begin, false, &at);
      if (t == w->mesh.triangle_count) break;
      double share = fmin(1, begin + at), s = low + share * (high - low);
      bool through = (above(w, t, p) < 0) != (above(w, t, q) < 0);
      if (through) s = passes(w, &c, t, low, high);
      bool known = false;
      for (size_t k = count; k-- > 0 && !known;) known = fabs(found[k] - s) <= blur;
      if (!known && count && c.path.closed && c.length - fabs(found[0] - s) <= blur) known = true;
      if (!known) ok = VS_GROW(found, room, count + 1) || vs_fail_memory(vm);
      if (!known && ok) found[count++] = s;
      begin = share + 1e-9 + blur / fmax(high - low, blur);
    }
    ok = ok && vs_poll(vm, 16);
  }
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;)
    ok = vs_bind_give_point(f, vs_station_at(&c, found[i]).at, &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  free(found);
  vs_stations_close(&c);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* (%curve-near c p): returns the distance along the curve c, from its start, of the point of c that is nearest to p. */
vs_status vs_p_curve_near(vs_args *f, vs_value *out) {
  vs_stations c;
  vs_vec3 p = vs_arg_point(f, 1);
  if (!vs_bind_stations(f, 0, &c)) return VS_ERROR;
  double best = INFINITY, at = 0;
  size_t n = c.path.count - (c.path.closed ? 0 : 1);
  for (size_t i = 0; i < n; i++) { /* in each span, finds the minimum of the distance as the zero of its derivative; the
                                    * search starts in the middle */
    double low = c.along[i], high = c.along[i + 1], s = .5 * (low + high);
    vs_vec3 a = c.path.at[i].at;
    if (vs_v3_length(vs_v3_sub(a, p)) > best + 1.6 * (high - low)) continue;
    for (int k = 0; k < 40; k++) {
      vs_station q = vs_station_at(&c, s);
      double step = vs_v3_dot(vs_v3_sub(p, q.at), q.tangent), next = fmin(high, fmax(low, s + step));
      bool still = fabs(next - s) <= 1e-14 * c.length;
      s = next;
      if (still) break;
    }
    double d = vs_v3_length(vs_v3_sub(vs_station_at(&c, s).at, p));
    if (d < best) best = d, at = s;
  }
  vs_stations_close(&c);
  return vs_bind_give_real(f, at, out);
}

/* (%probe-geodesic probe p q): returns the points of the shortest path from p to q on the probe's triangles, or the
 * empty list if there is none. */
vs_status vs_p_probe_geodesic(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const probe *w = vs_foreign_get(vs_arg_value(f, 0), &probe_type);
  vs_vec3 *at;
  size_t count;
  VS_ROOTS(vm, r, 2);
  if (!vs_mesh_geodesic(&w->mesh, vs_arg_point(f, 1), vs_arg_point(f, 2), &at, &count)) return vs_fail_memory(vm);
  bool ok = true;
  r[0] = VS_NIL;
  for (size_t i = count; ok && i-- > 0;) ok = vs_bind_give_point(f, at[i], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  free(at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

typedef struct {
  vs_scheme *vm;
  bool stopped;
} polling;

static bool polled(void *context) {
  polling *p = context;
  p->stopped = !vs_poll(p->vm, 64);
  return !p->stopped;
}

/* (%probe-offset probe c d n): returns the curves on the probe's triangles at distance d from the curve c, each as a
 * list of points. */
vs_status vs_p_probe_offset(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const probe *w = vs_foreign_get(vs_arg_value(f, 0), &probe_type);
  vs_stations c;
  vs_mesh_edges edges = { 0 };
  vs_offset_from *from = NULL;
  vs_offset_points found = { 0 };
  size_t room = 0, n = (size_t)vs_arg_integer(f, 3);
  VS_ROOTS(vm, r, 3);
  if (!vs_bind_stations(f, 1, &c)) return VS_ERROR;
  bool closed = c.path.closed, ok = VS_GROW(from, room, n + 1) && vs_mesh_edges_make(&edges, &w->mesh);
  if (!ok) vs_fail_memory(vm);
  for (size_t i = 0; ok && i < n + !closed; i++) {
    vs_station at = vs_station_at(&c, c.length * (double)i / (double)n);
    from[i] = (vs_offset_from){ at.at, at.tangent };
  }
  vs_stations_close(&c);
  if (ok) {
    polling p = { vm, false };
    vs_offset_row along = { from, n + !closed, closed };
    ok = vs_mesh_offset_curve(&edges, &along, vs_arg_real(f, 2), (vs_poller){ polled, &p }, &found);
    if (!ok && !p.stopped) vs_fail_memory(vm);
  }
  vs_mesh_edges_free(&edges);
  r[0] = r[1] = VS_NIL;
  for (size_t i = found.count; ok && i-- > 0;) {
    ok = vs_bind_give_point(f, found.at[i].at, &r[2]) && vs_cons(vm, r[2], r[1], &r[1]);
    if (ok && found.at[i].first) ok = vs_cons(vm, r[1], r[0], &r[0]), r[1] = VS_NIL;
  }
  free(from), free(found.at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* ---- the distance from a solid, as a field for tapes (compiled expressions) ---- */

typedef struct {
  vs_tape_field field;
  vs_mesh_distance *mesh;
} distance_field;

static double value(const vs_tape_field *f, const double at[3], double slope[3]) {
  vs_vec3 by = { 0, 0, 0 };
  double d = vs_mesh_distance_at(((const distance_field *)(const void *)f)->mesh, vs_v3(at[0], at[1], at[2]), &by);
  if (slope) slope[0] = by.x, slope[1] = by.y, slope[2] = by.z;
  return d;
}

static void release(vs_tape_field *f) {
  distance_field *d = (distance_field *)(void *)f;
  vs_mesh_distance_free(d->mesh);
  free(d);
}

/* (%distance-field o): returns a field whose value at a point is its distance from the solid o. Uses a mesh with a
 * quarter of the usual tolerance. */
vs_status vs_p_distance_field(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  distance_field *d = NULL;
  size_t room = 0;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_ref ref = vs_arg_ref(f, 0);
  if (ref.node->class_ != VS_SOLID) return vs_bind_refuse(f, "o", "a solid", vs_arg_value(f, 0));
  vs_fineness facets = vs_bend_facets(vm, ref.node);
  facets.tolerance /= 4;
  vs_solid solid = { 0 };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e))
    return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(vm, &e);
  bool ok = VS_GROW(d, room, 1);
  if (ok) *d = (distance_field){ { 1, value, release }, vs_mesh_distance_new(&solid.mesh) };
  vs_solid_free(&solid);
  if (!ok) return vs_fail_memory(vm);
  if (!d->mesh) return free(d), vs_fail_memory(vm);
  return vs_make_foreign(vm, &vs_tape_field_type, &d->field, 0, out);
}

/* (%field-value field x y z): returns the value of the field at a point. */
vs_status vs_p_field_value(vs_args *f, vs_value *out) {
  const vs_tape_field *field = vs_foreign_get(vs_arg_value(f, 0), &vs_tape_field_type);
  return vs_bind_give_real(
      f, field->value(field, (const double[]){ vs_arg_real(f, 1), vs_arg_real(f, 2), vs_arg_real(f, 3) }, NULL), out);
}
