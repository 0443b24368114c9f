/* Implements the errors that the run loop itself detects: undefined names, calls of objects that are no procedures,
 * several values where one is expected. Each function sets the error and returns false. */
#ifndef VS_VM_MACHINE_RUN_FAILURES_H
#define VS_VM_MACHINE_RUN_FAILURES_H

#include "vm/machine/native.h"
#include "vm/front/source.h"
#include "vm/front/suggest.h"
#include "vm/numbers/number.h"

static bool fail_undefined(vs_scheme *vm, vs_value name) {
  const char *said = vs_is_symbol(name) ? vs_source_word(vm, vs_as_symbol(name)->name) : "a variable";
  if (vs_is_symbol(name) && said != vs_as_symbol(name)->name)
    return vs_fail(vm, vm->sym.unbound, "%s is not defined", said);
  vs_text advice;                       /* advice: text about words of other languages, or a similar name */
  vs_text_open(vm, &advice, 300);
  bool ok = vs_suggest(vm, vm->at.program, name, &advice) && vs_text_end(&advice) &&
            vs_fail(vm, vm->sym.unbound, "%s is not defined%s", said, advice.at);
  vs_text_close(&advice);
  return ok;
}

static bool fail_early(vs_scheme *vm, vs_value name) {
  return vs_fail(vm, vm->sym.unbound, "%s is used before it has a value",
                 vs_is_symbol(name) ? vs_as_symbol(name)->name : "a variable");
}

/* Returns v's name if v is an operator, which may have been written between its operands, as in other languages: (5 +
 * 3). Otherwise returns NULL. */
static const char *operator_name(vs_value v) {
  vs_value name = vs_is(v, VS_T_NATIVE) ? vs_as_native(v)->name : VS_FALSE;
  const char *s = vs_is_symbol(name) ? vs_as_symbol(name)->name : "";
  return *s && strspn(s, "+-*/<>=") == strlen(s) ? s : NULL;
}

/* Reports that f cannot be called; at[0..n) are the arguments. */
static bool fail_callee_as(vs_scheme *vm, vs_value f, const vs_value *at, size_t n) {
  VS_ROOTS(vm, r, 1);
  if (f == VS_UNDEFINED || f == VS_ABSENT) return fail_early(vm, VS_FALSE);
  const char *operator = n == 2 ? operator_name(at[0]) : NULL;
  if (!vs_cons(vm, f, VS_NIL, &r[0])) return false;
  if (operator)
    return vs_fail_with(vm, vm->sym.type, r[0],
                        "the operator comes first, (%s a b); this cannot be called:", operator);
  if (vs_is_symbol(f))
    return vs_fail_with(vm, vm->sym.type, r[0],
                        "a symbol is no procedure and cannot be called; the procedure is written without the quote:");
  if (vs_is_string(f))
    return vs_fail_with(vm, vm->sym.type, r[0], "a text cannot be called; a call is written (procedure argument ...):");
  const char *what =
      vs_is_number(f) && n == 0
          ? "a number cannot be called; a name of one is written without parentheses:"
      : vs_is_number(f)
          ? "a number cannot be called (a list is written (list 1 2 3), a point (xyz 1 2 3), a gvector (vxyz 1 2 3)):"
          : "this is no procedure and cannot be called (one parenthesis too many around it?):";
  return vs_fail_with(vm, vm->sym.type, r[0], "%s", what);
}

/* Reports that f cannot be called. The error's payload #t tells session/advice.c that the called object f is wrong;
 * advice.c then searches for f's source. */
static bool fail_callee(vs_scheme *vm, vs_value f, const vs_value *at, size_t n) {
  fail_callee_as(vm, f, at, n);
  if (vs_is(vm->condition, VS_T_CONDITION) &&
      vm->condition != vm->at.no_memory) vs_as_condition(vm->condition)->payload = VS_TRUE;
  return false;
}

static bool fail_several(vs_scheme *vm, vs_value v) {
  uint64_t n = vs_as_values(v)->count;
  if (n == 0) return vs_fail(vm, vm->sym.arity, "no value came where one is expected");
  return vs_fail(vm, vm->sym.arity,
                 "%llu values came where one is expected; let-values, receive or call-with-values take several",
                 (unsigned long long)n);
}

#endif
