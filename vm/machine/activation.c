/* Moves activations (frames of running calls) between the working part of the stack and the heap, and walks over them
 * for error messages. */
#include "vm/machine/activation.h"

#include <stdio.h>

#include "vm/compiler/code.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"
#include "vm/machine/native.h"
#include "vm/front/source.h"

/* A walk over activations, innermost first. It contains addresses, so nothing may allocate Scheme objects while it is
 * used. */
struct walk { const vs_value *base; vs_value under; uint64_t depth; bool force; };

/* Goes from the current activation to its caller's. Sets *pc to the position of the call in the caller's code. Sets
 * *native to true if the caller is a native. Returns false at the end of the stack. */
static bool walk_up(struct walk *w, size_t *pc, bool *native) {
  vs_value ret = w->base[-1];
  if (ret & VS_RET_STOP) return false;
  size_t size = vs_ret_distance(ret) + 2;
  *pc = vs_ret_pc(ret);
  if (ret & VS_RET_GENERIC) ++*pc;
  *native = (ret & VS_RET_NATIVE) != 0;
  if (ret & VS_RET_UNDER || w->force) {
    if (!vs_is(w->under, VS_T_STACK)) return false;
    const vs_stack *s = vs_as_stack(w->under);
    uint64_t first = w->depth - size;
    w->base = s->at + first + 2;
    w->force = first != 0;
    if (first == 0) { w->under = s->under; w->depth = s->depth; }
    else w->depth = first;
  } else {
    w->base -= size;
  }
  return true;
}

struct link { vs_value name; vs_pos place; const vs_value *base; size_t pc; bool gap;
    /* whether, between this activation and the one listed before, there were calls that ended with a tail call and left
     * no activation */ };

/* Returns true if a procedure between a caller and `running`, the next inner activation, has ended with a tail call.
 * The instruction before pc then calls another procedure than `running`. Tests only calls by global names of the
 * program. */
static bool ended_in_tail_call(const vs_code *code, size_t pc, vs_value running) {
  const uint32_t *ins = vs_code_ins(code);
  if (pc < 2 || (ins[pc - 2] & 255) != VS_O_CALLG || ins[pc - 1] >= vs_as_vector(code->consts)->length ||
      !vs_is(running, VS_T_CLOSURE))
    return false;
  vs_value cell = vs_code_consts(code)[ins[pc - 1]];
  if (!vs_is(cell, VS_T_CELL) || vs_object_of(cell)->flags & VS_F_CONSTANT) return false;
  vs_value called = vs_as_cell(cell)->value;
  if (vs_is(called, VS_T_CLOSURE)) return vs_as_closure(called)->code != vs_as_closure(running)->code;
  if (!vs_is(called, VS_T_CASE)) return false;
  for (uint64_t i = 0; i < vs_as_case(called)->count; i++)
    if (vs_as_closure(vs_as_case(called)->clause[i])->code == vs_as_closure(running)->code) return false;
  return true;
}

static size_t chain(vs_scheme *vm, struct link *at, size_t max) {
  if (!vm->base) return 0;
  struct walk w = {vm->base, vm->under, vm->under_depth, false};
  size_t count = 0, pc = 0;
  vs_value above = VS_FALSE;
  bool native = !vm->pc || !vs_is(w.base[-2], VS_T_CLOSURE);
  if (!native) pc = (size_t)(vm->pc - vs_code_ins(vs_as_code(vs_as_closure(w.base[-2])->code)));
  do {
    vs_value running = above;
    above = w.base[-2];
    if (native || !vs_is(w.base[-2], VS_T_CLOSURE)) continue;
    const vs_code *code = vs_as_code(vs_as_closure(w.base[-2])->code);
    at[count].name = code->name;
    at[count].base = w.base;
    at[count].gap = ended_in_tail_call(code, pc, running);
    at[count].pc = pc ? pc - 1 : 0;
    at[count].place = vs_code_place(code, (uint32_t)at[count].pc);
    count++;
  } while (count < max && walk_up(&w, &pc, &native));
  return count;
}

