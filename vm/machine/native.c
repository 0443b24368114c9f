/* Registers natives as procedure objects, and stores the calls that natives request from the run loop. */
#include "vm/machine/native.h"

#include "vm/compiler/inline.h"
#include "vm/machine/signature.h"

/* ---- creating procedures ---- */
/* Creates a procedure object for def. `symbol` is one of the names in def, which the procedure's errors show. */
static bool native_make(vs_scheme *vm, const vs_native_def *def, vs_value symbol, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  vs_signature g = vs_signature_read(def->signature);
  r[0] = symbol; r[1] = VS_FALSE;
  if (g.keywords && !vs_make_vector(vm, g.keywords, VS_FALSE, &r[1])) return false;
  const char *text = def->signature, *name;
  size_t length;
  int depth = 0;
  uint32_t k = 0;
  for (vs_signature_kind kind; (kind = vs_signature_next(&text, &depth, &name, &length)) != VS_SIG_END;)
    if (kind == VS_SIG_KEYWORD) {
      vs_value keyword;
      if (!vs_intern(vm, name, length, &keyword)) return false;
      vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[k++], keyword);
    }
  vs_native *n = (vs_native *)(void *)vs_gc_alloc_old(vm, VS_T_NATIVE, VS_WORDS(vs_native));
  if (!n) return false;
  n->def = def;
  n->min = g.required;
  n->max = g.rest ? UINT32_MAX : g.required + g.optional;
  n->name = r[0]; n->keywords = r[1];
  vs_inline_find(vm, def->name, strcspn(def->name, " "), &n->inlined, &n->inlined_arg);
  *out = vs_from_object(n);
  return true;
}

bool vs_native_define(vs_scheme *vm, const vs_native_table *table,
                      bool (*define)(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure),
                      void *context) {
  VS_ROOTS(vm, r, 2);
  for (const vs_native_def *def = table->defs; def->name; def++) {
    for (const char *s = def->name; *s;) {
      size_t n = strcspn(s, " ");
      if (!vs_intern(vm, s, n, &r[1]) || !native_make(vm, def, r[1], &r[0]) || !define(vm, context, r[1], r[0]))
        return false;
      s += n;
      while (*s == ' ') s++;
    }
  }
  return true;
}

/* ---- parameter objects ---- */
vs_value vs_parameter_value(const vs_scheme *vm, vs_value parameter) {
  for (vs_value l = vm->parameters; vs_is_pair(l); l = vs_cdr(l))
    if (vs_car(vs_car(l)) == parameter) return vs_cdr(vs_car(l));
  return vs_as_parameter(parameter)->value;
}

/* ---- calls that natives request ---- */
void vs_call_begin(vs_scheme *vm, vs_value procedure) {
  vm->call_procedure = procedure;
  vm->call_count = 0;
  vm->call_self = false;
}

bool vs_call_push(vs_scheme *vm, vs_value v) {
  VS_ASSERT(vm->call_count <= vm->call_room);
  if (vm->call_count == vm->call_room) {
    size_t room = vm->call_room ? vm->call_room * 2 : 16;
    vs_value *p = vs_mem(vm, vm->call_args, vm->call_room * sizeof *p, room * sizeof *p);
    if (!p) return false;
    vm->call_args = p;
    vm->call_room = room;
  }
  vm->call_args[vm->call_count++] = v;
  return true;
}

static bool prepare(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  vs_call_begin(vm, procedure);
  for (size_t i = 0; i < n; i++)
    if (!vs_call_push(vm, argv[i])) return false;
  return true;
}

vs_status vs_call(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  return prepare(vm, procedure, n, argv) ? VS_CALL : VS_ERROR;
}

vs_status vs_tailcall(vs_scheme *vm, vs_value procedure, size_t n, const vs_value *argv) {
  return prepare(vm, procedure, n, argv) ? VS_TAILCALL : VS_ERROR;
}
