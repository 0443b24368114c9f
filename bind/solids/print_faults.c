/* Implements the native that checks a solid for printing, for library/visualscheme/building/printing.scm. */
#include <stdlib.h>

#include "bind/build.h"
#include "bind/call/context.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/precision.h"
#include "bind/measures.h"
#include "bind/queries.h"
#include "bind/shapes/taken_apart.h"
#include "solids/print_checks.h"
#include "solids/solid_meshes.h"

/* Sets *out to the list (kind place value area) of a fault. */
static bool give(vs_args *f, const vs_print_fault *p, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  VS_ROOTS(vm, r, 2);
  r[1] = VS_NIL;
  if (!vs_bind_give_point(f, p->place, &r[0])) return false;
  if (!vs_cons(vm, vs_flonum(p->area), r[1], &r[1]) || !vs_cons(vm, vs_flonum(p->value), r[1], &r[1]) ||
      !vs_cons(vm, r[0], r[1], &r[1]))
    return false;
  return vs_cons(vm, vs_fix(p->kind), r[1], out);
}

/* (%check-print o wall overhang gap): returns the list of the faults (solids/print_checks.h). */
vs_status vs_p_check_print(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_print_faults found = { 0 };
  vs_solid solid = { 0 };
  vs_error e = { 0 };
  vs_kernel_options options = { .job = vs_bind_job(vm) };
  vs_print_rule rule = { vs_arg_real(f, 1), vs_arg_real(f, 2), vs_arg_real(f, 3) };
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  if (!vs_bind_finite(f, 0) || !vs_bind_resolve(f, 0)) return VS_ERROR;
  vs_ref ref = vs_arg_ref(f, 0);
  if (ref.node->kind == VS_EMPTY) return *out = VS_NIL, VS_OK;
  vs_fineness facets = vs_bend_facets(vm, ref.node);
  if (!(vs_bind_tolerance(vm) > 0)) facets.tolerance /= 4;
  bool ok = vs_solid_evaluate(&ref, 1, &facets, &options, &solid, &e) &&
            vs_print_check(&solid.mesh, vs_call_store(f), &rule, &options, &found, &e);
  if (!ok && e.kind != VS_ERROR_INTERRUPT) vs_bind_error(vm, &e);
  vs_solid_free(&solid);
  for (size_t i = found.count; ok && i-- > 0;)
    ok = give(f, &found.at[i], &r[1]) && vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, 8);
  free(found.at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
