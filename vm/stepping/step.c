/* Implements stops of a program: the check of each instruction in the stepping run loop, (break), and continuing.
 *
 * A step goes from one call in the program's own text to the next, in the order in which they are executed. Opcodes
 * that replace a call count as calls. An expression is shown when its operands have their values, such as (* 4 2), and
 * again with its result. Calls in the library do not stop.
 *
 * The level of an activation is its distance from the bottom of the stack, including the parts in the heap. The level
 * of a callee is greater than that of its caller. An activation that replaces another by a tail call has the same
 * level. Stepping over an expression skips all activations of greater levels until the expression has its value. */
#include "vm/stepping/step.h"

#include "vm/compiler/code.h"
#include "vm/front/environment.h"
#include "vm/machine/activation.h"

bool vs_is_stop(const vs_scheme *vm, vs_value condition) {
  return vs_is(condition, VS_T_CONDITION) && vs_as_condition(condition)->kind == vm->sym.stop;
}

/* ---- instructions that replace calls ---- */

static bool is_call(uint32_t op) {
  return op == VS_O_CALL || op == VS_O_CALLG || op == VS_O_TAIL || op == VS_O_TAILG || op == VS_O_CALLX ||
         vs_op_generic(op) != VS_O_NONE;
}

static bool is_tail_call(const uint32_t *ins) {
  uint32_t op = *ins & 255;
  return op == VS_O_TAIL || op == VS_O_TAILG || (op == VS_O_CALLX && VS_A(*ins));
}

static bool is_branch(uint32_t op) {
  int generic = vs_op_generic(op);
  return generic == VS_O_G_JABC || generic == VS_O_G_JAI || generic == VS_O_G_JA;
}

static uint32_t length_of(uint32_t op) { return 1 + vs_op_extra(op); }

/* Sets *out to the result of the call at index `call`, when the activation is about to run the instruction at index
 * `at`. Returns false if the call has no result that could be shown. */
static bool value_of(const vs_code *code, const vs_value *base, uint32_t call, uint32_t at, vs_value *out) {
  const uint32_t *ins = vs_code_ins(code) + call;
  uint32_t op = *ins & 255;
  switch (op) {
    case VS_O_CALL: case VS_O_CALLG: *out = base[VS_A(*ins)]; return true;
    case VS_O_CALLX: *out = base[ins[1]]; return !VS_A(*ins);
    default: break;
  }
  switch (vs_op_generic(op)) {
    case VS_O_G_JABC: case VS_O_G_JAI: case VS_O_G_JA: /* a conditional jump shows whether the call's result is true: it
                                                        * jumps if this truth equals operand C */
      *out = vs_bool((at != call + length_of(op)) == (bool)VS_C(*ins));
      return true;
    case VS_O_NONE: case VS_O_G_SET: case VS_O_G_SETV: case VS_O_G_RECSET: return false;
    default: *out = base[VS_A(*ins)]; return true;
  }
}

/* Gets the procedure, keywords and arguments of the call at ins. *args points to the activation's registers, or to
 * unused room after them. Returns the number of arguments. */
static size_t operands_of(const vs_code *code, vs_value *base, const uint32_t *ins, vs_value *procedure,
                          const vs_value **args, vs_value *keywords) {
  const vs_value *k = vs_code_consts(code);
  vs_value *room = base + code->registers;
  uint32_t op = *ins & 255, a = VS_A(*ins), b = VS_B(*ins), c = VS_C(*ins);
  VS_ASSERT(is_call(op));
  *keywords = VS_FALSE;
  *args = base + a + 2;
  switch (op) {
    case VS_O_CALL: case VS_O_TAIL: *procedure = base[a]; return b;
    case VS_O_CALLG: case VS_O_TAILG: *procedure = vs_as_cell(k[ins[1]])->value; return b;
    case VS_O_CALLX:
      *procedure = base[ins[1]];
      *args = base + ins[1] + 2;
      *keywords = ins[3] ? k[ins[3] - 1] : VS_FALSE;
      return ins[2];
    default: break;
  }
  *procedure = vs_as_cell(k[vs_code_inlined(code, (uint32_t)(ins - vs_code_ins(code)))])->value;
  *args = room;
  switch (vs_op_generic(op)) {
    case VS_O_G_ABC: case VS_O_G_ABC1: case VS_O_G_RECREF: room[0] = base[b]; room[1] = base[c];
        return vs_op_generic(op) == VS_O_G_RECREF ? 1 : 2;
    case VS_O_G_RECSET: room[0] = base[a]; room[1] = base[c]; return 2;
    case VS_O_G_AB: room[0] = base[b]; return 1;
    case VS_O_G_ABI: room[0] = base[b]; room[1] = vs_fix((int8_t)c); return 2;
    case VS_O_G_N: case VS_O_G_N1: *args = base + b; return c;
    case VS_O_G_JABC: room[0] = base[a]; room[1] = base[b]; return 2;
    case VS_O_G_JAI: room[0] = base[a]; room[1] = vs_fix((int8_t)b); return 2;
    case VS_O_G_JA: room[0] = base[a]; return 1;
    case VS_O_G_SET: case VS_O_G_SETV: room[0] = base[a]; room[1] = base[b]; room[2] = base[c]; return 3;
    default: return 0;
  }
}

