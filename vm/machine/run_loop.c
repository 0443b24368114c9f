/* Implements the run loop: instructions, calls, returns, and the handling of errors. activation.h describes the stack.
 *
 * The registers of the virtual machine are C variables: base (the registers of the current activation), pc, k (its
 * constants). SAVE stores them before code that can allocate or fail. After code that can allocate, values are read
 * again from registers; code and constants do not move.
 *
 * step_loop.c compiles the loop a second time, with VS_STEPPING, for programs that are stepped through (step.h). The
 * second loop checks every instruction before running it, and other programs run at full speed. */
#ifndef VS_STEPPING
#define VS_STEPPING 0
#endif
#include "vm/machine/run_loop.h"

#include <math.h>
#include <stdio.h>

#include "vm/machine/arguments.h"
#include "vm/compiler/each.h"
#include "vm/compiler/code.h"
#include "vm/compiler/coverage.h"
#include "vm/compiler/inline_arithmetic.h"
#include "vm/machine/activation.h"
#include "vm/machine/poll.h"
#include "vm/machine/record_call.h"
#include "vm/machine/run_failures.h"
#include "vm/stepping/step.h"
#include "vm/stepping/step_loop.h"
#include "vm/values/heap.h"
#include "vm/values/string_chars.h"

/* ---- functions for rare cases ---- */
/* Returns true if the code at pc, to which a call returns, accepts several values: it ignores them or returns them. */
static bool takes_several(const uint32_t *pc) {
  uint32_t op = *pc & 255;
  return op == VS_O_DROP || op == VS_O_RETURN || (op == VS_O_MORE && VS_B(*pc)) ||
         (op == VS_O_FARLOAD && ((pc[1] & 255) == VS_O_DROP || (pc[1] & 255) == VS_O_RETURN));
}

static bool make_closure(vs_scheme *vm, vs_value *base, const vs_value *k, const uint32_t *captures, vs_value code,
                         vs_value *out) {
  (void)k;
  size_t n = vs_as_code(code)->free;
  vs_closure *c = (vs_closure *)(void *)vs_gc_alloc(vm, VS_T_CLOSURE, VS_WORDS(vs_closure) + n);
  if (!c) return false;
  const vs_closure *self = vs_as_closure(base[-2]);
  c->code = code;
  for (size_t i = 0; i < n; i++)
    c->free[i] = captures[i] >> 16 ? self->free[captures[i] & 0xFFFF] : base[captures[i] & 0xFFFF];
  *out = vs_from_object(c);
  return true;
}

static bool make_case(vs_scheme *vm, const vs_value *at, size_t n, vs_value *out) {
  vs_case *c = (vs_case *)(void *)vs_gc_alloc(vm, VS_T_CASE, VS_WORDS(vs_case) + n);
  if (!c) return false;
  c->count = n;
  memcpy(c->clause, at, n * sizeof *at);
  *out = vs_from_object(c);
  return true;
}

#if VS_DEBUG_TRACE
static void trace(const uint32_t *ins, const vs_value *base) {
  static const char *const names[] = {
#define VS_OP(name, operands, extra, generic) #name,
#include "vm/compiler/opcodes.def"
#undef VS_OP
  };
  fprintf(stderr, "%p %-10s %u %u %u\n", (const void *)base, names[*ins & 255], VS_A(*ins), VS_B(*ins), VS_C(*ins));
}
#else
#define trace(ins, base) ((void)0)
#endif

/* Runs the call in the window w (procedure, free slot, n arguments), at the start of the stack, until it returns. */
static bool loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out) {
  vs_value *base = w;                 /* the activation's registers; no activation exists before the first call */
  const uint32_t *pc = NULL, *start = NULL;      /* start: first instruction of the activation's code */
  vs_value *k = NULL;
  vs_value ret = VS_TAG_FIXNUM << 48 | VS_RET_STOP, kw = VS_FALSE, v;
  bool tail = false;
  uint32_t ins = 0;
  vs_status status;
  VS_ASSERT(w == vm->stack);

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"      /* the loop jumps to addresses of labels, an extension of GCC */
  static const void *const labels[] = {
#define VS_OP(name, operands, extra, generic) &&op_##name,
#include "vm/compiler/opcodes.def"
#undef VS_OP
  };
#if VS_STEPPING
#define NEXT goto look
#else
#define NEXT do { trace(pc, base); ins = *pc++; goto *labels[ins & 255]; } while (0)
#endif
#define OP(name) op_##name
#define A VS_A(ins)
#define B VS_B(ins)
#define C VS_C(ins)
#define BX VS_BX(ins)
#define RA base[A]
#define RB base[B]
#define RC base[C]
#define IMM_B vs_fix((int8_t)B)
#define IMM_C vs_fix((int8_t)C)
#define REGISTERS (vs_as_code(vs_as_closure(base[-2])->code)->registers)
#define SAVE (vm->base = base, vm->pc = pc, vm->top = base + REGISTERS, vm->native = NULL)
#define BRANCH_IF(truth) do { if ((truth) == (bool)C) pc += (int32_t)*pc + 1; else pc++; NEXT; } while (0)

/* Removes the value of #:this, the object of a method call, from the arguments if the procedure w[0] has no such
 * parameter. Calls without keywords skip this. */
#define LEAVE_SELF do {                                                                                    \
    if (vs_is_object(w[0]) && vs_leaves_self(vm, w[0], kw)) n--, kw = VS_FALSE;                            \
  } while (0)

/* Returns true if a closure is called with exactly its required arguments, and the stack has room for it. All other
 * calls continue at the label `call`. */
#define PLAIN(callee, count, at)                                                                           \
  ((callee)->flags & VS_CODE_SIMPLE && (callee)->required == (count) &&                                    \
   (const char *)vm->stack_end - (const char *)(at) >=                                                     \
       (ptrdiff_t)(((size_t)(callee)->registers + 2 + VS_ACTIVATION_SLACK) * sizeof(vs_value)))
