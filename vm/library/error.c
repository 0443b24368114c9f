/* Implements the procedures of errors: error, error-object-message and similar, and exit. */
#include "vm/library/format.h"
#include "vm/numbers/number.h"
#include "vm/values/heap.h"

static bool is_condition(vs_value v) { return vs_is(v, VS_T_CONDITION); }

/* Raises an error: (error message irritant ...) as in R7RS, or (error 'who "format" v ...) as in PLT Scheme. A message
 * that is no string is converted to text as by display. */
static vs_status error(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 1);
  bool plt = vs_is_symbol(a[0]) && n > 1 && vs_is_string(a[1]);
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_print(vm, a[0], VS_PRINT_DISPLAY, &t) &&
            (!plt || (vs_text_puts(&t, ": ") && vs_format(vm, a, 1, n, 240, &t))) && vs_text_end(&t);
  r[0] = VS_NIL;
  for (int i = n; ok && !plt && i-- > 1;) ok = vs_cons(vm, a[i], r[0], &r[0]);
  vm->native = NULL;                              /* the message consists of the program's text, without "error: "
                                                   * before it */
  if (ok) {
    vs_fail_with(vm, vm->sym.error, r[0], "%s", t.at);
    if (is_condition(vm->condition) && vm->condition != vm->at.no_memory) {
      vs_condition *c = vs_as_condition(vm->condition);
      /* stores the original string as the message, since it may contain zero characters */
      if (vs_is_string(a[0])) vs_gc_store(vm, c, &c->message, a[0]);
    }
  }
  vs_text_close(&t);
  return VS_ERROR;
}

static vs_status is_error(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)vm, (void)n, *out = vs_bool(is_condition(a[0])), VS_OK;
}
static vs_status is_kind(vs_value v, vs_value kind, vs_value *out) {
  return *out = vs_bool(is_condition(v) && vs_as_condition(v)->kind == kind), VS_OK;
}
static vs_status is_read_error(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, is_kind(a[0], vm->sym.read, out);
}
static vs_status is_file_error(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return (void)n, is_kind(a[0], vm->sym.file, out);
}

static bool want_condition(vs_scheme *vm, const vs_value *a) {
  return is_condition(a[0]) || vs_fail_type(vm, 0, "an error", a[0]);
}

static vs_status message(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_condition(vm, a) ? (*out = vs_as_condition(a[0])->message, VS_OK) : VS_ERROR;
}
static vs_status irritants(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_condition(vm, a) ? (*out = vs_as_condition(a[0])->irritants, VS_OK) : VS_ERROR;
}
static vs_status kind(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return want_condition(vm, a) ? (*out = vs_as_condition(a[0])->kind, VS_OK) : VS_ERROR;
}
/* Returns the message and the irritants as text. */
static vs_status report(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!want_condition(vm, a)) return VS_ERROR;
  vs_text t;
  vs_text_open(vm, &t, 0);
  bool ok = vs_print_condition(vm, a[0], &t) && vs_text_to_string(&t, out);
  vs_text_close(&t);
  return ok;
}

/* (exit [code]): runs the `after` procedure of every dynamic-wind that was entered. Then ends the program with an error
 * object of kind `exit`, which no handler receives. Its payload is the code, a fixnum. */
static vs_status leave(vs_scheme *vm, vs_value code, vs_value *out) {
  (void)out;
  VS_ROOTS(vm, r, 2);
  r[0] = code == VS_TRUE || code == VS_ABSENT ? vs_fix(0)
         : vs_is_fixnum(code)                 ? vs_fix(vs_fixnum(code) & 255)
                                              : vs_fix(1);
  /* The operating system uses only the lowest 8 bits of an exit code. A code such as 256 would become 0, which means
   * success. */
  if (r[0] == vs_fix(0) && vs_is_fixnum(code) && code != vs_fix(0)) r[0] = vs_fix(1);
  if (!vs_intern_c(vm, "exit", &r[1])) return VS_ERROR;
  vm->native = NULL;
  vs_fail(vm, r[1], "exit");
  if (is_condition(vm->condition) && vm->condition != vm->at.no_memory)
    vs_gc_store(vm, vs_as_condition(vm->condition), &vs_as_condition(vm->condition)->payload, r[0]);
  return VS_UNCAUGHT;
}

static vs_status exit_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_pair(vm->winders)) return leave(vm, a[0], out);
  const vs_vector *winder = vs_as_vector(vs_car(vm->winders));
  vm->handlers = winder->at[2];
  vm->parameters = winder->at[3];
  vm->winders = vs_cdr(vm->winders);
  return vs_call(vm, winder->at[1], 0, NULL);
}
static vs_status emergency_exit(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  return leave(vm, n ? a[0] : VS_ABSENT, out);
}

static const vs_native_def defs[] = {
    {"error", "message . irritants", error, 0, "end with this message; or (error 'who \"format\" v ...)"},
    {"error-object? error? exn? condition?", "x", is_error, 0, NULL},
    {"read-error?", "x", is_read_error, 0, NULL},
    {"file-error?", "x", is_file_error, 0, NULL},
    {"error-object-message error-message", "error", message, 0, NULL},
    {"error-object-irritants error-irritants", "error", irritants, 0, NULL},
    {"error-object-kind", "error", kind, 0, "a symbol: error, type, range, arity, contract, unbound, ..."},
    {"condition/report-string exn-message", "error", report, 0, "the whole text of an error"},
    {"exit", "[code]", exit_, 1, NULL},
    {"emergency-exit", "[code]", emergency_exit, 0, NULL},
    {NULL, NULL, NULL, 0, NULL},
};
const vs_native_table vs_error_natives = {"error", defs};