/* Called when memory is out. Makes the call whose registers begin at w the innermost activation, so that the call chain
 * of the error begins with its caller. Returns NULL. */
static vs_value *flush_failed(vs_scheme *vm, vs_value *w) {
  vm->base = w + 2;
  vm->pc = NULL;
  return NULL;
}

/* Returns the greatest number of stack slots for nested calls that are not tail calls. The usual limit, 1 GB, suffices
 * for about 20 million calls; if memory is limited, nested calls may use a third of it. */
static size_t most_slots(const vs_scheme *vm) {
  if (vm->config.stack_limit) return vm->config.stack_limit / sizeof(vs_value);
  size_t bytes = (size_t)(sizeof(void *) < 8 ? 256 : 1024) << 20;
  if (vm->config.memory_limit && vm->config.memory_limit / 3 < bytes) bytes = vm->config.memory_limit / 3;
  return bytes / sizeof(vs_value);
}

/* Writes the number of running calls to text, in words: "21 million", or "96 thousand". */
static void say_depth(vs_scheme *vm, char *text, size_t room) {
  struct walk w = {vm->base, vm->under, vm->under_depth, false};
  uint64_t depth = 1;
  size_t pc;
  bool native;
  VS_ASSERT(vm->base);
  while (walk_up(&w, &pc, &native)) depth++;
  bool millions = depth >= 1000000;
  snprintf(text, room, "%llu %s", (unsigned long long)depth / (millions ? 1000000 : 1000),
           millions ? "million" : "thousand");
}

/* Reports a recursion that is probably endless. The message names the procedure that is most frequent among the
 * innermost callers. */
static bool fail_endless(vs_scheme *vm) {
  enum { MOST = 64 };
  struct link at[MOST];
  size_t n = chain(vm, at, MOST), best = 0, most = 0, others = 0;
  for (size_t i = 0; i < n; i++) {
    size_t times = 0;
    for (size_t k = i; k < n; k++) times += at[k].name == at[i].name;
    if (vs_is_symbol(at[i].name) && times > most) best = i, most = times;
  }
  for (size_t i = 0; i < n; i++) others += at[i].name != at[best].name && vs_is_symbol(at[i].name) && !others;
  const char *name = most ? vs_source_said(vm, vs_as_symbol(at[best].name)->name, at[best].place) : "a procedure";
  char depth[40];
  say_depth(vm, depth, sizeof depth);
  vm->native = NULL;
  return vs_fail(vm, vm->sym.recursion,
      "%s calls itself here%s, %s calls deep; is there an `if` that stops it? --limit-stack allows deeper calls", name,
      others ? " by way of others" : "", depth);
}

vs_value *vs_activation_flush(vs_scheme *vm, vs_value *w, size_t n, size_t need) {
  size_t count = (size_t)(w - vm->stack);
  VS_ASSERT(w >= vm->stack && w + 2 + n <= vm->stack_end);
  vm->top = w + 2 + n;
  size_t below = (size_t)vs_slots_below(vm);
  if (below + count > most_slots(vm)) {
    flush_failed(vm, w);
    fail_endless(vm);
    return NULL;
  }
  if (count) {
    vs_stack *s = (vs_stack *)(void *)vs_gc_alloc(vm, VS_T_STACK, VS_WORDS(vs_stack) + count);
    if (!s) return flush_failed(vm, w);
    s->under = vm->under; s->depth = vm->under_depth; s->count = count; s->total = below + count;
    memcpy(s->at, vm->stack, count * sizeof *s->at);
    w[1] |= VS_RET_UNDER;
    vm->under = vs_from_object(s);
    vm->under_depth = count;
    memmove(vm->stack, w, (2 + n) * sizeof *w);
    w = vm->stack;
    vm->top = w + 2 + n;
  }
  size_t room = (size_t)(vm->stack_end - vm->stack);
  if (need + VS_ACTIVATION_SLACK > room) {
    size_t more = need + need / 2 + VS_ACTIVATION_SLACK;
    vs_value *stack = vs_mem(vm, vm->stack, room * sizeof *stack, more * sizeof *stack);
    if (!stack) return flush_failed(vm, w);
    vm->stack = stack;
    vm->stack_end = stack + more;
    vm->top = stack + 2 + n;
    memset(stack + room, 0, (more - room) * sizeof *stack);
  }
  return vm->stack;
}

