/* Owns what natives share that take objects apart (taken_apart.h). */
#include "bind/shapes/taken_apart.h"
#include "bind/call/refuse.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "geometry/tessellate.h"

#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "solids/deformed.h"
#include "solids/overlaps.h"
#include "solids/resolve.h"
#include "solids/solid_meshes.h"

vs_fineness vs_bend_facets(vs_bind *b, const vs_node *n) {
  vs_bounds bounds;
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  if (facets.tolerance <= 0 && vs_node_bounds(n, &bounds, &e)) facets.tolerance = vs_fineness_tolerance(&bounds);
  if (!(facets.tolerance > 0)) facets.tolerance = 1;
  return facets;
}

static bool ended(vs_bind *b, bool ok, const vs_error *e) {
  if (ok || e->kind == VS_ERROR_INTERRUPT) return ok;
  if (e->kind == VS_ERROR_MEMORY) return vs_fail_memory(b->vm);
  return vs_fail(b->vm, b->vm->sym.error, "%s", e->message);
}

bool vs_bend_resolve(vs_bind *b, vs_ref *ref) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
  return ended(b, vs_resolve(ref, 1, &facets, &options, &e), &e);
}

bool vs_bend_take_apart(vs_bind *b, vs_ref object, const char *no_regions, vs_bend_leaves *out) {
  vs_error e = { 0 };
  vs_fineness facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
  vs_node_retain(object.node);
  *out = (vs_bend_leaves){ 0 };
  bool ok = vs_bend_resolve(b, &object);
  ok = ok && ended(b, vs_take_apart(object, &facets, &options, no_regions, out, &e), &e);
  vs_node_release(object.node);
  return ok;
}

bool vs_bend_solid(vs_bind *b, vs_mesh *m) {
  vs_error e = { 0 };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
  return ended(b, vs_mesh_without_overlaps(m, &options, &e), &e);
}

vs_status vs_bend_triangles(vs_args *f, vs_ref ref, vs_mesh *out) {
  vs_error e = { 0 };
  vs_bounds b;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->bind), .segments = vs_bind_segments(f->bind) };
  if (!vs_node_bounds(ref.node, &b, &e)) return vs_bind_error(f, &e);
  if (!(facets.tolerance > 0)) facets.tolerance = fmax(vs_fineness_tolerance(&b) / 4, 1e-300);
  if (ref.node->class_ == VS_SOLID) {
    vs_solid solid = { 0 };
    vs_kernel_options options = { .progress = vs_bind_keep_going, .context = f->vm };
    if (!vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e))
      return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f, &e);
    *out = solid.mesh;
    solid.mesh = (vs_mesh){ 0 };
    vs_solid_free(&solid);
    return VS_OK;
  }
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(ref, &parts, &count)) return vs_fail_memory(f->vm);
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) ok = vs_tessellate(parts[i].node, &facets, out, &e);
  vs_several_free(parts, count);
  return ok ? VS_OK : vs_bind_error(f, &e);
}