/* ---- stopping a program ---- */

/* Creates the error object that represents a stop, without its continuation. of: roots of the garbage collector with
 * the called procedure or the value, the arguments and the keywords. */
static bool make_stop(vs_scheme *vm, vs_stop_kind kind, const vs_value *of, uint64_t level, bool tail) {
  VS_ROOTS(vm, r, 1);
  if (!vs_make_vector(vm, VS_STOP_WORDS, VS_FALSE, &r[0])) return false;
  vm->native = NULL;
  vs_fail(vm, vm->sym.stop, "stopped");
  if (!vs_is_stop(vm, vm->condition)) return false;
  vs_vector *v = vs_as_vector(r[0]);
  vs_gc_store(vm, v, &v->at[VS_STOP_KIND], vs_fix(kind));
  vs_gc_store(vm, v, &v->at[VS_STOP_SUBJECT], of[0]);
  vs_gc_store(vm, v, &v->at[VS_STOP_ARGUMENTS], of[1]);
  vs_gc_store(vm, v, &v->at[VS_STOP_KEYWORDS], of[2]);
  vs_gc_store(vm, v, &v->at[VS_STOP_LEVEL], vs_fix((int64_t)level));
  vs_gc_store(vm, v, &v->at[VS_STOP_TAIL], vs_bool(tail));
  vs_gc_store(vm, v, &v->at[VS_STOP_MODE], vs_fix(vm->step.mode));
  vs_gc_store(vm, v, &v->at[VS_STOP_TARGET], vs_fix((int64_t)vm->step.target));
  vs_gc_store(vm, vs_as_condition(vm->condition), &vs_as_condition(vm->condition)->payload, r[0]);
  return true;
}

/* Stores the continuation of the window w (procedure, return information, n arguments) in the stop vm->condition. */
static bool hold(vs_scheme *vm, vs_value *w, size_t n) {
  VS_ROOTS(vm, r, 1);
  VS_ASSERT(vs_is_stop(vm, vm->condition));
  r[0] = vm->condition;
  vs_value k;
  if (!vs_activation_capture(vm, w, n, &k)) return false;
  vs_vector *v = vs_as_vector(vs_as_condition(r[0])->payload);
  vs_gc_store(vm, v, &v->at[VS_STOP_CONTINUATION], k);
  vm->condition = r[0];
  return true;
}

/* The position at which an activation stops. at: index of the instruction that runs next; shown: index of the
 * instruction that the host shows. */
typedef struct { vs_value *base; uint32_t at, shown; uint64_t level; } stopped;

static vs_step_verdict stop(vs_scheme *vm, const stopped *s, vs_stop_kind kind, vs_value subject) {
  vs_value *base = s->base;
  uint32_t at = s->at;
  const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
  const uint32_t *ins = vs_code_ins(code);
  VS_ROOTS(vm, r, 3);
  r[0] = subject; r[1] = VS_NIL; r[2] = VS_FALSE;
  vm->base = base; vm->pc = ins + s->shown + 1; vm->top = base + code->registers;
  if (kind == VS_STOP_CALL) {
    const vs_value *args;
    vs_value keywords;
    size_t n = operands_of(code, base, ins + at, &r[0], &args, &keywords);
    r[2] = keywords;
    if (args == vm->top) vm->top += n;
    for (size_t i = n; i-- > 0;)
      if (!vs_cons(vm, args[i], r[1], &r[1])) return VS_LOOK_FAILED;
    vm->top = base + code->registers;
  }
  if (!make_stop(vm, kind, r, s->level, kind == VS_STOP_CALL && is_tail_call(ins + at))) return VS_LOOK_FAILED;
  vs_value *w = base + code->registers;
  w[0] = VS_FALSE;
  w[1] = vs_ret_make(code->registers, at);
  hold(vm, w, 0);       /* if memory is out, no handler can catch the error, since the activations may already be in the
                         * heap */
  return VS_LOOK_STOP;
}