bool vs_activation_capture(vs_scheme *vm, vs_value *w, size_t n, vs_value *out) {
  if (!vs_activation_flush(vm, w, n, 16)) return false;
  vm->base = vm->stack + 2;
  vs_continuation *k = (vs_continuation *)(void *)vs_gc_alloc(vm, VS_T_CONTINUATION, VS_WORDS(vs_continuation));
  if (!k) return false;
  k->stack = vm->under; k->depth = vm->under_depth;
  k->winders = vm->winders; k->handlers = vm->handlers; k->parameters = vm->parameters;
  k->ret = vm->base[-1];
  *out = vs_from_object(k);
  return true;
}

bool vs_call_chain(vs_scheme *vm, size_t max, vs_value *out) {
  enum { MOST = 64 };
  struct link at[MOST];
  size_t n = chain(vm, at, max < MOST ? max : MOST);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  while (n--)        /* writes the procedures' names; symbols do not move */
    if (!vs_cons(vm, at[n].name, vs_fix((int64_t)at[n].place), &r[1]) || !vs_cons(vm, r[1], r[0], &r[0]) ||
        (at[n].gap && (!vs_cons(vm, VS_TRUE, vs_fix(0), &r[1]) || !vs_cons(vm, r[1], r[0], &r[0])))) return false;
  *out = r[0];
  return true;
}

/* Adds the variable `name` of a call with the value x to the vector v, if there is room. If several variables have one
 * name, the innermost is added. A captured variable is added only if no other variable has its name. */
static void note_variable(vs_scheme *vm, vs_vector *v, vs_value *call, vs_value name, vs_value x, bool captured) {
  if (vs_is(x, VS_T_BOX)) x = vs_as_box(x)->value; /* an assigned variable is in a box */
  if (!vs_is_symbol(name) || x == VS_UNDEFINED || x == VS_ABSENT || vs_is(x, VS_T_STACK)) return;
  vs_value *to = call + VS_CALL_VARIABLES, *end = call + VS_CALL_WORDS;
  while (to < end && vs_is_symbol(to[0]) && to[0] != name) to += 2;
  if (to == end || (captured && to[0] == name)) return;
  vs_gc_store(vm, v, &to[0], name);
  vs_gc_store(vm, v, &to[1], x);
}

/* Sets *out to a vector with VS_CALL_WORDS elements for each running call, innermost first: the procedure, its place as
 * a fixnum, then names and values of variables. The name #f ends the variables. */
bool vs_call_variables(vs_scheme *vm, vs_value *out) {
  enum { MOST = 24 };
  struct link at[MOST];
  VS_ROOTS(vm, r, 1);
  if (!vs_make_vector(vm, MOST * VS_CALL_WORDS, VS_FALSE, &r[0])) return false;
  size_t n = chain(vm, at, MOST);
  vs_vector *v = vs_as_vector(r[0]);
  for (size_t i = 0; i < n; i++) {
    vs_value *to = v->at + i * VS_CALL_WORDS;
    const vs_closure *closure = vs_as_closure(at[i].base[-2]);
    const vs_code *code = vs_as_code(closure->code);
    const vs_vector *params = vs_as_vector(code->params), *more = vs_code_variables(code);
    vs_gc_store(vm, v, &to[VS_CALL_PROCEDURE], at[i].base[-2]);
    vs_gc_store(vm, v, &to[VS_CALL_PLACE], vs_fix((int64_t)at[i].place));
    size_t keywords = (size_t)code->required + code->optional; /* keyword parameters are in the table of variables, by
                                                                * their variables' names */
    for (size_t k = 0; k < params->length; k++)
      if (k < keywords || k >= keywords + code->keywords) note_variable(vm, v, to, params->at[k], at[i].base[k], false);
    for (const vs_value *x = more ? more->at : NULL; more && x < more->at + more->length; x += VS_VARIABLE_WORDS) {
      int64_t where = vs_fixnum(x[1]);
      if (at[i].pc < (size_t)vs_fixnum(x[2]) || at[i].pc >= (size_t)vs_fixnum(x[3])) continue;
      note_variable(vm, v, to, x[0], where < 0 ? closure->free[-1 - where] : at[i].base[where], where < 0);
    }
  }
  return *out = r[0], true;
}

