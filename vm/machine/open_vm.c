/* Creates and frees interpreters. The program that embeds them loads their libraries afterwards. */
#include "vm/machine/open_vm.h"

#include <stdlib.h>

#include "vm/compiler/coverage.h"
#include "vm/machine/activation.h"
#include "vm/values/gc.h"
#include "vm/machine/image.h"
#include "vm/machine/native.h"
#include "vm/values/heap.h"

extern const vs_native_table vs_control_natives;

#if VS_DEBUG_SMALL
enum { STACK_SLOTS = 1024 };
#else
enum { STACK_SLOTS = 8 << 10 };
#endif

/* If a new native is one that the run loop itself calls, stores it in vm->at. */
static bool keep(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure) {
  (void)context;
  const char *name = vs_as_symbol(symbol)->name;
  if (strcmp(name, "raise") == 0) vm->at.raise = procedure;
  if (strcmp(name, "%check") == 0) vm->at.check = procedure;
  if (strcmp(name, "%throw") == 0) vm->at.throw = procedure;
  if (strcmp(name, "%guarded") == 0) vm->at.guarded = procedure;
  return true;
}

static bool fresh(vs_scheme *vm) {
  VS_ROOTS(vm, r, 1);
#define S(field, text) && vs_intern_c(vm, text, &vm->sym.field)
  if (!(true VS_SYMBOLS(S))) return false;
#undef S
  if (!vs_string_from_utf8(vm, "out of memory", 13, &r[0])) return false;
  vs_condition *c = (vs_condition *)(void *)vs_gc_alloc(vm, VS_T_CONDITION, VS_WORDS(vs_condition));
  if (!c) return false;
  c->kind = vm->sym.memory; c->message = r[0]; c->irritants = c->chain = VS_NIL; c->payload = c->calls = VS_FALSE;
  vm->at.no_memory = vs_from_object(c);
  return vs_make_vector(vm, 1, VS_FALSE, &vm->at.files) && vs_make_keywords(vm, &vm->sym.self, 1, &vm->at.self_call) &&
         vs_native_define(vm, &vs_control_natives, keep, NULL);
}

vs_scheme *vs_open_vm(const vs_config *config) {
  vs_scheme *vm = config->memory ? config->memory(config->user, NULL, 0, sizeof *vm) : malloc(sizeof *vm);
  if (!vm) return NULL;
  memset(vm, 0, sizeof *vm);
  vm->config = *config;
  vm->bytes = sizeof *vm;
  vm->fuel = 1 << 20;                         /* fuel (number of turns until the next check of limits), enough until a
                                               * program runs; no limits apply before */
  vm->under = vm->call_procedure = vm->condition = vm->value = VS_FALSE;
  vm->winders = vm->handlers = vm->parameters = VS_NIL;
#define S(field, text) vm->sym.field = VS_FALSE;
  VS_SYMBOLS(S)
#undef S
#define A(field) vm->at.field = VS_FALSE;
  VS_ANCHORS(A)
#undef A
  vm->stack = vs_mem(vm, NULL, 0, STACK_SLOTS * sizeof *vm->stack);
  if (vm->stack) {
    vm->stack_end = vm->stack + STACK_SLOTS;
    vm->top = vm->stack;
    memset(vm->stack, 0, STACK_SLOTS * sizeof *vm->stack);       /* zeroes the stack, since the garbage collector visits
                                                                  * slots before they are written */
  }
  vm->traceback = &vs_call_traceback;
  if (!vm->stack || !vs_gc_open(vm) || !(config->image ? vs_image_load(vm, config->image) : fresh(vm))) {
    vs_close_vm(vm);
    return NULL;
  }
  return vm;
}

static void close_contents(vs_scheme *vm) {
  vs_gc_close(vm);
  if (vm->stack) vs_mem(vm, vm->stack, (size_t)((char *)vm->stack_end - (char *)vm->stack), 0);
  if (vm->call_args) vs_mem(vm, vm->call_args, vm->call_room * sizeof *vm->call_args, 0);
  vs_cover_close(vm);
  if (vm->flat) vs_mem(vm, vm->flat, sizeof *vm->flat, 0);
}

static void free_shell(vs_scheme *vm) {
  if (vm->config.memory) vm->config.memory(vm->config.user, vm, sizeof *vm, 0);
  else free(vm);
}

void vs_close_vm(vs_scheme *vm) {
  if (!vm) return;
  close_contents(vm);
  free_shell(vm);
}

void vs_replace_vm(vs_scheme *vm, vs_scheme *fresh) {
  close_contents(vm);
  *vm = *fresh;
  free_shell(fresh);
}

bool vs_flat_register(vs_scheme *vm, const vs_flat_rules *rules) {
  if (!vm->flat && !(vm->flat = vs_mem(vm, NULL, 0, sizeof *vm->flat))) return false;
  *vm->flat = *rules;
  return true;
}