#define CALLEE(f) vs_as_code(vs_as_closure(f)->code)
#define RUN_CODE(code) (start = vs_code_ins(code), k = vs_code_consts(code))
#define ENTER(callee) do {                                                                                 \
    RUN_CODE(callee);                                                                                      \
    pc = start;                                                                                            \
    if (--vm->fuel <= 0) { SAVE; if (!vs_poll_limits(vm)) goto fail; }                                         \
    NEXT;                                                                                                  \
  } while (0)
#define HERE ((size_t)(pc - start))
#define CALL_WINDOW do {                                                                                   \
    w = &RA; n = B;                                                                                        \
    if (vs_is(w[0], VS_T_CLOSURE)) {                                                                       \
      const vs_code *callee = CALLEE(w[0]);                                                                \
      if (PLAIN(callee, n, w)) { w[1] = vs_ret_make(A, HERE); base = w + 2; ENTER(callee); }               \
      if (callee->flags & VS_CODE_RECORD) goto call_record;                                                \
    } else if (vs_is(w[0], VS_T_CASE)) {                                                                   \
      goto call_case;                                                                                      \
    }                                                                                                      \
    ret = vs_ret_make(A, HERE); kw = VS_FALSE; tail = false;                                               \
    goto call;                                                                                             \
  } while (0)
#define TAIL_WINDOW do {                                                                                   \
    w = &RA; n = B;                                                                                        \
    if (vs_is(w[0], VS_T_CLOSURE)) {                                                                       \
      const vs_code *callee = CALLEE(w[0]);                                                                \
      if (PLAIN(callee, n, base - 2)) {                                                                    \
        base[-2] = w[0];                                                                                   \
        for (size_t i = 0; i < n; i++) base[i] = w[2 + i];                                                 \
        ENTER(callee);                                                                                     \
      }                                                                                                    \
    }                                                                                                      \
    kw = VS_FALSE; tail = true;                                                                            \
    goto call;                                                                                             \
  } while (0)

#define DROPPED(v) do {                                                                                    \
    if (vm->config.dropped) {                                                                              \
      vs_value first = vs_is_pair(v) ? vs_as_pair(v)->car : (v); /* also reports a foreign object at the start of an
                                                                  * unused list */ \
      if (vs_is(first, VS_T_FOREIGN)) vm->config.dropped(vm, first);                                       \
    }                                                                                                      \
  } while (0)

  goto call;

#if VS_STEPPING
look:
  trace(pc, base);
  ins = *pc++;
  switch (vs_step_look(vm, base, pc - 1)) {
    case VS_LOOK_STOP: return false;
    case VS_LOOK_FAILED: SAVE; goto fail;
    case VS_LOOK_GO: break;
  }
  goto *labels[ins & 255];
