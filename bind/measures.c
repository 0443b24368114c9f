/* Computes measures of objects: volume, area, length, centroid. Uses a formula if geometry/ has one for the object.
 * Otherwise uses the mesh that back-ends write for the solid. */
#include "bind/measures.h"

#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/constructors/operations.h"
#include "bind/queries.h"
#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "geometry/tessellate.h"
#include "model/store/cache.h"
#include "solids/drawn_bounds.h"
#include "solids/resolve.h"
#include "solids/solid_measures.h"


bool vs_bind_keep_going(void *vm, double done) {
  (void)done;
  return vs_poll(vm, UINT64_C(1) << 20); /* returns false, with the error set, on an interrupt */
}

vs_status vs_bind_resolve(vs_args *f, int i) {
  vs_error e = { 0 };
  vs_bounds b;
  vs_ref *ref = &f->arg[i].ref, made = *ref;
  if (!(ref->node->flags & VS_NODE_UNRESOLVED)) return VS_OK;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->vm) };
  if (facets.tolerance <= 0 && vs_node_bounds(ref->node, &b, &e) && vs_bounds_diagonal(&b) > 0)
    facets.tolerance = vs_fineness_tolerance(&b) / 16;
  vs_kernel_options options = { .job = vs_bind_job(f->vm) };
  vs_node_retain(made.node);
  e = (vs_error){ 0 };
  bool ok = vs_resolve(&made, 1, &facets, &options, &e);
  if (!vs_bind_keep(f, made.node)) return VS_ERROR;
  if (!ok) return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f->vm, &e);
  *ref = made;
  return VS_OK;
}

bool vs_bind_bounds(vs_scheme *vm, vs_ref ref, vs_bounds *out, vs_error *e) {
  if (vs_node_bounds(ref.node, out, e)) return true;
  if (e->kind == VS_ERROR_MEMORY || !(ref.node->flags & VS_NODE_UNRESOLVED)) return false;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm) };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  *e = (vs_error){ 0 };
  vs_node_retain(ref.node);
  bool ok = vs_resolve(&ref, 1, &facets, &options, e) && vs_node_bounds(ref.node, out, e);
  vs_node_release(ref.node);
  return ok;
}

bool vs_bind_drawn_bounds(vs_args *f, int i, vs_bounds *out) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->vm) };
  vs_kernel_options options = { .job = vs_bind_job(f->vm) };
  vs_drawn_search search = { .facets = &facets, .options = &options };
  if (vs_drawn_bounds(&f->arg[i].ref, &search, out, &e)) return true;
  if (e.kind != VS_ERROR_INTERRUPT) vs_bind_error(f->vm, &e);
  return false;
}

/* ---- measures that the cache keeps, so that the next evaluation of a program finds them ---- */

enum { SOLID_MEASURE /* the cached value SOLID_MEASURE + a is the measure of a solid for the vs_ask a */ };

static bool known(vs_args *f, uint64_t what, const vs_fineness *facets, void *out, size_t size) {
  vs_cache *cache = vs_store_cache(f->store);
  const uint64_t words[] = { what, vs_cache_real(facets->tolerance), (uint64_t)(int64_t)facets->segments };
  const vs_cached *held = vs_cache_find(cache, &(vs_cache_key){ VS_CACHED_MEASURE, f->arg[0].ref.node, words, 3, 0 });
  if (!held) return false;
  memcpy(out, held->data, size);
  vs_cache_let_go(cache, held);
  return true;
}

static void keep(vs_args *f, uint64_t what, const vs_fineness *facets, const void *at, size_t size) {
  vs_cache *cache = vs_store_cache(f->store);
  const uint64_t words[] = { what, vs_cache_real(facets->tolerance), (uint64_t)(int64_t)facets->segments };
  vs_cache_let_go(cache, vs_cache_keep(cache, &(vs_cache_key){ VS_CACHED_MEASURE, f->arg[0].ref.node, words, 3, 0 },
                                       &(vs_cache_piece){ at, size }, 1));
}

static vs_status measure_solid(vs_args *f, vs_measure *m, vs_ask ask) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->vm) };
  uint64_t what = SOLID_MEASURE + (uint64_t)ask;
  if (known(f, what, &facets, m, sizeof *m)) return VS_OK;
  vs_kernel_options options = { .job = vs_bind_job(f->vm) };
  if (!vs_solid_measure(f->arg[0].ref, ask, facets.tolerance, &options, m, &e))
    return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f->vm, &e);
  keep(f, what, &facets, m, sizeof *m);
  return VS_OK;
}

