/* Implements the procedures of control: continuations, dynamic-wind, values, apply, handlers and raise, parameters,
 * promises, contracts.
 *
 * The dynamic state is three lists in struct vs_scheme, each part of a continuation:
 *   winders     vectors (before after handlers parameters), innermost first
 *   handlers    procedures; a list with a continuation belongs to a contract: raise returns #f to this continuation
 *   parameters  pairs (parameter . value)
 * The natives of this file keep their state in slots of their activations (native.h, VS_CALL). A continuation may
 * therefore leave and enter each of them again. Comments list a native's arguments and, after a bar, the slots for its
 * state. */
#include "vm/machine/activation.h"
#include "vm/machine/fail.h"
#include "vm/machine/native.h"
#include "vm/library/port.h"
#include "vm/values/pairs.h"
#include "vm/values/printer.h"
#include "vm/machine/run.h"

/* ---- continuations and dynamic-wind ---- */

/* Sets *out to the continuation of the running native, whose arguments are at vm->base. The native's activation moves,
 * and vm->base with it. */
static bool capture(vs_scheme *vm, vs_value *out) {
  if (!vs_activation_capture(vm, vm->base - 2, (size_t)(vm->top - vm->base), out)) return false;
  vm->captures++;
  return true;
}

static vs_status call_cc(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_procedure(a[0])) return vs_fail_type(vm, 0, "a procedure", a[0]);
  return capture(vm, out) && vs_tailcall(vm, vm->base[0], 1, out) ? VS_TAILCALL : VS_ERROR;
}

static int64_t length(vs_value list) {
  int64_t n = 0;
  for (; vs_is_pair(list); list = vs_cdr(list)) n++;
  return n;
}

static vs_value common_tail(vs_value a, vs_value b) {
  int64_t la = length(a), lb = length(b);
  for (; la > lb; la--) a = vs_cdr(a);
  for (; lb > la; lb--) b = vs_cdr(b);
  while (a != b) { a = vs_cdr(a); b = vs_cdr(b); }
  return a;
}

static void enter_state_of(vs_scheme *vm, vs_value winder) {
  vm->handlers = vs_as_vector(winder)->at[2];
  vm->parameters = vs_as_vector(winder)->at[3];
}

/* throw: returns the value to the continuation k, after calling the `after` and `before` procedures of the
 * dynamic-winds on the way, one at a time. After each call, determines the remaining ones again. Arguments: k value |
 * list that vm->winders becomes after a `before` procedure has returned, or #f. */
static vs_status throw_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (a[2] != VS_FALSE) { vm->winders = a[2]; a[2] = VS_FALSE; }
  vs_value target = vs_as_continuation(a[0])->winders, shared = common_tail(vm->winders, target);
  if (vm->winders != shared) {
    vs_value winder = vs_car(vm->winders);
    vm->winders = vs_cdr(vm->winders);
    enter_state_of(vm, winder);
    return vs_call(vm, vs_as_vector(winder)->at[1], 0, NULL);
  }
  if (target != shared) {
    while (vs_cdr(target) != shared) target = vs_cdr(target);
    a[2] = target;
    enter_state_of(vm, vs_car(target));
    return vs_call(vm, vs_as_vector(vs_car(target))->at[0], 0, NULL);
  }
  vs_call_begin(vm, a[0]);
  *out = a[1];
  return VS_THROW;
}

/* Implements dynamic-wind. Arguments: before thunk after | phase, result of thunk. */
static vs_status dynamic_wind(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n >= 0) {
    for (int i = 0; i < 3; i++)
      if (!vs_is_procedure(a[i])) return vs_fail_type(vm, i, "a procedure", a[i]);
    a[3] = vs_fix(0);
    return vs_call(vm, a[0], 0, NULL);
  }
  if (a[3] == vs_fix(0)) {
    VS_ROOTS(vm, r, 1);
    if (!vs_make_vector(vm, 4, VS_FALSE, &r[0])) return VS_ERROR;
    vs_vector *winder = vs_as_vector(r[0]);       /* a new object is in the nursery, and needs no write barrier */
    winder->at[0] = a[0]; winder->at[1] = a[2]; winder->at[2] = vm->handlers; winder->at[3] = vm->parameters;
    if (!vs_cons(vm, r[0], vm->winders, &vm->winders)) return VS_ERROR;
    a[3] = vs_fix(1);
    return vs_call(vm, a[1], 0, NULL);
  }
  if (a[3] == vs_fix(1)) {
    a[4] = *out;
    a[3] = vs_fix(2);
    vm->winders = vs_cdr(vm->winders);
    return vs_call(vm, a[2], 0, NULL);
  }
  *out = a[4];
  return VS_OK;
}