#endif

  OP(MOVE): RA = RB; NEXT;
  OP(FARLOAD): RA = base[BX]; NEXT;
  OP(FARSTORE): base[BX] = RA; NEXT;
  OP(CONST): RA = k[BX]; NEXT;
  OP(CONSTX): RA = k[*pc++]; NEXT;
  OP(INT): RA = vs_fix((int16_t)BX); NEXT;
  OP(IMM): RA = VS_IMMEDIATE(B, C); NEXT;
  OP(FREE): RA = vs_as_closure(base[-2])->free[BX]; NEXT;
  OP(UNBOX): RA = vs_as_box(RB)->value; NEXT;
  OP(SETBOX): vs_gc_store(vm, vs_as_box(RA), &vs_as_box(RA)->value, RB); NEXT;
  OP(BOX): SAVE; if (!vs_make_box(vm, RB, &RA)) goto fail; NEXT;
  OP(DEFINED):
    if (RA == VS_UNDEFINED) { SAVE; fail_early(vm, k[*pc]); goto fail; }
    pc++;
    NEXT;
  OP(GLOBAL): {
    vs_value g = vs_as_cell(k[*pc])->value;
    if (g == VS_UNDEFINED) { SAVE; fail_undefined(vm, vs_as_cell(k[*pc])->name); goto fail; }
    pc++;
    RA = g;
    NEXT;
  }
  OP(SETGLOBAL): {
    vs_cell *cell = vs_as_cell(k[*pc]);
    SAVE;
    if (cell->value == VS_UNDEFINED) { fail_undefined(vm, cell->name); goto fail; }
    if (cell->h.flags & VS_F_CONSTANT) vs_cell_redefine(k[*pc]);
    pc++;
    vs_gc_store(vm, cell, &cell->value, RA);
    NEXT;
  }
  OP(DEFGLOBAL): {
    SAVE;
    if (vs_as_cell(k[*pc])->h.flags & VS_F_CONSTANT) vs_cell_redefine(k[*pc]);
    vs_cell *cell = vs_as_cell(k[*pc++]);
    vs_gc_store(vm, cell, &cell->value, RA);
    NEXT;
  }
  OP(CLOSURE): {
    vs_value code = k[pc[0]];
    SAVE;
    if (!make_closure(vm, base, k, pc + 1, code, &RA)) goto fail;
    pc += 1 + vs_as_code(code)->free;
    NEXT;
  }
  OP(PATCH): {
    vs_closure *c = vs_as_closure(RA);
    vs_gc_store(vm, c, &c->free[*pc], RB);
    pc++;
    NEXT;
  }
  OP(CASE): SAVE; if (!make_case(vm, &RB, C, &RA)) goto fail; NEXT;

  OP(JUMP): pc += (int32_t)*pc + 1; NEXT;
  OP(LOOP):
    pc += (int32_t)*pc + 1;
    if (--vm->fuel <= 0) { SAVE; if (!vs_poll_limits(vm)) goto fail; }
    NEXT;
  OP(COVER): vm->coverage->forms[*pc++].count++; NEXT;
  OP(JTRUE): if (RA != VS_FALSE) pc += (int32_t)*pc + 1; else pc++; NEXT;
  OP(JFALSE): if (RA == VS_FALSE) pc += (int32_t)*pc + 1; else pc++; NEXT;
  OP(JGIVEN): if (RA != VS_ABSENT) pc += (int32_t)*pc + 1; else pc++; NEXT;
  OP(MISSING):
    SAVE;
  vs_fail(vm, vm->sym.arity, "%s needs the keyword #:%s",
          vs_is_symbol(vs_as_code(vs_as_closure(base[-2])->code)->name)
              ? vs_as_symbol(vs_as_code(vs_as_closure(base[-2])->code)->name)->name
              : "the procedure",
          vs_as_symbol(k[*pc])->name);
  goto fail;

  OP(DROP): DROPPED(RA); NEXT;
  OP(CALL): CALL_WINDOW;
  OP(CALLG): {
    vs_value g = vs_as_cell(k[*pc])->value;
    if (g == VS_UNDEFINED) { SAVE; fail_undefined(vm, vs_as_cell(k[*pc])->name); goto fail; }
    pc++;
    RA = g;
    CALL_WINDOW;
  }
  OP(TAIL): TAIL_WINDOW;
  OP(TAILG): {
    vs_value g = vs_as_cell(k[*pc])->value;
    if (g == VS_UNDEFINED) { SAVE; fail_undefined(vm, vs_as_cell(k[*pc])->name); goto fail; }
    pc++;
    RA = g;
    TAIL_WINDOW;
  }
  OP(CALLX):
    w = base + pc[0]; n = pc[1]; kw = pc[2] ? k[pc[2] - 1] : VS_FALSE; tail = A != 0;
    if (kw != VS_FALSE) LEAVE_SELF;
    ret = vs_ret_make(pc[0], HERE + 3);
    pc += 3;
    goto call;
  OP(RETURN): v = RA; goto give;
  OP(CHECK): {
    vs_value p = base[A + 2];
    if (vs_is(p, VS_T_NATIVE) && !vs_native_laid_out(vs_as_native(p)) && vs_as_native(p)->min <= 1 &&
        vs_as_native(p)->max >= 1) {
      const vs_native *native = vs_as_native(p);
      base[A] = base[A + 2];                      /* calls the predicate p directly: the registers from A become p, a
                                                   * free slot, and the value that p checks */
      base[A + 2] = base[A + 3];
      vm->base = base + A + 2; vm->pc = pc; vm->top = base + A + 4;
      vm->base[-1] = vs_ret_make(A, HERE);
      vm->native = native;
      vm->value = VS_UNSPECIFIC;
      status = native->def->fn(vm, base + A + 2, 1, &vm->value);
      vm->native = NULL;
      if (status == VS_OK && vm->value != VS_FALSE) { base[A] = base[A + 3]; pc++; NEXT; }
      base[A + 2] = vs_from_object(native);
    }
    w = &RA;
    w[0] = vm->at.check;
    w[4] = k[*pc++];
    n = 3; kw = VS_FALSE; tail = false;
    ret = vs_ret_make(A, HERE);
    goto call;
  }

#define ARITH(name, op, right)                                                                             \
  OP(name): {                                                                                              \
    vs_value a = RB, b = right, r;                                                                         \
    if (quick(op, a, b, &r)) { RA = r; NEXT; }                                                             \
    if (flat_rule(vm, op, a, b)) { SAVE; if (!vs_flat_arith(vm, op, a, b, &RA)) goto fail; NEXT; }         \
    goto generic;                                                                                          \
  }
  ARITH(ADD, VS_OP_ADD, RC)
  ARITH(SUB, VS_OP_SUB, RC)
  ARITH(MUL, VS_OP_MUL, RC)
  ARITH(DIV, VS_OP_DIV, RC)
  ARITH(ADDI, VS_OP_ADD, IMM_C)
  ARITH(SUBI, VS_OP_SUB, IMM_C)
#define ARITHN(name, op)                                                                                   \
  OP(name): {                                                                                              \
    const vs_value *at = &RB;                                                                              \
    vs_value r = at[0];                                                                                    \
    for (size_t i = 1; i < C; i++)                                                                         \
      if (!quick(op, r, at[i], &r)) goto generic;                                                          \
    RA = r;                                                                                                \
    NEXT;                                                                                                  \
  }
  ARITHN(ADDN, VS_OP_ADD)
  ARITHN(SUBN, VS_OP_SUB)
  ARITHN(MULN, VS_OP_MUL)

