/* Starts the run loop for calls from outside the loop, and restores the interpreter's state after it. */
#include "vm/machine/run.h"

#include "vm/machine/activation.h"
#include "vm/machine/poll.h"
#include "vm/machine/run_loop.h"
#include "vm/stepping/step_loop.h"

static void reset(vs_scheme *vm) {
  vm->base = NULL;
  vm->top = vm->stack;
  vm->pc = NULL;
  vm->native = NULL;
  vm->under = VS_FALSE;
  vm->under_depth = 0;
  vm->call_count = 0;
  vm->call_procedure = VS_FALSE;
  vm->winders = vm->handlers = vm->parameters = VS_NIL;
}

/* Called when memory is out and no code caught the error. Frees the program's data, so that there is memory to report
 * the place. */
static void fail_memory_placed(vs_scheme *vm) {
  enum { CALLERS = 16 };
  VS_ROOTS(vm, r, CALLERS + 2);
  vs_pos place[CALLERS] = {0};
  size_t n = vs_call_links(vm, r, place, CALLERS);
  reset(vm);
  vm->value = VS_UNSPECIFIC;              /* releases the last result of a native, which may use much memory */
  vs_gc_major(vm);
  vs_value *link = r + CALLERS, *chain = r + CALLERS + 1;
  *chain = VS_NIL;
  for (size_t i = n; i--;)
    if (!vs_cons(vm, r[i], vs_fix((int64_t)place[i]), link) || !vs_cons(vm, *link, *chain, chain)) return;
  vs_fail_at(vm, vm->sym.memory, place[0], VS_NIL, "out of memory");
  if (vm->condition == vm->at.no_memory) return;
  vs_condition *c = vs_as_condition(vm->condition);
  vs_gc_store(vm, c, &c->chain, *chain);
}

bool vs_run(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv, vs_value *out) {
  if (vm->base) return vs_fail(vm, vm->sym.internal, "the interpreter is running already");
  vm->value = procedure;
  if ((size_t)(vm->stack_end - vm->stack) < n + 2 + VS_ACTIVATION_SLACK) {
    vm->top = vm->stack;
    if (!vs_activation_flush(vm, vm->stack, 0, n + 2)) return false;
  }
  vs_value *w = vm->stack;
  w[0] = procedure;
  w[1] = VS_TAG_FIXNUM << 48 | VS_RET_STOP;
  if (n) memcpy(w + 2, argv, n * sizeof *argv);
  vm->top = w + 2 + n;
  vm->under = VS_FALSE;
  if (vm->config.clock) vm->started = vm->config.clock(vm->config.user);
  vs_refuel(vm);
  vs_value result = VS_UNSPECIFIC;
  bool ok = (vm->step.mode == VS_STEP_CONTINUE ? vs_run_loop : vs_step_loop)(vm, w, n, &result);
  vm->steps -= (uint64_t)(vm->fuel > 0 ? vm->fuel : 0);       /* subtracts the turns that were not used since the last
                                                               * poll */
  if (!ok && vm->condition == vm->at.no_memory) fail_memory_placed(vm);
  reset(vm);
  if (ok) *out = result;
  return ok;
}