/* ---- several values, and apply ---- */
static vs_status values(vs_scheme *vm, vs_value *a, int n, vs_value *out) { return vs_several(vm, a, (size_t)n, out); }

/* Implements call-with-values. Arguments: producer consumer | unused. */
static vs_status call_with_values(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n >= 0) return vs_call(vm, a[0], 0, NULL);
  if (!vs_is(*out, VS_T_VALUES)) return vs_tailcall(vm, a[1], 1, out);
  vs_call_begin(vm, a[1]);
  for (uint64_t i = 0; i < vs_as_values(*out)->count; i++)
    if (!vs_call_push(vm, vs_as_values(*out)->at[i])) return VS_ERROR;
  return VS_TAILCALL;
}

static vs_status apply(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  vs_value last = a[n - 1];
  VS_ROOTS(vm, r, 1);
  if (vs_list_length(last) < 0)
    return vs_cons(vm, last, VS_NIL, &r[0]) &&
           vs_fail_with(vm, vm->sym.type, r[0], "the last argument must be a list, got");
  vs_call_begin(vm, a[0]);
  for (int i = 1; i < n - 1; i++)
    if (!vs_call_push(vm, a[i])) return VS_ERROR;
  for (uint64_t i = 0; last != VS_NIL; last = vs_cdr(last), i++)
    if (!vs_call_push(vm, vs_car(last)) || !vs_poll_turn(vm, i, 4)) return VS_ERROR;
  return VS_TAILCALL;
}

/* (%apply-self procedure list this): calls the procedure as a script calls a method of the object `this`. */
static vs_status apply_self(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n; (void)out;
  vs_value list = a[1];
  vs_call_begin(vm, a[0]);
  for (uint64_t i = 0; vs_is_pair(list); list = vs_cdr(list), i++)
    if (!vs_call_push(vm, vs_car(list)) || !vs_poll_turn(vm, i, 4)) return VS_ERROR;
  if (!vs_call_push(vm, a[2])) return VS_ERROR;
  vm->call_self = true;
  return VS_TAILCALL;
}

/* Returns true if the code is that of a function in a script (JavaScript). Such a function accepts any number of
 * arguments, and its translation has a parameter for `this` or a rest parameter. */
static bool is_script_function(vs_scheme *vm, const vs_code *code) {
  const vs_vector *params = vs_as_vector(code->params);
  size_t before = (size_t)code->required + code->optional;
  if (code->required || !(code->flags & VS_CODE_REST)) return false;
  if (code->keywords) return code->keywords == 1 && params->at[before] == vm->sym.self;
  return vs_is_symbol(params->at[before]) && !strcmp(vs_as_symbol(params->at[before])->name, "more:");
}

/* (%procedure-shape procedure): returns the vector #(least most script?). least and most are the numbers of arguments
 * that the procedure accepts; most is #f if there is no limit. For a function of a script, least and most are its
 * number of parameters. */
static vs_status procedure_shape(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (!vs_is_procedure(a[0])) return vs_fail_type(vm, 0, "a procedure", a[0]);
  uint32_t least = 0, most = UINT32_MAX;
  bool script = false;
  if (vs_is(a[0], VS_T_CASE) && vs_as_case(a[0])->count) { /* uses the number of parameters of the first clause of a
                                                            * case-lambda */
    const vs_code *code = vs_as_code(vs_as_closure(vs_as_case(a[0])->clause[0])->code);
    least = code->required;
  } else if (vs_is(a[0], VS_T_CLOSURE)) {
    const vs_code *code = vs_as_code(vs_as_closure(a[0])->code);
    script = is_script_function(vm, code);
    least = script ? code->optional : code->required;
    if (script || !(code->flags & VS_CODE_REST)) most = code->required + code->optional;
  } else if (vs_is(a[0], VS_T_NATIVE)) {
    least = vs_as_native(a[0])->min;
    most = vs_as_native(a[0])->max;
  }
  if (!vs_make_vector(vm, 3, vs_bool(script), out)) return VS_ERROR;
  vs_as_vector(*out)->at[0] = vs_fix(least);
  vs_as_vector(*out)->at[1] = most == UINT32_MAX ? VS_FALSE : vs_fix(most);
  return VS_OK;
}