#define COMPARE(name, rel, left, right)                                                                    \
  OP(name): {                                                                                              \
    int truth = compare(rel, left, right);                                                                 \
    if (truth < 0) goto generic;                                                                           \
    BRANCH_IF(truth);                                                                                      \
  }
  COMPARE(JLT, LT, RA, RB)
  COMPARE(JLE, LE, RA, RB)
  COMPARE(JGT, GT, RA, RB)
  COMPARE(JGE, GE, RA, RB)
  COMPARE(JNE, EQ, RA, RB)
  COMPARE(JLTI, LT, RA, IMM_B)
  COMPARE(JLEI, LE, RA, IMM_B)
  COMPARE(JGTI, GT, RA, IMM_B)
  COMPARE(JGEI, GE, RA, IMM_B)
  COMPARE(JNEI, EQ, RA, IMM_B)
  COMPARE(JZERO, EQ, RA, vs_fix(0))
  COMPARE(JPOSITIVE, GT, RA, vs_fix(0))
  COMPARE(JNEGATIVE, LT, RA, vs_fix(0))
  OP(JEQ): BRANCH_IF(RA == RB);
  OP(JNULL): BRANCH_IF(RA == VS_NIL);
  OP(JPAIR): BRANCH_IF(vs_is_pair(RA));
  OP(JNOT): BRANCH_IF(RA == VS_FALSE);
  OP(JTYPE): BRANCH_IF(vs_is(RA, (int)B));

  OP(CAR): { vs_value p = RB; if (!vs_is_pair(p)) goto generic; RA = vs_car(p); NEXT; }
  OP(CDR): { vs_value p = RB; if (!vs_is_pair(p)) goto generic; RA = vs_cdr(p); NEXT; }
  OP(CADR) : {
    vs_value p = RB;
    if (!vs_is_pair(p) || !vs_is_pair(vs_cdr(p))) goto generic;
    RA = vs_car(vs_cdr(p));
    NEXT;
  }
  OP(CDDR) : {
    vs_value p = RB;
    if (!vs_is_pair(p) || !vs_is_pair(vs_cdr(p))) goto generic;
    RA = vs_cdr(vs_cdr(p));
    NEXT;
  }
  OP(CAAR) : {
    vs_value p = RB;
    if (!vs_is_pair(p) || !vs_is_pair(vs_car(p))) goto generic;
    RA = vs_car(vs_car(p));
    NEXT;
  }
  OP(CONS): {
    vs_pair *p;
    if (vm->end - vm->free >= (ptrdiff_t)sizeof *p) {
      p = (vs_pair *)(void *)vm->free;
      vm->free += sizeof *p;
      p->h = (vs_object){VS_T_PAIR, 0, 0, VS_WORDS(vs_pair)};
      p->car = RB; p->cdr = RC;
      RA = vs_from_object(p);
      NEXT;
    }
    SAVE;
    if (!vs_cons(vm, RB, RC, &RA)) goto fail;
    NEXT;
  }
  OP(VREF): {
    vs_value x = RB, i = RC;
    if (!vs_is_vector(x) || !vs_is_fixnum(i) || (uint64_t)vs_fixnum(i) >= vs_as_vector(x)->length) goto generic;
    RA = vs_as_vector(x)->at[vs_fixnum(i)];
    NEXT;
  }
  OP(VREFI): {
    vs_value x = RB;
    int8_t i = (int8_t)C;
    if (!vs_is_vector(x) || i < 0 || (uint64_t)i >= vs_as_vector(x)->length) goto generic;
    RA = vs_as_vector(x)->at[i];
    NEXT;
  }
#define VECTOR_SET                                                                                         \
    vs_value x = RA, i = RB;                                                                               \
    if (!vs_is_vector(x) || vs_object_of(x)->flags & VS_F_IMMUTABLE || !vs_is_fixnum(i) || \
        (uint64_t)vs_fixnum(i) >= vs_as_vector(x)->length) \
      goto generic;                                                                                        \
    vs_gc_store(vm, vs_as_vector(x), &vs_as_vector(x)->at[vs_fixnum(i)], RC)
  OP(VSET): { VECTOR_SET; NEXT; }
  OP(VSETV): { VECTOR_SET; base[*pc++] = VS_UNSPECIFIC; NEXT; }
  OP(SREF): {
    vs_value x = RB, i = RC;
    if (!vs_is(x, VS_T_STRING) || !vs_is_fixnum(i) || (uint64_t)vs_fixnum(i) >= vs_as_string(x)->length) goto generic;
    RA = VS_CHAR(vs_string_at(x, (size_t)vs_fixnum(i)));
    NEXT;
  }
  OP(JCHAREQ): if (!vs_is_char(RA) || !vs_is_char(RB)) goto generic; BRANCH_IF(RA == RB);
#define DIVIDED(expression) {                                                                              \
    if (!both_fixnums(RB, RC)) goto generic;                                                               \
    int64_t i = vs_fixnum(RB), j = vs_fixnum(RC);                                                          \
    if (j <= 0) goto generic;                                                                              \
    RA = vs_fix(expression);                                                                               \
    NEXT;                                                                                                  \
  }
  OP(QUOTIENT): DIVIDED(i / j)
  OP(REMAINDER): DIVIDED(i % j)
  OP(MODULO): DIVIDED(i % j + (i % j < 0 ? j : 0))
  OP(SQRT): if (!vs_is_double(RB) || !(vs_double(RB) > 0)) goto generic; RA = vs_flonum_raw(sqrt(vs_double(RB))); NEXT;
  OP(MAKEFLAT): {
    double d[VS_FLAT_FIELDS];
    if (!vm->flat || !flat_numbers(&RB, C, d)) goto generic;
    size_t words = VS_WORDS(vs_flat) + C;
    if (vm->end - vm->free >= (ptrdiff_t)(words * 8)) {
      vs_flat *f = (vs_flat *)(void *)vm->free;
      vm->free += words * 8;
      f->h = (vs_object){VS_T_FLAT, 0, vm->flat->maker[*pc++].tag, (uint32_t)words};
      for (size_t i = 0; i < C; i++) f->at[i] = d[i];
      RA = vs_from_object(f);
      NEXT;
    }
    SAVE;
    if (!vs_make_flat(vm, vm->flat->maker[*pc].tag, d, C, &RA)) goto fail;
    pc++;
    NEXT;
  }
  OP(FLATREF): {
    vs_value x = RB;
    if (!vs_is(x, VS_T_FLAT) || !(vm->flat->getter[C].mask >> vs_as_flat(x)->h.flags & 1)) goto generic;
    RA = vs_flonum_raw(vs_as_flat(x)->at[vm->flat->getter[C].index]);
    NEXT;
  }
/* Returns true if the nursery has room for so many words. Otherwise the procedure that the instruction replaces is
 * called, which may collect garbage. */