/* Returns true if the instruction at index `at` comes from the program's own text. */
static bool is_own(const vs_scheme *vm, const vs_code *code, uint32_t at) {
  return vs_pos_file(vs_code_place(code, at)) >= vm->step.first_file;
}

/* Returns true for a call that syntax of the library has inserted: the name of its procedure begins with %. */
static bool is_hidden(const vs_code *code, const uint32_t *ins) {
  if ((*ins & 255) != VS_O_CALLG && (*ins & 255) != VS_O_TAILG) return false;
  vs_value name = vs_as_cell(vs_code_consts(code)[ins[1]])->name;
  return vs_is_symbol(name) && vs_as_symbol(name)->name[0] == '%';
}

/* Returns true for a call in the program's own text. */
static bool is_written(const vs_scheme *vm, const vs_code *code, const uint32_t *ins) {
  return is_call(*ins & 255) && is_own(vm, code, (uint32_t)(ins - vs_code_ins(code))) && !is_hidden(code, ins);
}

vs_step_verdict vs_step_look(vs_scheme *vm, vs_value *base, const uint32_t *pc) {
  vs_stepping *s = &vm->step;
  const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
  const uint32_t *ins = vs_code_ins(code);
  uint32_t at = (uint32_t)(pc - ins), before = s->seen_at;
  uint64_t level = vs_activation_level(vm, base);
  bool returned = s->seen_level > level, same = s->seen_level == level && s->seen_code == code;
  uint8_t told = s->told;
  s->seen_level = level, s->seen_code = code, s->seen_at = at;
  s->told = VS_TOLD_NOTHING;
  if (level > s->target) return VS_LOOK_GO;
  if (told < VS_TOLD_VALUE && (returned || same)) {
    vs_value v;
    if (returned) before = at ? vs_code_place_start(code, at - 1) : 0;
    uint32_t op = ins[before] & 255;
    bool done = at > before && (returned || at == before + length_of(op) || is_branch(op));
    if (done && is_written(vm, code, ins + before) && value_of(code, base, before, at, &v) && v != VS_UNSPECIFIC)
      return stop(vm, &(stopped){base, at, before, level}, VS_STOP_VALUE, v);
  }
  if (told < VS_TOLD_CALL && is_written(vm, code, pc))
    return stop(vm, &(stopped){base, at, at, level}, VS_STOP_CALL, VS_FALSE);
  return VS_LOOK_GO;
}

/* ---- (break) ---- */

static vs_status break_(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)a; (void)n; (void)out;
  if (!vm->step.stops) {
    if (vm->config.suspect && !vm->step.passes) vm->config.suspect(vm, "break",
        "(break) stops a program at the prompt only: start it with vs -i FILE, or by ,run FILE at the prompt");
    return VS_OK;
  }
  VS_ROOTS(vm, r, 3);
  r[0] = r[2] = VS_FALSE; r[1] = VS_NIL;
  uint64_t level = vs_activation_level(vm, vm->base) - 2 - vs_ret_distance(vm->base[-1]);
  return make_stop(vm, VS_STOP_BREAK, r, level, false) && hold(vm, vm->base - 2, (size_t)(vm->top - vm->base)) ?
      VS_UNCAUGHT : VS_ERROR;
}

/* ---- continuing a program ---- */

static vs_status resume(vs_scheme *vm, vs_value *a, int n, vs_value *out) {
  (void)n;
  vs_call_begin(vm, a[0]);        /* resumes without the `before` procedures of dynamic-wind, since the program has not
                                   * left any */
  *out = VS_UNSPECIFIC;
  return VS_THROW;
}

static const vs_native_def defs[] = {
  {"%break", "", break_, 1, NULL},
  {"%resume", "stop", resume, 1, NULL},
  {0}
};
const vs_native_table vs_step_natives = {"step", defs};