/* ---- handlers and raise ---- */
/* Implements with-exception-handler. Arguments: handler thunk | the list vm->handlers before the call. */
static vs_status with_exception_handler(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  if (n >= 0) {
    if (!vs_is_procedure(a[0])) return vs_fail_type(vm, 0, "a procedure", a[0]);
    a[2] = vm->handlers;
    return vs_cons(vm, a[0], vm->handlers, &vm->handlers) && vs_call(vm, a[1], 0, NULL) ? VS_CALL : VS_ERROR;
  }
  vm->handlers = a[2];
  return VS_OK;
}

/* Implements raise and raise-continuable. Arguments: obj | the list vm->handlers at the call of raise. */
static vs_status raise_either(vs_scheme *vm, vs_value *a, int n, bool continuable) {
  if (n >= 0) {
    vm->native = NULL;
    if (vm->handlers == VS_NIL) {
      if (!vs_is(a[0], VS_T_CONDITION)) {
        VS_ROOTS(vm, r, 1);
        if (!vs_cons(vm, a[0], VS_NIL, &r[0])) return VS_UNCAUGHT;
        vs_fail_with(vm, vm->sym.raise, r[0], "an object was raised and has no handler:");
        if (vs_is(vm->condition, VS_T_CONDITION) && vm->condition != vm->at.no_memory)
          vs_gc_store(vm, vs_as_condition(vm->condition), &vs_as_condition(vm->condition)->payload, a[0]);
      } else {
        vm->condition = a[0];
      }
      return VS_UNCAUGHT;
    }
    a[1] = vm->handlers;
    vs_value handler = vs_car(vm->handlers);
    if (vs_is_pair(handler)) {          /* a pair belongs to a contract whose predicate failed: the value of the
                                         * predicate becomes #f, unless memory is out */
      if (vs_is(a[0], VS_T_CONDITION) && vs_as_condition(a[0])->kind == vm->sym.memory) {
        vm->handlers = vs_cdr(vm->handlers);
        return vs_fail_object(vm, a[0]);
      }
      vs_value with[2] = {vs_car(handler), VS_FALSE};
      return vs_tailcall(vm, vm->at.throw, 2, with);
    }
    vm->handlers = vs_cdr(vm->handlers);
    return vs_call(vm, handler, 1, a);
  }
  if (continuable) {
    vm->handlers = a[1];
    return VS_OK;
  }
  /* A handler of raise has returned, which is not permitted. The next outer handler receives an error; if the raised
   * object is itself an error object, it receives that object. */
  vm->handlers = vs_cdr(a[1]);
  vm->native = NULL;
  if (vs_is(a[0], VS_T_CONDITION)) return vs_fail_object(vm, a[0]);
  VS_ROOTS(vm, r, 1);
  return vs_cons(vm, a[0], VS_NIL, &r[0]) &&
         vs_fail_with(vm, vm->sym.raise, r[0], "the handler returned, but raise cannot go on:");
}

static vs_status raise_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  return raise_either(vm, a, n, false);
}
static vs_status raise_continuable(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)out;
  return raise_either(vm, a, n, true);
}

/* ---- parameters ---- */
/* Implements make-parameter. Arguments: value [converter] | whether the converter was called. */
static vs_status make_parameter(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n >= 0 && a[1] != VS_ABSENT && a[1] != VS_FALSE) return vs_call(vm, a[1], 1, a);
  if (n < 0) a[0] = *out;
  vs_parameter *p = (vs_parameter *)(void *)vs_gc_alloc(vm, VS_T_PARAMETER, VS_WORDS(vs_parameter));
  if (!p) return VS_ERROR;
  p->value = a[0];
  p->converter = a[1] == VS_ABSENT ? VS_FALSE : a[1];
  p->name = VS_FALSE;
  *out = vs_from_object(p);
  return VS_OK;
}

/* Implements the form parameterize. Arguments: parameters values thunk | phase (0: converting values, 1: running the
 * thunk), list: in phase 0 the bindings so far, in phase 1 the list vm->parameters before the call. */