#define ROOM(words) (vm->end - vm->free >= (ptrdiff_t)((words) * 8))
  OP(FLAT1): {
    vs_value x = RB;
    if (!vs_is_flat(x, vm->flat->unary[C].tag)) goto generic;
    const double *a = vs_as_flat(x)->at;
    double d = vs_flat_length(a[0], a[1], a[2]);
    if (!(d - d == 0)) goto generic;
    RA = vs_flonum_raw(d);
    NEXT;
  }
  OP(FLAT2): {
    vs_value x = RB, y = RC;
    double d[3];
    int result = flat_binary(vm->flat, *pc, x, y, d);
    if (result < 0) goto generic;
    if (result == 0) { RA = vs_flonum_raw(d[0]); pc++; NEXT; }
    if (!ROOM(VS_WORDS(vs_flat) + 3)) goto generic;
    vs_flat *f = (vs_flat *)(void *)vm->free;
    vm->free += (VS_WORDS(vs_flat) + 3) * 8;
    f->h = (vs_object){VS_T_FLAT, 0, (uint16_t)result, VS_WORDS(vs_flat) + 3};
    f->at[0] = d[0]; f->at[1] = d[1]; f->at[2] = d[2];
    RA = vs_from_object(f);
    pc++;
    NEXT;
  }
  OP(RECREF): {
    vs_value x = RB;
    if (!vs_is(x, VS_T_RECORD) || vs_as_record(x)->type != RC || (*pc & 255) >= vs_record_fields(vs_as_record(x)))
      goto generic;
    RA = vs_as_record(x)->at[*pc++ & 255];
    NEXT;
  }
  OP(RECSET): {
    vs_value x = RA;
    if (!vs_is(x, VS_T_RECORD) || vs_as_record(x)->type != RB || (*pc & 255) >= vs_record_fields(vs_as_record(x)))
      goto generic;
    vs_gc_store(vm, vs_as_record(x), &vs_as_record(x)->at[*pc & 255], RC);
    pc++;
    NEXT;
  }
  OP(JRECORD): BRANCH_IF(vs_is(RA, VS_T_RECORD) && vs_as_record(RA)->type == RB);
  OP(JPROCEDURE): BRANCH_IF(vs_is_procedure(RA));
  OP(JFLONUM): BRANCH_IF(vs_is_double(RA));
  OP(JLIST): {
    int truth = vs_is_short_list(RA);
    if (truth < 0) goto generic;
    BRANCH_IF(truth);
  }
  OP(JEACH): {
    if (!vs_is(RA, VS_T_CLOSURE) || vs_is_short_list(RB) <= 0) goto generic;
    BRANCH_IF(true);
  }
  OP(EACH): {
    vs_value *row = &RA, procedure = RB, list = RC;
    row[VS_EACH_PROCEDURE] = procedure;
    row[VS_EACH_LIST] = list;
    row[VS_EACH_CAPTURES] = vs_captures(vm);
    row[VS_EACH_RESULTS] = row[VS_EACH_LAST] = VS_NIL;
    if (VS_B(*pc)) row[VS_EACH_RESULTS] = VS_UNSPECIFIC, row[VS_EACH_LAST] = VS_FALSE;
    goto each;
  }
  OP(MORE): {
    vs_value *row = &RA;
    pc--;
    if (B) {
      DROPPED(row[VS_EACH_WINDOW]);
    } else {
      SAVE;
      if (!vs_each_keep(vm, row)) goto fail;
    }
  }
each: {                                   /* calls EACH's procedure with the next element; pc is at MORE, with the same
                                           * operand A */
    vs_value *row = &RA, list = row[VS_EACH_LIST];
    if (!vs_is_pair(list)) {
      SAVE;
      if (!vs_each_end(vm, row)) goto fail;
      v = row[VS_EACH_RESULTS];
      goto give;
    }
    w = row + VS_EACH_WINDOW; n = 1;
    w[0] = row[VS_EACH_PROCEDURE];
    w[2] = vs_car(list);
    row[VS_EACH_LIST] = vs_cdr(list);
    ret = vs_ret_make(A + VS_EACH_WINDOW, HERE);
    if (vs_is(w[0], VS_T_CLOSURE)) {
      const vs_code *callee = CALLEE(w[0]);
      if (PLAIN(callee, 1, w)) {
        w[1] = row[VS_EACH_CAPTURES] == VS_FALSE ? ret : ret | VS_RET_EACH;
        base = w + 2;
        ENTER(callee);
      }
      if (callee->flags & VS_CODE_RECORD && vs_record_call(vm, w[0], w + 2, 1, &w[0])) NEXT;
    }
    if (--vm->fuel <= 0) { SAVE; if (!vs_poll_limits(vm)) goto fail; }
    kw = VS_FALSE; tail = false;
    goto call;
  }
  OP(RECORD): {
    vs_value type = RB;
    size_t fields = (size_t)C - 1;
    if (!vs_is(type, VS_T_RECORD_TYPE) || !ROOM(VS_WORDS(vs_record) + fields) ||
        vs_as_vector(vs_as_record_type(type)->fields)->length != fields) goto generic;
    vs_record *r = (vs_record *)(void *)vm->free;
    vm->free += (VS_WORDS(vs_record) + fields) * 8;
    r->h = (vs_object){VS_T_RECORD, 0, 0, (uint32_t)(VS_WORDS(vs_record) + fields)};
    r->type = type;
    for (size_t i = 0; i < fields; i++) r->at[i] = (&RB)[1 + i];
    RA = vs_from_object(r);
    NEXT;
  }
  OP(VECTOR): {
    size_t length = C;
    if (!ROOM(VS_WORDS(vs_vector) + length)) goto generic;
    vs_vector *r = (vs_vector *)(void *)vm->free;
    vm->free += (VS_WORDS(vs_vector) + length) * 8;
    r->h = (vs_object){VS_T_VECTOR, 0, 0, (uint32_t)(VS_WORDS(vs_vector) + length)};
    r->length = length;
    for (size_t i = 0; i < length; i++) r->at[i] = (&RB)[i];
    RA = vs_from_object(r);
    NEXT;
  }
  OP(LIST): {
    size_t length = C;
    if (!ROOM(VS_WORDS(vs_pair) * length)) goto generic;
    vs_value l = VS_NIL;
    for (size_t i = length; i-- > 0;) {
      vs_pair *p = (vs_pair *)(void *)vm->free;
      vm->free += sizeof *p;
      p->h = (vs_object){VS_T_PAIR, 0, 0, VS_WORDS(vs_pair)};
      p->car = (&RB)[i]; p->cdr = l;
      l = vs_from_object(p);
    }
    RA = l;
    NEXT;
  }
  OP(G_ABC1)
      : OP(G_RECREF)
      : OP(G_RECSET)
      : OP(G_ABC)
      : OP(G_AB)
      : OP(G_ABI) : OP(G_N) : OP(G_N1) : OP(G_JABC) : OP(G_JAI) : OP(G_JA) : OP(G_SET) : OP(G_SETV) : goto generic;
  OP(NONE): goto generic;                 /* NONE is an opcode that the compiler never emits */

  /* Calls the native that the instruction at pc - 1 replaces. */