/* Measures the area of one or several surfaces, and the centroid of this area, by a fine mesh. */
static vs_status measure_surface(vs_args *f, vs_measure *m) {
  vs_error e = { 0 };
  vs_bounds b;
  vs_mesh mesh = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->vm) };
  vs_vec3 sum = { 0, 0, 0 };
  if (!vs_node_bounds(f->arg[0].ref.node, &b, &e)) return vs_bind_error(f->vm, &e);
  if (facets.tolerance <= 0) facets.tolerance = fmax(vs_bounds_diagonal(&b) / 65536, 1e-300);
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(f->arg[0].ref, &parts, &count)) return vs_bind_give_node(f, NULL, &(vs_value){ 0 });
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) ok = vs_tessellate(parts[i].node, &facets, &mesh, &e);
  vs_several_free(parts, count);
  if (!ok) return vs_mesh_free(&mesh), vs_bind_error(f->vm, &e);
  for (size_t i = 0; i < mesh.triangle_count; i++) {
    vs_vec3 p = mesh.vertices[mesh.triangles[i][0]], q = mesh.vertices[mesh.triangles[i][1]],
            r = mesh.vertices[mesh.triangles[i][2]];
    double w = vs_v3_length(vs_v3_cross(vs_v3_sub(q, p), vs_v3_sub(r, p))) / 2;
    m->area += w;
    sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(vs_v3_add(p, q), r), w / 3));
  }
  m->centroid = m->area > 0 ? vs_v3_scale(sum, 1 / m->area) : b.min;
  m->known = m->area_known = true;
  vs_mesh_free(&mesh);
  return VS_OK;
}

static vs_status measure_any(vs_args *f, vs_measure *m, vs_ask ask) {
  vs_error e = { 0 };
  const vs_node *n = f->arg[0].ref.node;
  *m = (vs_measure){ 0 };
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (!vs_node_measure(n, m, &e)) return vs_bind_error(f->vm, &e);
  if (m->known && (ask != VS_ASK_AREA || m->area_known)) return VS_OK;
  if (n->class_ == VS_SOLID) return measure_solid(f, m, ask);
  bool placed = n->kind == VS_TRANSFORM || vs_node_is_wrapper(n) || n->kind == VS_UNION;
  if (n->class_ == VS_SURFACE && (placed || vs_kind_get((vs_kind)n->kind)->level != VS_LEVEL_OPERATION))
    return measure_surface(f, m);
  const char *kind = vs_kind_get((vs_kind)n->kind)->name;
  return vs_fail(f->vm, f->vm->sym.error, "there is no measure yet of %s %s that is no solid",
                 strchr("aeiou", *kind) ? "an" : "a", kind);
}

static vs_status measure(vs_args *f, vs_measure *m, vs_ask ask) {
  if (!measure_any(f, m, ask)) return VS_ERROR;
  vs_vec3 c = m->centroid;
  if (isfinite(m->volume) && isfinite(ask == VS_ASK_AREA ? m->area : 0) && isfinite(m->length) && isfinite(c.x) &&
      isfinite(c.y) && isfinite(c.z))
    return VS_OK;
  return vs_bind_refuse(f, "o", "smaller: its size overflows the largest number", f->arg[0].value);
}

