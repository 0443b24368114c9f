/* Implements the queue of a program's checks (check-expect and similar). A check waits until the program ends, so that
 * it may precede the definitions that it uses. The queue is a pair of the first and the last pair of its list. */
#include "vm/machine/check_queue.h"

#include "vm/front/environment.h"
#include "vm/machine/activation.h"
#include "vm/machine/native.h"
#include "vm/values/heap.h"

/* Adds a check to the queue. Arguments: form expression actual [expected [tolerance]]. Refuses a check while another
 * check runs, since running them might never end. */
static vs_status check_later(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  vs_pos place = vs_call_place(vm);
  vm->native = NULL;
  if (vm->at.checks == VS_TRUE) return vs_fail(vm, vm->sym.error, "a check within a check: they stand side by side");
  if (!vs_make_vector(vm, VS_CHECK_WORDS, VS_FALSE, &r[0])) return VS_ERROR;
  vs_vector *v = vs_as_vector(r[0]);
  vs_gc_store(vm, v, &v->at[VS_CHECK_PLACE], vs_fix((int64_t)place));
  for (int i = 0; i < n; i++) {
    int word = i < 2 ? i : VS_CHECK_ACTUAL + i - 2;
    vs_gc_store(vm, v, &v->at[word], a[i]);
  }
  if (!vs_cons(vm, r[0], VS_NIL, &r[1])) return VS_ERROR;
  *out = VS_UNSPECIFIC;
  if (!vs_is_pair(vm->at.checks)) return vs_cons(vm, r[1], r[1], &vm->at.checks) ? VS_OK : VS_ERROR;
  vs_pair *last = vs_as_pair(vs_cdr(vm->at.checks)), *queue = vs_as_pair(vm->at.checks);
  vs_gc_store(vm, last, &last->cdr, r[1]);
  vs_gc_store(vm, queue, &queue->cdr, r[1]);
  return VS_OK;
}

bool vs_checks_wait(const vs_scheme *vm) { return vs_is_pair(vm->at.checks); }

vs_value vs_checks_take(vs_scheme *vm) {
  vs_pair *queue = vs_as_pair(vm->at.checks);
  vs_value first = vs_car(queue->car), rest = vs_cdr(queue->car);
  VS_ASSERT(vs_checks_wait(vm));
  if (vs_is_pair(rest)) vs_gc_store(vm, queue, &queue->car, rest);
  else vm->at.checks = VS_NIL;
  return first;
}

const char *vs_checks_redefined(vs_scheme *vm) {
  static const char *const words[] = { "check-expect", "check-within", "check-error" };
  VS_ROOTS(vm, r, 1);
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    if (!vs_intern_c(vm, words[i], &r[0])) return NULL;
    vs_meaning own = vs_environment_find(vm->at.program, r[0]), library = vs_environment_find(vm->at.core, r[0]);
    if ((own.kind == VS_MEANS_CELL || own.kind == VS_MEANS_MACRO) &&
        (own.kind != library.kind || own.value != library.value)) return words[i];
  }
  return NULL;
}

static const vs_native_def defs[] = {
  { "%check-later", "form expression actual [expected tolerance]", check_later, 0, NULL },
  { 0 }
};
const vs_native_table vs_checks_natives = { "checks", defs };