generic: {
    const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
    size_t at = HERE - 1;
    w = base + code->registers;
    w[0] = vs_as_cell(k[vs_code_inlined(code, (uint32_t)at)])->value;
    ret = vs_ret_make(code->registers, at) | VS_RET_GENERIC;
    kw = VS_FALSE; tail = false;
    switch (vs_op_generic(ins & 255)) {
      case VS_O_G_ABC: case VS_O_G_ABC1: w[2] = RB; w[3] = RC; n = 2; break;
      case VS_O_G_RECREF: w[2] = RB; w[3] = RC; w[4] = vs_fix(*pc & 255); w[5] = k[*pc >> 8]; n = 4; break;
      case VS_O_G_RECSET: w[2] = RA; w[3] = RB; w[4] = vs_fix(*pc & 255); w[5] = RC; w[6] = k[*pc >> 8]; n = 5; break;
      case VS_O_G_AB: w[2] = RB; n = 1; break;
      case VS_O_G_ABI: w[2] = RB; w[3] = IMM_C; n = 2; break;
      case VS_O_G_N: case VS_O_G_N1: n = C; memcpy(w + 2, &RB, n * sizeof *w); break;
      case VS_O_G_JABC: w[2] = RA; w[3] = RB; n = 2; break;
      case VS_O_G_JAI: w[2] = RA; w[3] = IMM_B; n = 2; break;
      case VS_O_G_JA: w[2] = RA; n = 1; break;
      case VS_O_G_SET: case VS_O_G_SETV: w[2] = RA; w[3] = RB; w[4] = RC; n = 3; break;
      default: n = 0; break;
    }
    goto call;
  }

  /* Calls the case-lambda in w[0] with the n arguments at w + 2. If its first clause accepts n arguments, calls this
   * clause at once. */
call_case: {
    const vs_case *c = vs_as_case(w[0]);
    const vs_code *callee = c->count ? CALLEE(c->clause[0]) : NULL;
    if (callee && PLAIN(callee, n, w)) {
      w[0] = c->clause[0];
      w[1] = vs_ret_make(A, HERE);
      base = w + 2;
      ENTER(callee);
    }
    ret = vs_ret_make(A, HERE); kw = VS_FALSE; tail = false;
    goto call;
  }

  /* Calls the procedure in w[0], which define-record-type has created, with the n arguments at w + 2, without an
   * activation. */
call_record:
  if (vs_record_call(vm, w[0], w + 2, n, &w[0])) NEXT;
  ret = vs_ret_make(A, HERE); kw = VS_FALSE; tail = false;
  goto call;

  /* Calls w[0] with the n arguments at w + 2 and the keywords kw. If `tail` is true, the activation at base ends.
   * Otherwise `ret` is the return information, and the caller is the activation at base. Before the first call there is
   * no activation. */