static vs_status parameterize(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (n < 0 && a[3] == vs_fix(1)) { vm->parameters = a[4]; return VS_OK; }
  VS_ROOTS(vm, r, 1);
  if (n >= 0) { a[3] = vs_fix(0); a[4] = vm->parameters; }
  bool converted = n < 0;
  while (vs_is_pair(a[0])) {
    vs_value p = vs_car(a[0]), v = vs_car(a[1]);
    if (!vs_is(p, VS_T_PARAMETER)) {
      vm->native = NULL;
      return vs_cons(vm, p, VS_NIL, &r[0]) &&
             vs_fail_with(vm, vm->sym.type, r[0], "parameterize needs a parameter, got");
    }
    if (!converted && vs_as_parameter(p)->converter != VS_FALSE)
      return vs_call(vm, vs_as_parameter(p)->converter, 1, &v);
    if (converted) v = *out;
    converted = false;
    if (!vs_port_parameter_fits(vm, p, v)) {
      vm->native = NULL;
      return vs_cons(vm, v, VS_NIL, &r[0]) &&
             vs_fail_with(vm, vm->sym.type, r[0], "%s must be a port of its direction, got",
                          vs_as_symbol(vs_as_parameter(p)->name)->name);
    }
    if (!vs_cons(vm, p, v, &r[0]) || !vs_cons(vm, r[0], a[4], &a[4])) return VS_ERROR;
    a[0] = vs_cdr(a[0]); a[1] = vs_cdr(a[1]);
  }
  vs_value outside = vm->parameters;
  vm->parameters = a[4];
  a[4] = outside;
  a[3] = vs_fix(1);
  return vs_call(vm, a[2], 0, NULL);
}

/* ---- promises: if `done` is #t, `value` is the result; if #f, `value` is a thunk that returns a promise; if
 * VS_ABSENT, `value` is a promise with the same result ---- */
static bool new_promise(vs_scheme *vm, vs_value done, vs_value *value, vs_value *out) {
  vs_promise *p = (vs_promise *)(void *)vs_gc_alloc(vm, VS_T_PROMISE, VS_WORDS(vs_promise));
  if (!p) return false;
  p->done = done; p->value = *value;
  *out = vs_from_object(p);
  return true;
}

static vs_status make_promise(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  if (vs_is(a[0], VS_T_PROMISE)) { *out = a[0]; return VS_OK; }
  return new_promise(vm, VS_TRUE, &a[0], out);
}
static vs_status lazy(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return new_promise(vm, VS_FALSE, &a[0], out);
}
/* (%kept-promise v): returns a promise whose value is v, for delay. Unlike make-promise, it wraps even a v that is a
 * promise. */
static vs_status kept_promise(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  return new_promise(vm, VS_TRUE, &a[0], out);
}
static vs_status is_promise(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm;
  (void)n;
  *out = vs_bool(vs_is(a[0], VS_T_PROMISE));
  return VS_OK;
}

static vs_value promise_root(vs_value p) {
  while (vs_as_promise(p)->done == VS_ABSENT) p = vs_as_promise(p)->value;
  return p;
}

/* Implements force. Arguments: promise | unused. */
static vs_status force(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  if (!vs_is(a[0], VS_T_PROMISE)) { *out = a[0]; return VS_OK; }
  vs_value root = promise_root(a[0]);
  vs_promise *p = vs_as_promise(root);
  if (n < 0 && p->done == VS_FALSE) {
    if (!vs_is(*out, VS_T_PROMISE))
      return vs_fail(vm, vm->sym.type, "delay-force needs a promise, got %s", vs_noun(vm, *out));
    vs_value next = promise_root(*out);
    if (next != root) {
      vs_promise *q = vs_as_promise(next);
      p->done = q->done;
      vs_gc_store(vm, p, &p->value, q->value);
      if (q->done == VS_FALSE) { q->done = VS_ABSENT; vs_gc_store(vm, q, &q->value, root); }
    }
  }
  if (p->done == VS_TRUE) { *out = p->value; return VS_OK; }
  return vs_call(vm, p->value, 0, NULL);
}

/* ---- contracts ---- */
static vs_status any(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)vm;
  (void)a;
  (void)n;
  *out = VS_TRUE;
  return VS_OK;
}

/* Calls the predicate of a contract, and catches errors. Arguments: predicate value. Returns (predicate value), or #f
 * if it raises an error. */
static vs_status guarded(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a; (void)n;
  VS_ROOTS(vm, r, 1);
  if (!capture(vm, out) || !vs_cons(vm, *out, VS_NIL, &r[0]) || !vs_cons(vm, r[0], VS_NIL, &vm->handlers))
    return VS_ERROR;
  return vs_tailcall(vm, vm->base[0], 1, &vm->base[1]);
}

