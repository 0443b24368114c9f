/* Implements simplify, refine and do-smooth, which change the facets of solids. */
#include <math.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/precision.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/origins.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "bind/warnings.h"
#include "geometry/shapes/decimation.h"
#include "geometry/shapes/smoothing.h"

/* Function that changes the mesh of one leaf (part) of an object. change_parts calls it for all parts of argument 0,
 * and returns the results as one object. */
typedef vs_status change_fn(vs_args *f, vs_bend_leaf *leaf);

static vs_status change_parts(vs_args *f, change_fn *change, vs_value *out) {
  vs_bend_leaves leaves;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  if (f->arg[0].ref.node->kind == VS_EMPTY) return vs_bind_give_node(f, vs_node_retain(f->arg[0].ref.node), out);
  if (!vs_bend_take_apart(f->vm, f->arg[0].ref, NULL, &leaves)) return VS_ERROR;
  vs_ref *refs = vs_bind_scratch(f, (leaves.count + 1) * sizeof *refs);
  bool ok = refs != NULL;
  size_t gone = 0;
  for (size_t i = 0; ok && i < leaves.count; i++) {
    vs_bend_leaf *l = &leaves.at[i];
    ok = change(f, l) && vs_bend_solid(f->vm, &l->mesh);
    if (ok && !l->mesh.triangle_count) gone++;
    refs[i] = (vs_ref){ ok ? vs_bend_node(f->store, l, &l->mesh) : NULL, vs_bind_origin(f->bind) };
    ok = ok && vs_bind_keep(f, refs[i].node);
  }
  if (ok && gone && gone < leaves.count)
    vs_bind_warn(f->bind, "simplify", "simplify: %zu part%s than the tolerance and vanish%s", gone,
                 gone > 1 ? "s of o are smaller" : " of o is smaller", gone > 1 ? "" : "es");
  if (ok && gone && gone == leaves.count) ok = vs_bind_empty(f, "the tolerance is larger than o", out);
  else if (ok && leaves.count == 1) ok = vs_bind_give_node(f, vs_node_retain(refs[0].node), out);
  else if (ok)
    ok = vs_bind_give_node(f, vs_node_new(f->store, VS_UNION, &(struct vs_union){ 0 }, refs, leaves.count), out);
  vs_bend_drop(&leaves);
  return ok ? VS_OK : VS_ERROR;
}

static vs_status make_simpler(vs_args *f, vs_bend_leaf *leaf) {
  if (vs_mesh_decimate(&leaf->mesh, f->arg[1].real, (vs_long_work){ vs_bind_keep_going, f->vm })) return VS_OK;
  return vs_poll(f->vm, 1) ? vs_fail_memory(f->vm) : VS_ERROR;
}

/* (simplify o tolerance): returns the solid with fewer facets. */
vs_status vs_p_simplify(vs_args *f, vs_value *out) { return change_parts(f, make_simpler, out); }

/* Halves edges of the leaf's facets until none is longer than the length in argument 1. */
static vs_status make_finer(vs_args *f, vs_bend_leaf *leaf) {
  enum { HALVINGS = 40, TRIANGLES_MOST = 2000000 };
  double length = f->arg[1].real, area = vs_mesh_area(&leaf->mesh);
  size_t n;
  const vs_vec3 *wanted;
  if (area / (length * length) > TRIANGLES_MOST)
    return vs_fail(f->vm, f->vm->sym.range, "the solid would have millions of facets; give a larger length");
  vs_bending *b = vs_bending_new(leaf, INFINITY, length, HALVINGS);
  bool ok = b != NULL;
  while (ok && (wanted = vs_bending_wanted(b, &n), n) && (ok = vs_poll(f->vm, (uint32_t)(n / 8 + 1))))
    ok = vs_bending_give(b, wanted);
  if (ok) {
    vs_mesh *m = vs_bending_mesh(b), swap = leaf->mesh;
    leaf->mesh = *m, *m = swap;
  }
  vs_bending_free(b);
  return ok ? VS_OK : vs_poll(f->vm, 1) ? vs_fail_memory(f->vm) : VS_ERROR;
}

/* (refine o length): returns the solid with smaller facets, whose edges are no longer than `length`. */
vs_status vs_p_refine(vs_args *f, vs_value *out) { return change_parts(f, make_finer, out); }

/* Replaces the leaf's facets by curved ones. #:sharp: edges with at least this angle between their facets stay
 * sharp. */
static vs_status make_smooth(vs_args *f, vs_bend_leaf *leaf) {
  vs_mesh_edges edges;
  vs_mesh m = { 0 };
  vs_bounds b = vs_mesh_bounds(&leaf->mesh);
  double tolerance = vs_bind_tolerance(f->vm);
  if (!(tolerance > 0)) tolerance = fmax(vs_fineness_tolerance(&b), 1e-300);
  bool ok = vs_mesh_edges_make(&edges, &leaf->mesh) &&
            vs_mesh_smooth(&edges, f->key[0].given ? f->key[0].real : 3.14159265358979323846 / 3, tolerance, &m);
  vs_mesh_edges_free(&edges);
  if (!ok) return vs_mesh_free(&m), vs_fail_memory(f->vm);
  vs_mesh_free(&leaf->mesh);
  leaf->mesh = m;
  return VS_OK;
}

/* (do-smooth o): returns the solid with curved facets through its corners. */
vs_status vs_p_do_smooth(vs_args *f, vs_value *out) { return change_parts(f, make_smooth, out); }