call: {
    vs_value f = w[0];
    if (!vs_is_object(f)) goto no_procedure;
    switch (vs_object_of(f)->type) {
      case VS_T_CLOSURE: {
        const vs_code *code = CALLEE(f);
        if (code->flags & VS_CODE_RECORD && kw == VS_FALSE && vs_record_call(vm, f, w + 2, n, &vm->value)) {
          v = vm->value;
          if (tail) goto give;
          w[1] = ret;
          base = w + 2;
          goto give;
        }
        size_t need = n > code->registers ? n : code->registers;
        if (vm->stack_end - w < (ptrdiff_t)(need + 2 + VS_ACTIVATION_SLACK)) {
          if (tail) {                             /* moves the call to the start of the ending activation */
            memmove(base, w + 2, n * sizeof *w);
            base[-2] = f;
            w = base - 2; ret = base[-1];
            tail = false;
          }
          pc = NULL;
          w[1] = ret;
          vm->native = NULL;
          if (vm->stack_end - w < (ptrdiff_t)(need + 2 + VS_ACTIVATION_SLACK)) {
            vs_value *moved = vs_activation_flush(vm, w, n, need + 2);
            if (!moved) goto stack_full;
            w = moved; ret = w[1];
            base = w + 2;                         /* the activation of the caller has moved to the heap, or has ended */
          }
          f = w[0];
        }
        if (!(code->flags & VS_CODE_SIMPLE) || n != code->required || kw != VS_FALSE) {
          if (!tail) w[1] = ret;
          vm->base = pc ? base : w + 2; vm->pc = pc;
          vm->native = NULL;
          vm->top = w + 2 + n;
          if (!vs_arguments_closure(vm, code, w + 2, n, kw)) goto fail_above;
          n = (size_t)code->required + code->optional + code->keywords + (code->flags & VS_CODE_REST ? 1 : 0);
          f = w[0];
        }
        if (tail) {
          base[-2] = f;
          for (size_t i = 0; i < n; i++) base[i] = w[2 + i];
        } else {
          w[1] = ret;
          base = w + 2;
        }
        ENTER(code);
      }
      case VS_T_NATIVE: {
        const vs_native *native = vs_as_native(f);
        size_t given = n, total = n;
        bool laid_out = vs_native_laid_out(native);
        /* In a tail call, a native with slots (apply, call/cc and similar) must not keep the caller's activation. Other
         * natives keep it, since it contains the place for errors. */
        if (tail && native->def->slots) {
          memmove(base, w + 2, n * sizeof *w);
          base[-2] = f;
          w = base - 2; ret = base[-1];
          tail = false;
          pc = NULL;                            /* this activation's code has ended: the native returns to its caller */
        } else if (tail) {
          ret = vs_ret_make((size_t)(w - base), HERE);
        }
        w[1] = ret;
        vm->top = w + 2 + n;
        vm->pc = pc;
        if (laid_out || n < native->min || n > native->max || kw != VS_FALSE) {
          if (vm->stack_end - w < (ptrdiff_t)(n + 2 + VS_ACTIVATION_SLACK)) {
            vm->native = NULL;
            w = vs_activation_flush(vm, w, n, n + 2 + VS_ACTIVATION_SLACK);
            if (!w) goto stack_full;
          }
          vm->base = w + 2;
          vm->native = NULL;
          if (!vs_arguments_native(vm, native, w + 2, n, kw, &given, &total)) { base = w + 2; goto fail_native; }
          vm->top = w + 2 + total;
        }
        vm->base = w + 2;
        vm->native = native;
        vm->value = VS_UNSPECIFIC;
        status = native->def->fn(vm, w + 2, (int)given, &vm->value);
        vm->native = NULL;
        if (status == VS_OK) {
          if (tail) { v = vm->value; goto give; }
          if (pc && !(ret & VS_RET_FLAGS)) { w[0] = vm->value; NEXT; }      /* continues with the code at pc, of the
                                                                             * activation at base */
        } else if (status == VS_SEVERAL && tail) {
          v = vm->value;
          goto give_several;
        }
        base = vm->base;
        goto native_done;
      }
      case VS_T_CASE: {
        const vs_case *c = vs_as_case(f);
        size_t i = 0;
        while (i < c->count && !vs_arguments_fit(vs_as_code(vs_as_closure(c->clause[i])->code), n, kw)) i++;
        /* in a case-lambda with a note, only the first clause defines how arguments are passed; it reports the error */
        if (i == c->count && vs_case_note(c) != VS_FALSE) i = 0;
        if (i == c->count) {
          w[1] = tail ? VS_FALSE : ret;
          vm->base = pc ? base : w + 2; vm->pc = pc;
          vm->native = NULL;
          vm->top = w + 2 + n;
          vs_fail_clauses(vm, c, n);
          goto fail_above;
        }
        w[0] = c->clause[i];
        goto call;
      }
      case VS_T_CONTINUATION: {
        if (kw != VS_FALSE) goto no_procedure;
        w[1] = tail ? VS_FALSE : ret;
        vm->top = w + 2 + n;
        vm->native = NULL;
        vm->base = pc ? base : w + 2; vm->pc = pc;
        if (!vs_make_values(vm, w + 2, n, &vm->value)) goto fail_above;
        w[3] = vm->value;
        w[2] = w[0];
        w[0] = vm->at.throw;
        n = 2;
        goto call;
      }
      case VS_T_PARAMETER:
        if (n != 0) {
          w[1] = tail ? VS_FALSE : ret;
          vm->base = pc ? base : w + 2; vm->pc = pc;
          vm->top = w + 2 + n;
          vm->native = NULL;
          vs_value called = vs_as_parameter(f)->name;
          vs_fail(vm, vm->sym.arity, "%s is a parameter and takes no arguments, got %zu; parameterize sets it",
                  vs_is_symbol(called) ? vs_as_symbol(called)->name : "this", n);
          goto fail_above;
        }
        v = vs_parameter_value(vm, f);
        if (tail) goto give;
        w[1] = ret;
        base = w + 2;
        goto give;
      default: goto no_procedure;
    }
  }

no_procedure:
  w[1] = tail ? VS_FALSE : ret;
  vm->base = pc ? base : w + 2; vm->pc = pc;
  vm->top = w + 2 + n;
  vm->native = NULL;
  fail_callee(vm, w[0], w + 2, n);
fail_above:                               /* an error in the call of an activation at base, whose registers above it are
                                           * in use */
  if (pc) goto fail;
  ret = w[1];                             /* the caller is a native, or its activation is in the heap; the error gets
                                           * the place of the call */
  goto raise;

  /* A native has returned `status`. Its activation is at base (equal to vm->base), and its last slot is below
   * vm->top. */
native_done:
  w = base - 2;
  switch (status) {
    case VS_OK: case VS_SEVERAL:
      v = vm->value;
      if (vs_is(v, VS_T_VALUES)) goto give_several;
      goto give;
    case VS_ERROR: goto fail_native;
    case VS_TAILCALL:
    case VS_CALL: {
      size_t size = (size_t)(vm->top - base);
      n = vm->call_count;
      kw = VS_FALSE;
      tail = false;
      if (status == VS_CALL) {
        w = base + size;
        ret = vs_ret_make(size, 0) | VS_RET_NATIVE;
      } else {
        ret = w[1];
      }
      w[1] = ret;
      if (vm->stack_end - w < (ptrdiff_t)(n + 2 + VS_ACTIVATION_SLACK)) {
        w[0] = VS_FALSE;
        w = vs_activation_flush(vm, w, 0, n + 2 + VS_ACTIVATION_SLACK);
        if (!w) goto stack_full;
        ret = w[1];
      }
      w[0] = vm->call_procedure;
      if (n) memcpy(w + 2, vm->call_args, n * sizeof *w);
      if (vm->call_self) {
        vm->call_self = false;
        kw = vm->at.self_call;
        LEAVE_SELF;
      }
      vm->call_count = 0;
      vm->call_procedure = VS_FALSE;
      base = w + 2;
      pc = NULL;                              /* pc NULL: the activation at base is that of a native */
      goto call;
    }
    case VS_THROW: {
      const vs_continuation *c = vs_as_continuation(vm->call_procedure);
      v = vm->value;
      vm->winders = c->winders; vm->handlers = c->handlers; vm->parameters = c->parameters;
      vm->under = c->stack; vm->under_depth = c->depth;
      vm->stack[0] = VS_FALSE;
      vm->stack[1] = c->ret;
      base = vm->stack + 2;
      vm->top = base;
      vm->call_procedure = VS_FALSE;
      if (vs_is(v, VS_T_VALUES)) goto give_several;
      goto give;
    }
    default: goto uncaught;
  }

  /* Returns several values, in the object v, from the activation at base. Tests here, or at the label `give`, whether
   * the caller accepts several values. */