size_t vs_call_links(vs_scheme *vm, vs_value *name, vs_pos *place, size_t max) {
  enum { MOST = 200 };
  struct link at[MOST];
  size_t n = chain(vm, at, max < MOST ? max : MOST);
  for (size_t i = 0; i < n; i++) {
    name[i] = at[i].name;
    place[i] = vs_code_near_place(vs_as_code(vs_as_closure(at[i].base[-2])->code), (uint32_t)at[i].pc);
  }
  return n;
}

size_t vs_call_places(vs_scheme *vm, vs_pos *place, size_t max) {
  enum { MOST = 64 };
  struct link at[MOST];
  size_t n = chain(vm, at, max < MOST ? max : MOST);
  for (size_t i = 0; i < n; i++) place[i] = at[i].place;
  return n;
}

void vs_see_activations(vs_scheme *vm, vs_see_activation_fn *see, void *to) {
  if (!vm->base) return;
  struct walk w = {vm->base, vm->under, vm->under_depth, false};
  size_t pc = 0;
  bool native = !vm->pc || !vs_is(w.base[-2], VS_T_CLOSURE), more;
  if (!native) pc = (size_t)(vm->pc - vs_code_ins(vs_as_code(vs_as_closure(w.base[-2])->code)));
  do {
    vs_pos place = 0;
    if (!native && vs_is(w.base[-2], VS_T_CLOSURE))
      place = vs_code_place(vs_as_code(vs_as_closure(w.base[-2])->code), (uint32_t)(pc ? pc - 1 : 0));
    more = see(to, w.base[-2], w.base, place);
  } while (more && walk_up(&w, &pc, &native));
}

uint64_t vs_call_key(vs_scheme *vm, size_t max) {
  if (!vm->base) return 0;
  struct walk w = {vm->base, vm->under, vm->under_depth, false};
  size_t count = 0, pc = 0;
  uint64_t key = max;
  bool native = !vm->pc || !vs_is(w.base[-2], VS_T_CLOSURE), up = true;
  if (!native) pc = (size_t)(vm->pc - vs_code_ins(vs_as_code(vs_as_closure(w.base[-2])->code)));
  while (up && count < max) {
    if (!native && vs_is(w.base[-2], VS_T_CLOSURE)) {
      key = (key ^ vs_as_closure(w.base[-2])->code ^ (uint64_t)pc << 48) * UINT64_C(0x9E3779B97F4A7C15);
      key ^= key >> 29;
      count++;
    }
    vs_value ret = w.base[-1];
    if (w.force || ret & VS_RET_FLAGS) {
      up = walk_up(&w, &pc, &native);
    } else { /* most calls return to compiled code in the working part of the stack, where walk_up need not be called */
      pc = vs_ret_pc(ret);
      native = false;
      w.base -= vs_ret_distance(ret) + 2;
    }
  }
  return key;
}

vs_pos vs_call_place(vs_scheme *vm) {
  struct link at[1];
  return chain(vm, at, 1) ? at[0].place : 0;
}

const vs_traceback vs_call_traceback = { vs_call_chain, vs_call_variables, vs_call_place };
