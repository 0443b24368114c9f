/* Owns what natives share that take objects apart (taken_apart.h). */
#include "bind/shapes/taken_apart.h"

#include "geometry/measure/node_measures.h"
#include "solids/deformed.h"
#include "solids/resolve.h"

vs_facets vs_bend_facets(vs_bind *b, const vs_node *n) {
  vs_bounds bounds;
  vs_error e = { 0 };
  vs_facets facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  if (facets.tolerance <= 0 && vs_node_bounds(n, &bounds, &e)) facets.tolerance = vs_facets_tolerance(&bounds);
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
  vs_facets facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
  return ended(b, vs_resolve(ref, 1, &facets, &options, &e), &e);
}

bool vs_bend_take_apart(vs_bind *b, vs_ref object, const char *no_regions, vs_bend_leaves *out) {
  vs_error e = { 0 };
  vs_facets facets = { .tolerance = vs_bind_tolerance(b), .segments = vs_bind_segments(b) };
  vs_kernel_options options = { .progress = vs_bind_keep_going, .context = b->vm };
  vs_node_retain(object.node);
  *out = (vs_bend_leaves){ 0 };
  bool ok = vs_bend_resolve(b, &object);
  ok = ok && ended(b, vs_take_apart(object, &facets, &options, no_regions, out, &e), &e);
  vs_node_release(object.node);
  return ok;
}
