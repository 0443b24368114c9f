/* Owns the triangles of one primitive as a good solid. */
#include "kernel/primitive.h"

#include "kernel/inspect.h"

/* Kinds whose meshes may overlap themselves; placements are looked through. */
static bool may_overlap(const vs_node *n) {
  if (n->class_ != VS_SOLID) return false;
  while (n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER) n = n->children[0].node;
  if (n->kind == VS_EXTRUDE) return VS_AS(extrude, n)->taper != 0 || n->child_count > 1;
  return n->kind == VS_SWEEP || n->kind == VS_THICKEN || n->kind == VS_LOFT || n->kind == VS_RULED_LOFT || n->kind == VS_GUIDED_LOFT ||
         n->kind == VS_GRID_MESH || n->kind == VS_GRID_SURFACE;
}

static bool failed(const vs_kernel_error *why, vs_error *e) {
  switch (why->status) {
  case VS_KERNEL_OUT_OF_MEMORY: return vs_error_memory(e, NULL);
  case VS_KERNEL_INTERRUPTED: return vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
  case VS_KERNEL_FINE: case VS_KERNEL_OPEN: case VS_KERNEL_INSIDE_OUT: case VS_KERNEL_NOT_FINITE: case VS_KERNEL_LIMIT: case VS_KERNEL_INTERNAL: break;
  }
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s", why->message);
}

bool vs_primitive_mesh(const vs_node *n, const vs_facets *f, const vs_kernel_options *options, vs_mesh *out, vs_error *e) {
  vs_mesh_flaws flaws;
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  vs_mesh whole = { 0 };
  if (!vs_tessellate(n, f, out, e)) return false;
  if (!may_overlap(n) || !out->triangle_count) return true;
  if (!vs_kernel_inspect(out, options, &flaws, &why)) return failed(&why, e);
  if (flaws.wound_count == 0) return true;
  if (!vs_kernel_resolve(out, 0, options, &whole, &why)) return failed(&why, e);
  vs_mesh_free(out);
  *out = whole;
  return true;
}