/* Appends a contract as the program writes it, without the % of internal names. */
static bool contract_text(vs_text *t, vs_value v) {
  if (!vs_is_symbol(v)) return vs_print(t->vm, v, VS_PRINT_WRITE, t);
  const char *name = vs_as_symbol(v)->name;
  return vs_text_puts(t, name[0] == '%' && name[1] ? name + 1 : name);
}

/* Checks a contract. Arguments: predicate value #(name text who) | the list vm->handlers before the check. */
static vs_status check(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  bool predicate = vs_is_procedure(a[0]);
  if (n >= 0 && predicate) {
    a[3] = vm->handlers;
    return vs_call(vm, vm->at.guarded, 2, a);
  }
  if (predicate) {
    vm->handlers = a[3];
    if (*out != VS_FALSE) { *out = a[1]; return VS_OK; }
  }
  vs_text name, text;
  vs_text_open(vm, &name, 200);
  vs_text_open(vm, &text, 400);
  VS_ROOTS(vm, r, 1);
  vs_value who = vs_as_vector(a[2])->at[2];
  vm->native = NULL;
  bool ok = contract_text(&name, vs_as_vector(a[2])->at[0]) && vs_text_end(&name) &&
            contract_text(&text, vs_as_vector(a[2])->at[1]) && vs_text_end(&text) && vs_cons(vm, a[1], VS_NIL, &r[0]);
  if (ok) {
    const char *f = vs_is_symbol(who) ? vs_as_symbol(who)->name : "procedure";
    if (predicate) vs_fail_with(vm, vm->sym.contract, r[0], "%s: %s must be %s, got", f, name.at, text.at);
    else
      vs_fail(vm, vm->sym.contract,
              "%s: in [%s %s] there is no predicate; [%s any? %s] gives %s a default and checks nothing", f, name.at,
              text.at, name.at, text.at, name.at);
    vs_condition *c = vs_is(vm->condition, VS_T_CONDITION) ? vs_as_condition(vm->condition) : NULL;
    /* the error gets the place of the caller, whose argument is wrong */
    if (c && predicate && vs_is_pair(c->chain) && vs_is_pair(vs_cdr(c->chain))) {
      do vs_gc_store(vm, c, &c->chain, vs_cdr(c->chain));
      while (vs_car(vs_car(c->chain)) == VS_TRUE && vs_is_pair(vs_cdr(c->chain)));
      c->place = vs_pos_of(vs_cdr(vs_car(c->chain)));
    }
  }
  vs_text_close(&name);
  vs_text_close(&text);
  return VS_ERROR;
}

static vs_status captures(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a, (void)n;
  *out = vs_captures(vm);
  return VS_OK;
}

static const vs_native_def defs[] = {
  { "call-with-current-continuation call/cc", "procedure", call_cc, 1,
    "call procedure with the rest of the computation" },
  { "%captures", "", captures, 0, NULL },
  { "%throw", "k value", throw_, 1, NULL },
  { "dynamic-wind", "before thunk after", dynamic_wind, 2,
    "call thunk between before and after, however it is entered and left" },
  { "values", ". v", values, 0, "several values" },
  { "call-with-values", "producer consumer", call_with_values, 1, "call consumer with producer's values" },
  { "apply", "procedure first . arguments", apply, -1, "call with the arguments in a list" },
  { "%apply-self", "procedure list this", apply_self, -1, NULL },
  { "%procedure-shape", "procedure", procedure_shape, 0, NULL },
  { "with-exception-handler", "handler thunk", with_exception_handler, 1,
    "call thunk; handler gets the object that thunk raises" },
  { "raise", "obj", raise_, 1, "raise obj to the handler in force" },
  { "raise-continuable", "obj", raise_continuable, 1, "raise obj; the handler's value comes back" },
  { "make-parameter", "value [converter]", make_parameter, 1, "a variable that parameterize sets for a while" },
  { "%parameterize", "parameters values thunk", parameterize, 2, NULL },
  { "make-promise", "value", make_promise, 0, "a promise that is kept already" },
  { "%lazy", "thunk", lazy, 0, NULL },
  { "%kept-promise", "value", kept_promise, 0, NULL },
  { "promise?", "v", is_promise, 0, NULL },
  { "force", "promise", force, 1, "the value of a promise" },
  { "any?", "v", any, 0, "true of everything" },
  { "%guarded", "predicate value", guarded, 1, NULL },
  { "%check", "predicate value contract", check, 1, NULL },
  { 0 }
};
const vs_native_table vs_control_natives = {"control", defs};
