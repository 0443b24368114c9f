/* Implements the natives of do-deform, which deforms an object by a map. The map is a Scheme procedure or a tape. */
#include <stdlib.h>
#include <string.h>

#include "bind/build.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "bind/functions/function_values.h"
#include "bind/measures.h"
#include "bind/origins.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "geometry/functions/sampling.h"
#include "geometry/measure/bounds.h"
#include "model/store/array.h"

enum { ROUNDS = 14, PART_OF_SIZE = 8 };

typedef struct {
  vs_bind *bind;
  vs_bend_leaves leaves;
  vs_bending **at;  /* at[i]: the deformation of leaf (part) i of the object */
  size_t room, now; /* room: length of the array; now: index of the leaf that is being deformed */
} deformation;

static void deformation_free(void *p) {
  deformation *d = p;
  for (size_t i = 0; d->at && i < d->leaves.count; i++) vs_bending_free(d->at[i]);
  free(d->at);
  vs_bend_drop(&d->leaves);
  free(d);
}
static const vs_foreign_type deformation_type = { .name = "a deformation", .release = deformation_free };
static deformation *given(vs_args *f) { return vs_foreign_get(vs_arg_value(f, 0), &deformation_type); }

/* (%deform o): begins the deformation of the object, and divides the object into leaves (parts). */
vs_status vs_p_deform(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  deformation *d = NULL;
  size_t one = 0;
  vs_bounds b;
  vs_error e = { 0 };
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  if (!vs_node_bounds(vs_arg_ref(f, 0).node, &b, &e)) return vs_bind_error(vm, &e);
  if (!VS_GROW(d, one, 1)) return vs_fail_memory(vm);
  *d = (deformation){ .bind = vs_call_bind(f) };
  if (!vs_bend_take_apart(vm, vs_arg_ref(f, 0), NULL, &d->leaves)) return deformation_free(d), VS_ERROR;
  double size = vs_bounds_diagonal(&b), tolerance = vs_bind_tolerance(vm);
  if (!(tolerance > 0)) tolerance = fmax(vs_fineness_tolerance(&b), 1e-300);
  bool ok = VS_GROW(d->at, d->room, d->leaves.count + 1);
  if (ok) memset(d->at, 0, d->room * sizeof *d->at);
  for (size_t i = 0; ok && i < d->leaves.count; i++)
    ok = (d->at[i] = vs_bending_new(&d->leaves.at[i], tolerance, size / PART_OF_SIZE, ROUNDS)) != NULL;
  if (!ok) return deformation_free(d), vs_fail_memory(vm);
  return vs_make_foreign(vm, &deformation_type, d, 0, out);
}

/* (%deform-wanted d): returns a list of points that the map is to be applied to next, or () at the end. */
vs_status vs_p_deform_wanted(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  deformation *d = given(f);
  VS_ROOTS(vm, r, 2);
  r[1] = VS_NIL;
  size_t n = 0;
  const vs_vec3 *at = NULL;
  for (; d->now < d->leaves.count; d->now++)
    if (at = vs_bending_wanted(d->at[d->now], &n), n) break;
  for (size_t i = n; i-- > 0;)
    if (!vs_bind_give_point(f, at[i], &r[0]) || !vs_cons(vm, r[0], r[1], &r[1]) || !vs_poll(vm, 8))
      return VS_ERROR;
  *out = r[1];
  return VS_OK;
}

/* (%deform-give d images): stores the images, under the map, of the points that %deform-wanted returned last. */
vs_status vs_p_deform_give(vs_args *f, vs_value *out) {
  deformation *d = given(f);
  (void)out;
  return vs_bending_give(d->at[d->now], vs_arg_points(f, 1).at) ? VS_OK : vs_fail_memory(vs_call_vm(f));
}

/* (%deform-by-tape d t): computes all images by a tape (compiled expression) with three inputs and outputs. Returns #t,
 * or a point where the tape has no value. */
vs_status vs_p_deform_by_tape(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  deformation *d = given(f);
  const vs_tape *t = vs_foreign_get(vs_arg_value(f, 1), &vs_tape_type);
  vs_sampler *s = vs_sampler_new(t, 0);
  vs_vec3 *images = NULL;
  size_t room = 0, n;
  vs_vec3 bad = { 0, 0, 0 };
  bool found = false;
  vs_status ok = s ? VS_OK : vs_fail_memory(vm);
  for (; ok && d->now < d->leaves.count; d->now++) {
    const vs_vec3 *at;
    while (ok && (at = vs_bending_wanted(d->at[d->now], &n), n)) {
      if (!VS_GROW(images, room, n)) ok = vs_fail_memory(vm);
      for (size_t i = 0; ok && i < n; i += VS_SAMPLE_BATCH) {
        double in[3][VS_SAMPLE_BATCH], to[3][VS_SAMPLE_BATCH];
        size_t count = n - i < VS_SAMPLE_BATCH ? n - i : VS_SAMPLE_BATCH;
        for (size_t k = 0; k < count; k++) in[0][k] = at[i + k].x, in[1][k] = at[i + k].y, in[2][k] = at[i + k].z;
        vs_sample(s, (const double *const[]){ in[0], in[1], in[2] }, count, (double *const[]){ to[0], to[1], to[2] });
        for (size_t k = 0; ok && k < count; k++) {
          images[i + k] = vs_v3(to[0][k], to[1][k], to[2][k]);
          if (isfinite(to[0][k]) && isfinite(to[1][k]) && isfinite(to[2][k])) continue;
          bad = at[i + k], found = true;
          ok = VS_ERROR;
        }
        if (ok && !vs_poll(vm, t->count * count / 8 + 1)) ok = VS_ERROR;
      }
      if (ok && !vs_bending_give(d->at[d->now], images)) ok = vs_fail_memory(vm);
    }
  }
  vs_sampler_free(s);
  free(images);
  *out = VS_TRUE;
  return found ? vs_bind_give_point(f, bad, out) : ok;
}

/* (%deformed d): returns the deformed object. */
vs_status vs_p_deformed(vs_args *f, vs_value *out) {
  deformation *d = given(f);
  vs_store *s = vs_call_store(f);
  size_t n = d->leaves.count, made = 0;
  vs_ref *refs = vs_bind_scratch(f, (n + 1) * sizeof *refs);
  if (!refs) return VS_ERROR;
  const vs_origin *origin = vs_bind_origin(vs_call_bind(f));
  for (; made < n; made++) {
    vs_mesh *m = vs_bending_mesh(d->at[made]);
    bool solid = d->leaves.at[made].closed && !d->leaves.at[made].curve;
    if (solid) vs_mesh_turn_outwards(m, 0);
    if (solid && !vs_bend_solid(vs_call_vm(f), m)) return VS_ERROR;
    refs[made] = (vs_ref){ vs_bend_node(s, &d->leaves.at[made], m), origin };
    if (!vs_bind_keep(f, refs[made].node)) return VS_ERROR;
  }
  if (n == 0) return vs_bind_empty(f, "there is nothing to deform", out);
  bool left = false;
  for (size_t i = 0; i < n; i++) left = left || refs[i].node->class_ != VS_NOTHING;
  if (!left) return vs_bind_empty(f, "the map leaves no volume of it", out);
  if (n == 1) return vs_bind_give_node(f, vs_node_retain(refs[0].node), out);
  return vs_bind_give_node(f, vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, refs, n), out);
}
