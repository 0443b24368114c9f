/* Implements back-ends (export formats) that programs define: the list of these back-ends, and the drawing as a Scheme
 * value. The session searches the list and calls a back-end's procedure as a separate evaluation. back_ends.scm
 * contains the Scheme part. */
#include "bind/back_ends.h"

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/context.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "bind/objects.h"
#include "bind/queries.h"
#include "bind/state.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"

#include <strings.h>

#include "geometry/measure/node_measures.h"
#include "geometry/shapes/simple_nodes.h"
#include "solids/solid_meshes.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

/* ---- the drawing as a list of objects ---- */

vs_status vs_p_drawing(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  size_t n = b->drew ? b->scene.drawn_count : b->returned_count;
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = n; i-- > 0;) {
    vs_ref ref = b->drew ? b->scene.drawn[i] : (vs_ref){ b->returned[i].node, b->returned[i].origin };
    if (!vs_bind_give_ref(b, ref, &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0])) return VS_ERROR;
  }
  *out = r[0];
  return VS_OK;
}

/* ---- replacing an object by simpler kinds ---- */

static vs_status lower_triangles(vs_args *f, const vs_fineness *facets, vs_node **made) {
  const vs_ref *ref = &f->arg[0].ref;
  vs_error e = { 0 };
  bool ok;
  if (ref->node->class_ == VS_SOLID || ref->node->class_ == VS_MIXED) {
    vs_solid solid = { 0 };
    vs_kernel_options options = { .job = vs_bind_job(f->vm) };
    ok = vs_solid_evaluate(ref, 1, facets, &options, &solid, &e);
    if (ok) *made = vs_node_of_mesh(f->store, &solid.mesh, true);
    vs_solid_free(&solid);
  } else {
    vs_mesh mesh = { 0 };
    ok = vs_tessellate(ref->node, facets, &mesh, &e);
    if (ok) *made = vs_node_of_mesh(f->store, &mesh, false);
    vs_mesh_free(&mesh);
  }
  if (ok) return *made ? VS_OK : vs_fail_memory(f->vm);
  return e.kind == VS_ERROR_INTERRUPT ? VS_ERROR : vs_bind_error(f->vm, &e);
}

vs_status vs_p_lowered(vs_args *f, vs_value *out) {
  vs_error e = { 0 };
  vs_bounds bounds;
  /* Whether the object contains a shadow or a similar node, whose shape must be computed before its triangles. */
  bool worked_out = (f->arg[0].ref.node->flags & VS_NODE_UNRESOLVED) != 0;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  const vs_node *n = f->arg[0].ref.node;
  vs_fineness facets = { .tolerance = vs_bind_tolerance(f->vm), .segments = vs_bind_segments(f->vm) };
  if (vs_node_is_empty(n) || n->kind == VS_LINE || n->kind == VS_POLYFACE_MESH)
    return vs_bind_give_node(f, vs_node_retain(f->arg[0].ref.node), out);
  if (!vs_node_bounds(n, &bounds, &e)) return vs_bind_error(f->vm, &e);
  if (facets.tolerance <= 0) facets.tolerance = vs_fineness_tolerance(&bounds);
  vs_node *made = NULL;
  if (n->class_ == VS_CURVE) {
    vs_polyline p = { .count = 0 };
    bool ok = vs_curve_sample(n, &facets, &p, &e);
    if (ok) made = vs_node_of_polyline(f->store, &p);
    vs_polyline_free(&p);
    if (!ok) return vs_bind_error(f->vm, &e);
  } else if (n->class_ == VS_REGION_CLASS && (worked_out || !vs_node_is_outline(n))) {
    vs_outline o = { .count = 0 };
    bool ok = vs_region_outline(n, &facets, &o, &e);
    if (ok) made = vs_node_of_outline(f->store, &o, f->arg[0].ref.origin);
    vs_outline_free(&o);
    if (!ok) return vs_bind_error(f->vm, &e);
  } else if (!lower_triangles(f, &facets, &made)) {
    return VS_ERROR;
  }
  return vs_bind_give_node(f, made, out);
}

/* ---- the list of the program's back-ends ---- */

const vs_bind_back_end *vs_bind_back_end_find(const vs_bind *b, const char *text) {
  const char *dot = strrchr(text, '.'), *slash = strrchr(text, '/');
  const char *suffix = dot && (!slash || dot > slash) ? dot + 1 : text;
  for (size_t i = 0; i < b->back_end_count; i++)
    if (!strcasecmp(b->back_ends[i].suffix, suffix) || !strcasecmp(b->back_ends[i].name, text)) return &b->back_ends[i];
  return NULL;
}

static bool same_name(const vs_bind_back_end *a, const char *name) { return !strcmp(a->name, name); }

vs_status vs_p_back_end(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  vs_bind_back_end made = { vs_store_text(b->store, f->arg[0].text.at, f->arg[0].text.length),
                            vs_store_text(b->store, f->arg[1].text.at, f->arg[1].text.length),
                            vs_store_text(b->store, f->arg[2].text.at, f->arg[2].text.length), f->arg[3].boolean,
                            f->arg[4].boolean };
  (void)out;
  if (!made.name || !made.suffix || !made.doc) return vs_fail_memory(f->vm);
  if (b->is_built_in && b->is_built_in(made.name))
    return vs_bind_refuse(f, "name", "a name that no format has yet", f->arg[0].value);
  if (b->is_built_in && b->is_built_in(made.suffix))
    return vs_bind_refuse(f, "suffix", "an ending that no format has yet", f->arg[1].value);
  for (size_t i = 0; i < b->back_end_count; i++)
    /* a file that is loaded again may define a back-end of the same name again */
    if (same_name(&b->back_ends[i], made.name)) return b->back_ends[i] = made, VS_OK;
  if (b->back_end_count == b->back_end_room) {
    size_t room = b->back_end_room ? 2 * b->back_end_room : 4;
    vs_bind_back_end *more =
        vs_store_realloc(b->store, b->back_ends, b->back_end_room * sizeof *more, room * sizeof *more);
    if (!more) return vs_fail_memory(f->vm);
    b->back_ends = more, b->back_end_room = room;
  }
  b->back_ends[b->back_end_count++] = made;
  return VS_OK;
}

/* ---- calling a back-end's Scheme procedure ---- */

enum { HOST_WRITE = 3 }; /* index in vm->at.host at which back_ends.scm stores its procedure when the program defines
                          * its first back-end */

bool vs_bind_back_end_write(vs_bind *b, const char *name, const vs_ref *refs, size_t count, char **text,
                            size_t *bytes) {
  vs_scheme *vm = b->vm;
  VS_ROOTS(vm, r, 4); /* roots of the garbage collector: the procedure, the name, the list of objects, the result */
  *text = NULL;
  r[0] = vs_as_vector(vm->at.host)->at[HOST_WRITE];
  if (!vs_bind_give_refs(b, refs, count, &r[2])) return false;
  if (!vs_intern_c(vm, name, &r[1])) return false;
  vs_value arguments[2] = { r[1], r[2] };
  if (!vs_run(vm, r[0], 2, arguments, &r[3])) return false;
  if (vs_is_string(r[3])) {
    size_t room;
    if (!vs_bind_take_text(vm, r[3], text, &room)) return false;
    *bytes = room - 1;
    return true;
  }
  const vs_bytes *data = vs_as_bytes(r[3]);
  *bytes = (size_t)data->length;
  if (!(*text = vs_mem(vm, NULL, 0, *bytes + 1))) return vs_fail_memory(vm);
  memcpy(*text, data->at, *bytes);
  return true;
}