vs_status vs_p_volume(vs_args *f, vs_value *out) {
  vs_measure m;
  vs_class c = (vs_class)f->arg[0].ref.node->class_;
  if (c == VS_CURVE || c == VS_REGION_CLASS || c == VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid", f->arg[0].value);
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  c = (vs_class)f->arg[0].ref.node->class_;
  if (c == VS_NOTHING) return vs_bind_give_real(f, 0, out);
  if (c != VS_SOLID) return vs_bind_refuse(f, "o", "a solid", f->arg[0].value);
  return measure(f, &m, VS_ASK_VOLUME) && vs_bind_give_real(f, m.volume, out);
}

/* If argument 0 is a union of regions and curves, replaces it by the union of its regions, because curves have no area.
 * Does not change the argument if it has no regions, or has solids or surfaces. */
static vs_status regions_alone(vs_args *f) {
  vs_ref *parts;
  size_t count, kept = 0;
  bool flat = true;
  if (!vs_several_parts(f->arg[0].ref, &parts, &count)) return vs_fail_memory(f->vm);
  vs_ref *regions = vs_bind_scratch(f, (count + 1) * sizeof *regions);
  for (size_t i = 0; regions && i < count; i++) {
    vs_class c = (vs_class)parts[i].node->class_;
    if (c == VS_REGION_CLASS) regions[kept++] = parts[i];
    else if (c != VS_CURVE && c != VS_NOTHING) flat = false;
  }
  vs_status status = regions ? VS_OK : VS_ERROR;
  if (regions && flat && kept) {
    vs_node *all = kept == 1 ? vs_node_retain(regions[0].node) : vs_node_new(f->store, VS_UNION, NULL, regions, kept);
    if (vs_bind_keep(f, all)) f->arg[0].ref.node = all;
    else status = VS_ERROR;
  }
  vs_several_free(parts, count);
  return status;
}

vs_status vs_p_area(vs_args *f, vs_value *out) {
  vs_measure m;
  if (f->arg[0].ref.node->class_ != VS_CURVE && !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_class c = (vs_class)f->arg[0].ref.node->class_;
  if (c == VS_NOTHING) return vs_bind_give_real(f, 0, out);
  if (c == VS_CURVE && f->arg[0].ref.node->flags & VS_NODE_CLOSED) { /* a closed curve counts as the area that it
                                                                      * encloses */
    if (!vs_bind_uncrossed(f, f->arg[0].ref, "a closed curve that is taken as filled")) return VS_ERROR;
    vs_node *region = vs_node_new(f->store, VS_REGION, &(struct vs_region){ 0 }, &f->arg[0].ref, 1);
    if (!vs_bind_keep(f, region)) return VS_ERROR;
    f->arg[0].ref.node = region;
    c = VS_REGION_CLASS;
  }
  if (c != VS_SOLID && c != VS_REGION_CLASS && c != VS_SURFACE) {
    if (!regions_alone(f)) return VS_ERROR;
    c = (vs_class)f->arg[0].ref.node->class_;
  }
  if (c != VS_SOLID && c != VS_REGION_CLASS && c != VS_SURFACE)
    return vs_bind_refuse(f, "o", "a solid, a region, a surface or a closed curve", f->arg[0].value);
  return measure(f, &m, VS_ASK_AREA) && vs_bind_give_real(f, m.area, out);
}

vs_status vs_p_curve_length(vs_args *f, vs_value *out) {
  vs_measure m;
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  if (f->arg[0].ref.node->class_ == VS_NOTHING) return vs_bind_give_real(f, 0, out);
  return measure(f, &m, VS_ASK_VOLUME) && vs_bind_give_real(f, m.length, out);
}

vs_status vs_p_centroid(vs_args *f, vs_value *out) {
  vs_measure m;
  if (!vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_bounds b;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0)) return VS_ERROR;
  if (!vs_node_bounds(f->arg[0].ref.node, &b, &e)) return vs_bind_error(f->vm, &e);
  if (vs_node_is_empty(f->arg[0].ref.node) || vs_bounds_is_empty(&b))
    return vs_bind_refuse(f, "o", "more than nothing", f->arg[0].value);
  return measure(f, &m, VS_ASK_CENTROID) && vs_bind_give_point(f, m.centroid, out);
}

/* ---- the bounding box ---- */

vs_status vs_p_bounding_box(vs_args *f, vs_value *out) {
  vs_bounds b;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0) || !vs_bind_drawn_bounds(f, 0, &b)) return VS_ERROR;
  if (vs_bounds_is_empty(&b)) return *out = VS_FALSE, VS_OK;
  vs_vec3 size = vs_v3_sub(b.max, b.min);
  if (!isfinite(size.x) || !isfinite(size.y) || !isfinite(size.z))
    return vs_bind_refuse(f, "o", "smaller: its corners overflow the largest number", f->arg[0].value);
  VS_ROOTS(f->vm, r, 2);
  return vs_bind_give_point(f, b.max, &r[0]) && vs_cons(f->vm, r[0], VS_NIL, &r[1]) &&
         vs_bind_give_point(f, b.min, &r[0]) && vs_cons(f->vm, r[0], r[1], out);
}
