/* Implements taken_apart.h, by which natives divide objects into parts. */
#include "bind/call/context.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/tessellate.h"

#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "solids/deformed.h"
#include "solids/overlaps.h"
#include "solids/resolve.h"
#include "solids/solid_meshes.h"

vs_fineness vs_bend_facets(vs_scheme *vm, const vs_node *n) {
  vs_bounds bounds;
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  if (facets.tolerance <= 0 && vs_node_bounds(n, &bounds, &e)) facets.tolerance = vs_fineness_tolerance(&bounds);
  if (!(facets.tolerance > 0)) facets.tolerance = 1;
  return facets;
}

static bool ended(vs_scheme *vm, bool ok, const vs_error *e) {
  if (ok || e->kind == VS_ERROR_INTERRUPT) return ok;
  if (e->kind == VS_ERROR_MEMORY) return vs_fail_memory(vm);
  return vs_fail(vm, vm->sym.error, "%s", e->message);
}

bool vs_bend_resolve(vs_scheme *vm, vs_ref *ref) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  return ended(vm, vs_resolve(ref, 1, &facets, &options, &e), &e);
}

bool vs_bend_take_apart(vs_scheme *vm, vs_ref object, const char *no_regions, vs_bend_leaves *out) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  vs_node_retain(object.node);
  *out = (vs_bend_leaves){ 0 };
  bool ok = vs_bend_resolve(vm, &object);
  ok = ok && ended(vm, vs_take_apart(object, &facets, &options, no_regions, out, &e), &e);
  vs_node_release(object.node);
  return ok;
}

bool vs_bend_solid(vs_scheme *vm, vs_mesh *m) {
  vs_error e = { 0 };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  return ended(vm, vs_mesh_without_overlaps(m, &options, &e), &e);
}

vs_status vs_bend_triangles(vs_scheme *vm, vs_ref ref, vs_mesh *out) {
  vs_error e = { 0 };
  vs_bounds b;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(vm), .segments = vs_bind_segments(vm) };
  if (!vs_node_bounds(ref.node, &b, &e)) return vs_bind_error(vm, &e);
  if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_fineness_tolerance(&b) / 4, 1e-300);
  if (ref.node->class_ == VS_SOLID) {
    vs_solid solid = { 0 };
    vs_kernel_options options = { .job = vs_bind_job(vm) };
    if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e))
      return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(vm, &e);
    *out = solid.mesh;
    solid.mesh = (vs_mesh){ 0 };
    vs_solid_free(&solid);
    return VS_OK;
  }
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(ref, &parts, &count)) return vs_fail_memory(vm);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) ok = vs_tessellate(parts[i].node, &facets, out, &e);
  vs_several_free(parts, count);
  return ok ? VS_OK : vs_bind_error(vm, &e);
}