give_several:
  ret = base[-1];
  if (!(ret & VS_RET_FLAGS)) {
    vs_value *caller = base - 2 - vs_ret_distance(ret);
    const vs_code *code = vs_as_code(vs_as_closure(caller[-2])->code);
    if (!takes_several(vs_code_ins(code) + vs_ret_pc(ret))) {
      base = caller;
      RUN_CODE(code);
      pc = start + vs_ret_pc(ret);
      SAVE;
      fail_several(vm, v);
      goto fail;
    }
  }
  goto give;

  /* Returns the value v from the activation at base to its caller. */
give: {
    ret = base[-1];
    size_t distance = vs_ret_distance(ret);
    if (ret & VS_RET_FLAGS) {
      if (!VS_STEPPING && (ret & VS_RET_FLAGS) == VS_RET_EACH) {
        int done = vs_each_again(vm, base, v);
        if (done == 1) { pc = start; NEXT; }
        if (done == 2) {
          v = VS_EACH_BELOW(base, VS_EACH_RESULTS);
          base -= 2 + distance;
          goto give;
        }
      }
      if (ret & VS_RET_STOP) { *out = v; return true; }
      if (ret & VS_RET_UNDER) {
        const vs_stack *s = vs_as_stack(vm->under);
        size_t size = distance + 2;
        uint64_t first = vm->under_depth - size;
        memcpy(vm->stack, s->at + first, size * sizeof *s->at);
        if (first == 0) { vm->under = s->under; vm->under_depth = s->depth; }
        else { vm->stack[1] |= VS_RET_UNDER; vm->under_depth = first; }
        base = vm->stack + size + 2;              /* base becomes the address of the activation to which control
                                                   * returns */
      }
      base -= 2 + distance;
      vm->top = base + distance;
      if (ret & VS_RET_NATIVE) {
        const vs_native *native = vs_as_native(base[-2]);
        vm->base = base;
        vm->native = native;
        vm->value = v;
        vm->pc = NULL;
        pc = NULL;
        status = native->def->fn(vm, base, -1, &vm->value);
        vm->native = NULL;
        base = vm->base;
        goto native_done;
      }
      const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
      if (ret & VS_RET_UNDER && vm->stack_end - base < (ptrdiff_t)(code->registers + VS_ACTIVATION_SLACK)) {
        vm->value = v;
        if (!vs_activation_flush(vm, vm->stack, distance, code->registers + 2)) goto stack_full;
        base = vm->stack + 2;
        v = vm->value;
      }
      RUN_CODE(code);
      pc = start + vs_ret_pc(ret);
      if (ret & VS_RET_GENERIC) {
        ins = *pc;
        switch (vs_op_generic(ins & 255)) {
          case VS_O_G_JABC: case VS_O_G_JAI: case VS_O_G_JA: pc++; BRANCH_IF(v != VS_FALSE);
          case VS_O_G_SET: pc++; NEXT;
          case VS_O_G_SETV: base[pc[1]] = v; pc += 2; NEXT;
          case VS_O_G_N1: case VS_O_G_ABC1: case VS_O_G_RECREF: RA = v; pc += 2; NEXT;
          case VS_O_G_RECSET: pc += 2; NEXT;
          default: RA = v; pc++; NEXT;
        }
      }
      base[distance] = v;
      if (vs_is(v, VS_T_VALUES) && !takes_several(pc)) { SAVE; fail_several(vm, v); goto fail; }
      NEXT;
    }
    base -= 2 + distance;
    const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
    RUN_CODE(code);
    pc = start + vs_ret_pc(ret);
    base[distance] = v;
    NEXT;
  }

  /* The native at base, or the code at pc of the activation at base, has raised vm->condition. Errors of limits and
   * interrupts are not passed to the program's handlers. */
fail_native:
  w = base;                               /* the call of the handler overwrites the native's arguments, which are no
                                           * longer needed */
  ret = vs_ret_make(0, 0) | VS_RET_NATIVE;
  goto raise;
fail: {
    const vs_code *code = vs_as_code(vs_as_closure(base[-2])->code);
    w = base + code->registers;
    ret = vs_ret_make(code->registers, (size_t)(pc - vs_code_ins(code)));
  }
raise:
  vm->native = NULL;
  if (vs_is(vm->condition, VS_T_CONDITION)) {
    vs_value kind = vs_as_condition(vm->condition)->kind;
    if (kind == vm->sym.limit || kind == vm->sym.interrupt) goto uncaught;
  }
  if (vm->handlers == VS_NIL) goto uncaught;
  w[0] = vm->at.raise;
  w[1] = ret;
  w[2] = vm->condition;
  n = 1; kw = VS_FALSE; tail = false;
  goto call;

stack_full:                               /* the error is set: the stack could not grow */
uncaught:
  return false;
#pragma GCC diagnostic pop
}

#if VS_STEPPING
bool vs_step_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out) { return loop(vm, w, n, out); }
#else
bool vs_run_loop(vs_scheme *vm, vs_value *w, size_t n, vs_value *out) { return loop(vm, w, n, out); }
#endif
