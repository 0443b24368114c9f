/* Implements the native that finds clashes of solids, for library/visualscheme/building/clashes.scm. */
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/shapes/taken_apart.h"
#include "solids/clashes.h"

/* Sets *out to the parts of argument 0 without sections and shadows. */
static bool take_parts(vs_args *f, vs_refs *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_arg_ref_list given = vs_arg_refs(f, 0);
  vs_ref *at = vs_bind_scratch(f, (given.count + 1) * sizeof *at);
  if (!at) return false;
  for (size_t i = 0; i < given.count; i++) {
    at[i] = given.at[i];
    if (at[i].node->flags & VS_NODE_ENDLESS) return vs_fail(vm, vm->sym.range, "%s", VS_ENDLESS_MESSAGE), false;
    vs_node_retain(at[i].node);
    bool ok = vs_bend_resolve(vm, &at[i]);
    if (!vs_bind_keep(f, at[i].node) || !ok) return false;
  }
  *out = (vs_refs){ at, given.count };
  return true;
}

/* Sets *out to the list (kind a b place volume area gap) of a clash; a and b count the parts from 0. */
static bool give(vs_args *f, const vs_clash *c, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2);
  r[1] = VS_NIL;
  if (!vs_bind_give_point(f, c->place, &r[0])) return false;
  const vs_value items[7] = { vs_fix(c->kind),         vs_fix((int64_t)c->a),   vs_fix((int64_t)c->b), r[0],
                              vs_flonum(c->volume), vs_flonum(c->area), vs_flonum(c->gap) };
  for (int i = 7; i-- > 0;)
    if (!vs_cons(vm, i == 3 ? r[0] : items[i], r[1], &r[1])) return false;
  *out = r[1];
  return true;
}

/* (%clashes parts clearance): returns the list of the clashes (solids/clashes.h). */
vs_status vs_p_clashes(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_refs parts;
  vs_clash_list found = { 0 };
  vs_error e = { 0 };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  vs_clash_rule rule = { vs_arg_real(f, 1), vs_bind_tolerance(vm), vs_bind_segments(vm) };
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  if (!take_parts(f, &parts)) return VS_ERROR;
  bool ok = vs_clashes_find(&parts, &rule, &options, &found, &e);
  if (!ok && e.kind != VS_ERROR_INTERRUPT) vs_bind_error(vm, &e);
  for (size_t i = found.count; ok && i-- > 0;)
    ok = give(f, &found.at[i], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, 8);
  free(found.at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
