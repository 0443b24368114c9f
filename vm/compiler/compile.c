/* Translates core trees to instructions.
 *
 * Every expression is compiled for a target: a register for its value, EFFECT (the value is not needed), or TAIL (the
 * value is returned). Registers form a stack: variables below, temporary values above. The registers of a call are
 * therefore the next free registers, and all registers below are in use. An expression writes its target only after it
 * has read all its operands.
 *
 * A FIX variable that is a loop (analyse.h) has no value. The loop's parameters are registers of the enclosing
 * activation, and its body is compiled at its first call. Later calls assign the parameters and jump to the body. */
#include "vm/compiler/compile.h"

#include "vm/compiler/analyse.h"
#include "vm/compiler/coverage.h"
#include "vm/compiler/each.h"
#include "vm/compiler/emit.h"
#include "vm/compiler/inline.h"
#include "vm/front/environment.h"
#include "vm/front/suggest.h"
#include "vm/machine/native.h"

#define EFFECT (UINT32_MAX - 1)
#define TAIL (UINT32_MAX - 2)

struct job { struct job *next; vs_core_node *lambda; };
/* covered: the node that gen or test counted last, which the other of the two does not count again. */
typedef struct compiler { vs_emit e; struct job *jobs; const vs_core_node *covered; } compiler;

static bool gen(compiler *c, vs_core_node *n, uint32_t to);
static bool test(compiler *c, vs_core_node *n, bool sense, vs_jumps *list);

/* Returns true if the variable is stored in a box. Assigned variables have boxes: when a continuation restores the
 * registers of its activation, it must not undo an assignment. A variable with in_register set that is not captured
 * remains in its register. */
static bool boxed(const vs_var *v) { return vs_info(v)->boxed || (v->assigned && !(v->in_register && !v->captured)); }
static bool is_value(uint32_t to) { return to < TAIL; }
static vs_value pool(const compiler *c, uint32_t i) { return c->e.ast->pool[i]; }

/* Completes an expression whose value is in register `from`: moves the value to the target `to`, or returns it if `to`
 * is TAIL. */
static bool finish(compiler *c, uint32_t from, uint32_t to) {
  if (to == TAIL) return vs_emit_op(&c->e, VS_O_RETURN, from, 0, 0);
  if (to == EFFECT || from == to) return true;
  return vs_emit_op(&c->e, VS_O_MOVE, to, from, 0);
}

/* Sets *reg to the register in which to compute a value for the target `to`: `to` itself if it is a register, otherwise
 * a new temporary register, which the caller frees. */
static bool landing(compiler *c, uint32_t to, uint32_t *reg) {
  if (is_value(to)) { *reg = to; return true; }
  return vs_emit_register(&c->e, reg);
}

/* Counts the runs of the form n, if the program's forms are counted. Constants and variables are no forms: their places
 * are those of the forms around them. */
static bool cover(compiler *c, const vs_core_node *n) {
  vs_emit *e = &c->e;
  uint32_t index;
  if (!vs_covers(e->ast->vm, n->pos) || c->covered == n || n->kind == VS_AST_CONST || n->kind == VS_AST_LOCAL ||
      n->kind == VS_AST_GLOBAL || n->kind == VS_AST_SEQ) return true;
  c->covered = n;
  return vs_cover_form(e->ast->vm, n->pos, &index) && vs_emit_op1(e, VS_O_COVER, 0, 0, 0, index);
}

/* ---- constants and variables ---- */
static bool load_value(compiler *c, vs_value v, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t k;
  if (vs_is_fixnum(v) && vs_fixnum(v) >= INT16_MIN && vs_fixnum(v) <= INT16_MAX)
    return vs_emit_op(e, VS_O_INT, to, (uint32_t)vs_fixnum(v) & 0xFFFF, 0);
  if (v >> 48 == VS_TAG_IMMEDIATE && !vs_is_char(v))
    return vs_emit_op(e, VS_O_IMM, to, (uint32_t)(v >> 32) & 0xFF, (uint32_t)v & 0xFF);
  if (!vs_emit_value(e, v, &k)) return false;
  return k <= UINT16_MAX ? vs_emit_op(e, VS_O_CONST, to, k, 0) : vs_emit_op1(e, VS_O_CONSTX, to, 0, 0, k);
}

static uint32_t free_index(const compiler *c, const vs_var *v) {
  return vs_free_index(c->e.lambda->as.lambda.extra, v);
}

/* Loads a variable's register or captured value, without opening its box if it has one. */
static bool load_raw(compiler *c, const vs_var *v, uint32_t to) {
  if (vs_info(v)->lambda == c->e.lambda) return to == v->reg || vs_emit_op(&c->e, VS_O_MOVE, to, v->reg, 0);
  return vs_emit_op(&c->e, VS_O_FREE, to, free_index(c, v), 0);
}

static bool load_var(compiler *c, const vs_core_node *n, uint32_t to) {
  const vs_var *v = n->as.var;
  vs_emit *e = &c->e;
  if (boxed(v)) {
    uint32_t box = to;
    if (vs_info(v)->lambda == e->lambda) box = v->reg;
    else if (!load_raw(c, v, to)) return false;
    if (!vs_emit_op(e, VS_O_UNBOX, to, box, 0)) return false;
  } else if (!load_raw(c, v, to)) {
    return false;
  }
  if (!n->flag) return true;
  uint32_t name;
  return vs_emit_constant(e, v->name, &name) && vs_emit_place(e, n->pos) &&
         vs_emit_op1(e, VS_O_DEFINED, to, 0, 0, name);
}

static bool load_global(compiler *c, const vs_core_node *n, uint32_t to) {
  uint32_t k;
  return vs_emit_constant(&c->e, n->as.global.cell, &k) && vs_emit_place(&c->e, n->pos) &&
         vs_emit_op1(&c->e, VS_O_GLOBAL, to, 0, 0, k);
}

/* Sets *reg to a register with the value of n for the next instruction: the register of a local variable, or a
 * temporary one. */
static bool operand(compiler *c, vs_core_node *n, uint32_t *reg) {
  if (n->kind == VS_AST_LOCAL && !n->flag && !boxed(n->as.var) && vs_info(n->as.var)->lambda == c->e.lambda) {
    *reg = n->as.var->reg;
    return true;
  }
  return vs_emit_register(&c->e, reg) && gen(c, n, *reg);
}

/* Returns true if evaluating n may assign the variable v, whose value is in a register. */
static bool writes(const vs_core_node *n, const vs_var *v, int depth) {
  if (!n) return false;
  if (depth > 6) return true;
  switch (n->kind) {
    case VS_AST_CONST: case VS_AST_LOCAL: case VS_AST_GLOBAL: return false;
    case VS_AST_IF:
      return writes(n->as.branch.test, v, depth + 1) || writes(n->as.branch.then, v, depth + 1) ||
             writes(n->as.branch.otherwise, v, depth + 1);
    case VS_AST_CALL:
      if (writes(n->as.call.callee, v, depth + 1)) return true;
      for (uint32_t i = 0; i < n->count; i++)
        if (writes(n->as.call.at[i], v, depth + 1)) return true;
      return false;
    default: return true;
  }
}

/* Sets *reg to a register with the value of argument i of a call. If the argument is a variable that a later argument
 * may assign, the register contains a copy. */
static bool operand_of(compiler *c, vs_core_node *call, uint32_t i, uint32_t *reg) {
  vs_core_node *n = call->as.call.at[i];
  bool written = false;
  VS_ASSERT(i < call->count);
  if (n->kind == VS_AST_LOCAL && n->as.var->assigned)
    for (uint32_t j = i + 1; !written && j < call->count; j++) written = writes(call->as.call.at[j], n->as.var, 0);
  return written ? vs_emit_register(&c->e, reg) && gen(c, n, *reg) : operand(c, n, reg);
}

/* ---- calls that are compiled to one instruction ---- */
static bool small(const compiler *c, const vs_core_node *n, uint32_t *bits) {
  if (n->kind != VS_AST_CONST) return false;
  vs_value v = pool(c, n->as.constant);
  if (!vs_is_fixnum(v) || vs_fixnum(v) < INT8_MIN || vs_fixnum(v) > INT8_MAX) return false;
  *bits = (uint32_t)vs_fixnum(v) & 0xFF;
  return true;
}

/* Returns the row of inline.def for this call, or NULL. Sets *native to the procedure in the cell. */
static const vs_inline_row *row_of(const compiler *c, const vs_core_node *n, const vs_native **native) {
  const vs_core_node *f = n->as.call.callee;
  if (n->kind != VS_AST_CALL || f->kind != VS_AST_GLOBAL || n->as.call.keywords) return NULL;
  const vs_cell *cell = vs_as_cell(pool(c, f->as.global.cell));
  if (!(cell->h.flags & VS_F_CONSTANT) || !vs_is(cell->value, VS_T_NATIVE)) return NULL;
  *native = vs_as_native(cell->value);
  return (*native)->inlined ? vs_inline_get((*native)->inlined) : NULL;
}

static bool is_test(const vs_inline_row *row, const vs_core_node *n) {
  return row && (row->way == VS_WAY_TEST || row->way == VS_WAY_TYPE) && n->count == row->args;
}

static bool stands_for(compiler *c, const vs_core_node *n) {
  uint32_t k;
  VS_ASSERT(n->kind == VS_AST_CALL && n->as.call.callee->kind == VS_AST_GLOBAL);
  return vs_emit_constant(&c->e, n->as.call.callee->as.global.cell, &k) && vs_emit_place(&c->e, n->pos) &&
         vs_emit_inlined(&c->e, k);
}

/* Copies an operand from a register with a number from VS_FAR to a scratch register that instructions can name. Call it
 * before stands_for, which applies to the next instruction only. */
static bool near(compiler *c, uint32_t *reg, unsigned i) {
  if (*reg < VS_FAR) return true;
  uint32_t scratch = VS_NEAR + 4 + i;
  if (c->e.most < VS_FAR) c->e.most = VS_FAR;
  if (!vs_emit_word(&c->e, VS_INSX(VS_O_FARLOAD, scratch, *reg))) return false;
  *reg = scratch;
  return true;
}

/* Operands B and C of an instruction. registers: how many of the two are registers (0 to 2); the others are
 * constants. */
typedef struct { uint32_t b, c; unsigned registers; } operands;

static bool emit_value_op(compiler *c, const vs_core_node *n, unsigned op, uint32_t to, operands o) {
  uint32_t target = to;
  if (to >= VS_NEAR) target = VS_NEAR + 4;
  if ((o.registers > 0 && !near(c, &o.b, 1)) || (o.registers > 1 && !near(c, &o.c, 2)) || !stands_for(c, n))
    return false;
  if (!vs_emit_word(&c->e, VS_INS(op, target, o.b, o.c))) return false;
  if (target == to) return true;
  if (c->e.most < VS_FAR) c->e.most = VS_FAR;
  return vs_emit_word(&c->e, VS_INSX(VS_O_FARSTORE, target, to));
}

/* Evaluates the arguments of a call to new consecutive registers, and sets *first to the first register. Sets *ok to
 * false, without evaluating, if the registers have numbers that instructions cannot name. */
static bool in_a_row(compiler *c, vs_core_node *n, uint32_t *first, bool *ok) {
  *ok = c->e.next + n->count < VS_NEAR;
  if (!*ok) return true;
  for (uint32_t i = 0; i < n->count; i++) {
    uint32_t r;
    if (!vs_emit_register(&c->e, &r) || !gen(c, n->as.call.at[i], r)) return false;
    if (i == 0) *first = r;
  }
  return true;
}

/* If n is a call that an opcode can replace, emits the opcode and sets *done to true. Otherwise sets *done to false. */
static bool gen_inline(compiler *c, vs_core_node *n, uint32_t to, bool *done) {
  const vs_native *native;
  const vs_inline_row *row = row_of(c, n, &native);
  vs_emit *e = &c->e;
  uint32_t r[3], keep = e->next, target, bits, first = 0;
  *done = false;
  if (!row) return true;
  switch ((vs_inline_way)row->way) {
    case VS_WAY_NONE: return true;
    case VS_WAY_TEST: case VS_WAY_TYPE: {
      if (n->count != row->args) return true;
      *done = true;
      vs_jumps no = 0, end = 0;
      if (!landing(c, to, &target) || !test(c, n, false, &no) || !load_value(c, VS_TRUE, target)) return false;
      if (to == TAIL ? !finish(c, target, to) : !vs_emit_branch(e, VS_O_JUMP, 0, 0, 0, &end)) return false;
      vs_emit_here(e, no);
      if (!load_value(c, VS_FALSE, target) || !finish(c, target, to)) return false;
      vs_emit_here(e, end);
      e->next = keep;
      return true;
    }
    case VS_WAY_VALUE:
      if (n->count == row->args) {
        *done = true;
        bool imm = row->args == 2 && row->immediate != VS_O_NONE && small(c, n->as.call.at[1], &bits);
        for (uint32_t i = 0; i < row->args - (imm ? 1u : 0u); i++)
          if (!operand_of(c, n, i, &r[i])) return false;
        if (!landing(c, to, &target)) return false;
        bool two = row->args == 2 && !imm;
        operands o = {r[0], imm ? bits : two ? r[1] : 0, two ? 2 : 1};
        if (!emit_value_op(c, n, imm ? row->immediate : row->op, target, o)) return false;
      } else if (n->count > (row->args == VS_ANY_COUNT ? 0 : 2) && n->count < 64 && row->many != VS_O_NONE) {
        if (!in_a_row(c, n, &first, done)) return false;
        if (!*done) return true;
        if (!landing(c, to, &target) || !emit_value_op(c, n, row->many, target, (operands){first, n->count, 0}))
          return false;
      }
      break;
    case VS_WAY_EFFECT:
      if (n->count != row->args) return true;
      *done = true;
      for (unsigned i = 0; i < 3; i++)
        if (!operand_of(c, n, i, &r[i])) return false;
      if (to != EFFECT && !landing(c, to, &target)) return false;
      for (unsigned i = 0; i < 3; i++)
        if (!near(c, &r[i], i)) return false;
      if (!stands_for(c, n) || !vs_emit_word(e, VS_INS(to == EFFECT ? row->op : row->many, r[0], r[1], r[2])))
        return false;
      if (to != EFFECT) {
        if (!vs_emit_word(e, target)) return false;
        break;
      }
      e->next = keep;
      return true;
    case VS_WAY_MAKE: {
      const vs_flat_rules *rules = e->ast->vm->flat;
      if (!rules || n->count != rules->maker[native->inlined_arg].n) return true;
      if (!in_a_row(c, n, &first, done)) return false;
      if (!*done) return true;
      if (!landing(c, to, &target)) return false;
      uint32_t near_target = target < VS_NEAR ? target : VS_NEAR + 4;
      if (!stands_for(c, n) || !vs_emit_word(e, VS_INS(row->op, near_target, first, n->count)) ||
          !vs_emit_word(e, native->inlined_arg))
        return false;
      if (near_target != target && !vs_emit_word(e, VS_INSX(VS_O_FARSTORE, near_target, target))) return false;
      if (near_target != target && e->most < VS_FAR) e->most = VS_FAR;
      break;
    }
    case VS_WAY_FLAT2: {
      if (n->count != 2) return true;
      *done = true;
      if (!operand_of(c, n, 0, &r[0]) || !operand_of(c, n, 1, &r[1]) ||
          !landing(c, to, &target)) return false;
      uint32_t near_target = target < VS_NEAR ? target : VS_NEAR + 4;
      if (!near(c, &r[0], 1) || !near(c, &r[1], 2) || !stands_for(c, n) ||
          !vs_emit_word(e, VS_INS(row->op, near_target, r[0], r[1])) || !vs_emit_word(e, native->inlined_arg))
        return false;
      if (near_target != target && !vs_emit_word(e, VS_INSX(VS_O_FARSTORE, near_target, target))) return false;
      if (near_target != target && e->most < VS_FAR) e->most = VS_FAR;
      break;
    }
    case VS_WAY_RECORD: {              /* the calls (%record-ref record type index name) and (%record-set! record type
                                        * index value name) */
      bool set = row->op == VS_O_RECSET;
      vs_core_node *index = n->as.call.at[2], *name = n->as.call.at[row->args - 1];
      uint32_t k;
      if (n->count != row->args || index->kind != VS_AST_CONST || name->kind != VS_AST_CONST ||
          !vs_is_fixnum(pool(c, index->as.constant)) || (uint64_t)vs_fixnum(pool(c, index->as.constant)) > 255)
        return true;
      *done = true;
      if (!operand_of(c, n, 0, &r[0]) || !operand_of(c, n, 1, &r[1]) || (set && !operand_of(c, n, 3, &r[2])) ||
          !landing(c, to, &target)) return false;
      for (unsigned i = 0; i < (set ? 3 : 2); i++)
        if (!near(c, &r[i], i)) return false;
      uint32_t near_target = target < VS_NEAR ? target : VS_NEAR + 4;
      if (!vs_emit_constant(e, name->as.constant, &k) || k >= 1u << 24 || !stands_for(c, n) ||
          !vs_emit_word(e, set ? VS_INS(row->op, r[0], r[1], r[2]) : VS_INS(row->op, near_target, r[0], r[1])) ||
          !vs_emit_word(e, k << 8 | (uint32_t)vs_fixnum(pool(c, index->as.constant)))) return false;
      if (set) {
        if (to != EFFECT && !load_value(c, VS_UNSPECIFIC, target)) return false;
        break;
      }
      if (near_target != target && !vs_emit_word(e, VS_INSX(VS_O_FARSTORE, near_target, target))) return false;
      if (near_target != target && e->most < VS_FAR) e->most = VS_FAR;
      break;
    }
    case VS_WAY_EACH:
      if (n->count != 2 || to != TAIL || e->next + 2 + VS_EACH_WINDOW + 3 >= VS_NEAR) return true;
      *done = true;
      if (!operand_of(c, n, 0, &r[0]) || !operand_of(c, n, 1, &r[1]) || !vs_emit_register(e, &target)) return false;
      for (uint32_t i = 1, reg; i < VS_EACH_WINDOW + 3; i++)
        if (!vs_emit_register(e, &reg)) return false;
      if (!vs_emit_place(e, n->pos) || !vs_emit_word(e, VS_INS(VS_O_EACH, target, r[0], r[1])) ||
          !vs_emit_place(e, n->pos) || !vs_emit_word(e, VS_INS(VS_O_MORE, target, row->immediate, 0))) return false;
      e->next = keep;
      return true;
    case VS_WAY_GET:
      if (n->count != 1) return true;
      *done = true;
      if (!operand_of(c, n, 0, &r[0]) || !landing(c, to, &target) ||
          !emit_value_op(c, n, row->op, target, (operands){r[0], native->inlined_arg, 1})) return false;
      break;
  }
  if (*done && !finish(c, target, to)) return false;
  e->next = keep;
  return true;
}

/* ---- tests: code that jumps if the truth of n is `sense`, and continues otherwise. `list` collects the jumps, whose
 * targets are set later ---- */
static bool test(compiler *c, vs_core_node *n, bool sense, vs_jumps *list) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next, r[2], bits;
  const vs_native *native;
  if (!cover(c, n)) return false;
  switch (n->kind) {
    case VS_AST_CONST:
      return (pool(c, n->as.constant) != VS_FALSE) != sense || vs_emit_branch(e, VS_O_JUMP, 0, 0, 0, list);
    case VS_AST_IF: {
      vs_jumps no = 0, end = 0;
      vs_core_node *otherwise = n->as.branch.otherwise;
      /* The expression (and a b), with a jump if its value is false: jumps if a is false, and if b is false. */
      if (!sense && otherwise && otherwise->kind == VS_AST_CONST && pool(c, otherwise->as.constant) == VS_FALSE)
        return test(c, n->as.branch.test, false, list) && test(c, n->as.branch.then, false, list);
      if (!test(c, n->as.branch.test, false, &no) || !test(c, n->as.branch.then, sense, list) ||
          !vs_emit_branch(e, VS_O_JUMP, 0, 0, 0, &end)) return false;
      vs_emit_here(e, no);
      if (otherwise ? !test(c, otherwise, sense, list) : (sense && !vs_emit_branch(e, VS_O_JUMP, 0, 0, 0, list)))
        return false;
      vs_emit_here(e, end);
      return true;
    }
    case VS_AST_LET: {                         /* the form (or a b): (let ((t a)) (if t t b)) */
      vs_core_node *b = n->as.let.body;
      vs_var *v = n->count == 1 ? n->as.let.vars[0] : NULL;
      if (!v || b->kind != VS_AST_IF || v->refs != 2 || v->assigned || v->captured || !b->as.branch.otherwise ||
          b->as.branch.test->kind != VS_AST_LOCAL || b->as.branch.test->as.var != v ||
          b->as.branch.then->kind != VS_AST_LOCAL || b->as.branch.then->as.var != v) break;
      if (sense) return test(c, n->as.let.values[0], true, list) && test(c, b->as.branch.otherwise, true, list);
      vs_jumps yes = 0;
      if (!test(c, n->as.let.values[0], true, &yes) || !test(c, b->as.branch.otherwise, false, list)) return false;
      vs_emit_here(e, yes);
      return true;
    }
    case VS_AST_SEQ:
      if (n->count == 0) break;
      for (uint32_t i = 0; i + 1 < n->count; i++)
        if (!gen(c, n->as.seq.at[i], EFFECT)) return false;
      return test(c, n->as.seq.at[n->count - 1], sense, list);
    case VS_AST_CALL: {
      const vs_inline_row *row = row_of(c, n, &native);
      if (!is_test(row, n)) break;
      vs_core_node *x = n->as.call.at[0];
      if (row->op == VS_O_JNOT && (x->kind == VS_AST_IF || is_test(row_of(c, x, &native), x)))
        return test(c, x, !sense, list);
      if (!operand_of(c, n, 0, &r[0])) return false;
      uint32_t b = 0;
      unsigned op = row->op;
      if (row->way == VS_WAY_TYPE) {
        b = row->immediate;
      } else if (row->args == 2 && row->immediate != VS_O_NONE && small(c, n->as.call.at[1], &bits)) {
        op = row->immediate;
        b = bits;
      } else if (row->args == 2) {
        if (!operand_of(c, n, 1, &r[1]) || !near(c, &r[1], 1)) return false;
        b = r[1];
      }
      if (!near(c, &r[0], 0) || !stands_for(c, n) || !vs_emit_branch(e, op, r[0], b, sense, list)) return false;
      e->next = keep;
      return true;
    }
    default: break;                            /* any other expression is evaluated, and its value is tested */
  }
  if (!operand(c, n, &r[0])) return false;
  e->next = keep;
  return vs_emit_branch(e, sense ? VS_O_JTRUE : VS_O_JFALSE, r[0], 0, 0, list);
}

/* ---- closures ---- */
static bool code_for(compiler *c, vs_core_node *lambda, uint32_t *index) {
  vs_scheme *vm = c->e.ast->vm;
  vs_lambda_info *f = lambda->as.lambda.extra;
  vs_code *code = (vs_code *)(void *)vs_gc_alloc_old(vm, VS_T_CODE, VS_WORDS(vs_code));
  if (!code) return false;
  code->name = lambda->as.lambda.name ? pool(c, lambda->as.lambda.name - 1) : VS_FALSE;
  code->consts = code->ins = code->places = code->inlined = code->params = code->doc = VS_FALSE;
  code->free = f->free_count;
  struct job *j = vs_ast_alloc(c->e.ast, sizeof *j);
  if (!vs_ast_const(c->e.ast, vs_from_object(code), index) || !j) return false;
  f->code = *index + 1;
  *j = (struct job){c->jobs, lambda};
  c->jobs = j;
  return true;
}

static bool gen_lambda(compiler *c, vs_core_node *lambda, uint32_t to) {
  vs_emit *e = &c->e;
  vs_lambda_info *f = lambda->as.lambda.extra;
  uint32_t index, k, target = to < VS_NEAR ? to : VS_NEAR + 4;
  if (!code_for(c, lambda, &index) || !vs_emit_constant(e, index, &k) || !vs_emit_place(e, lambda->pos) ||
      !vs_emit_word(e, VS_INS(VS_O_CLOSURE, target, 0, 0)) || !vs_emit_word(e, k)) return false;
  for (uint32_t i = 0; i < f->free_count; i++) {
    const vs_var *v = f->free[i];
    uint32_t word = vs_info(v)->lambda == e->lambda ? v->reg : 1u << 16 | free_index(c, v);
    if (!vs_emit_word(e, word)) return false;
  }
  if (target == to) return true;
  if (e->most < VS_FAR) e->most = VS_FAR;
  return vs_emit_word(e, VS_INSX(VS_O_FARSTORE, target, to));
}

/* ---- calls ---- */
static bool gen_loop_call(compiler *c, vs_core_node *n, uint32_t to);

/* Allocates the first two registers of a call with `count` arguments: procedure and return slot. Sets *first to the
 * register of the procedure. It is `to` if `reuse` is true and `to` is the last register in use. */
static bool window(compiler *c, uint32_t count, bool reuse, uint32_t to, uint32_t *first) {
  vs_emit *e = &c->e;
  if (reuse && to < VS_NEAR && to + 1 == e->next && to + 2 + count < VS_NEAR) {
    *first = to;
    e->next = to + 1;
  } else {
    if (e->next < VS_FAR && e->next + 2 + count >= VS_NEAR) e->next = VS_FAR;
    if (!vs_emit_register(e, first)) return false;
  }
  uint32_t slot;
  return vs_emit_register(e, &slot);
}

/* Returns true if the global variable is a word of another language, or of a library that was not imported. Such a
 * variable is evaluated before the arguments, so that (defun f (x) x) reports defun and not f. */
static bool unknown_word(const compiler *c, const vs_core_node *global) {
  const vs_cell *cell = vs_as_cell(pool(c, global->as.global.cell));
  return cell->value == VS_UNDEFINED && vs_is_symbol(cell->name) &&
         (vs_is_foreign_word(cell->name) ||
          vs_idtable_get(vs_as_environment(c->e.ast->vm->at.core)->table, cell->name) != VS_VACANT);
}

static bool gen_call(compiler *c, vs_core_node *n, uint32_t to, bool fresh) {
  vs_emit *e = &c->e;
  vs_core_node *f = n->as.call.callee;
  uint32_t keep = e->next, w, k = 0, kw = 0;
  if (f->kind == VS_AST_LOCAL && vs_info(f->as.var)->loop) return gen_loop_call(c, n, to);
  bool done;
  if (!gen_inline(c, n, to, &done)) return false;
  if (done) return true;
  if (!window(c, n->count, fresh, to, &w)) return false;
  bool far = w >= VS_NEAR || n->count > 250 || n->as.call.keywords, global = f->kind == VS_AST_GLOBAL && !far;
  if (global && unknown_word(c, f)) {
    global = false;
    f->pos = n->pos; /* an unknown name as the procedure of a call is reported at the place of the call */
  }
  e->fresh = VS_NO_REGISTER;
  if (!global) {
    if (!gen(c, f, w)) return false;
  }
  for (uint32_t i = 0; i < n->count; i++) {
    uint32_t r;
    if (!vs_emit_register(e, &r) || !gen(c, n->as.call.at[i], r)) return false;
  }
  if (n->as.call.keywords && !vs_emit_constant(e, n->as.call.keywords - 1, &kw)) return false;
  if (n->as.call.keywords) kw++;
  if (global && !vs_emit_constant(e, f->as.global.cell, &k)) return false;
  if (!vs_emit_place(e, n->pos)) return false;
  bool ok;
  if (far)
    ok = vs_emit_word(e, VS_INS(VS_O_CALLX, to == TAIL, 0, 0)) && vs_emit_word(e, w) && vs_emit_word(e, n->count) &&
         vs_emit_word(e, kw);
  else if (global)
    ok = vs_emit_word(e, VS_INS(to == TAIL ? VS_O_TAILG : VS_O_CALLG, w, n->count, 0)) && vs_emit_word(e, k);
  else ok = vs_emit_word(e, VS_INS(to == TAIL ? VS_O_TAIL : VS_O_CALL, w, n->count, 0));
  if (to == EFFECT) ok = ok && vs_emit_op(e, VS_O_DROP, w, 0, 0);      /* DROP also tells the interpreter that the value
                                                                        * of the call is not used */
  e->next = keep;
  return ok && finish(c, w, to);        /* moves the value to its target even after a tail call, since a native
                                         * procedure returns to this instruction */
}

/* Returns true if evaluating n reads v, or if that is not certain. */
static bool reads(const vs_core_node *n, const vs_var *v, int depth) {
  if (!n) return false;
  if (depth > 6) return true;
  switch (n->kind) {
    case VS_AST_CONST: case VS_AST_GLOBAL: return false;
    case VS_AST_LOCAL: return n->as.var == v;
    case VS_AST_CALL:
      if (reads(n->as.call.callee, v, depth + 1)) return true;
      for (uint32_t i = 0; i < n->count; i++)
        if (reads(n->as.call.at[i], v, depth + 1)) return true;
      return false;
    default: return true;
  }
}

/* Returns true if n can be computed directly in a register that n also reads, because only the last instruction of n
 * writes to its target. */
static bool lands_last(compiler *c, const vs_core_node *n) {
  const vs_native *native;
  if (n->kind != VS_AST_CALL)
    return n->kind == VS_AST_CONST || n->kind == VS_AST_GLOBAL || (n->kind == VS_AST_LOCAL && !n->flag);
  const vs_inline_row *row = row_of(c, n, &native);
  return row && (row->way == VS_WAY_VALUE || row->way == VS_WAY_GET || row->way == VS_WAY_FLAT2) &&
         n->count == row->args;
}

static bool gen_loop_call(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  vs_var *loop = n->as.call.callee->as.var;
  vs_var_info *info = vs_info(loop);
  vs_core_node *lambda = loop->value;
  uint32_t keep = e->next;
  struct move { uint32_t from, to; } *moves = vs_ast_alloc(e->ast, n->count * sizeof *moves);
  if (!moves) return false;
  size_t count = 0;
  for (uint32_t i = 0; i < n->count; i++) {
    vs_core_node *arg = n->as.call.at[i];
    vs_var *p = lambda->as.lambda.params[i].var;
    if (arg->kind == VS_AST_LOCAL && arg->as.var == p && !boxed(p)) continue;
    bool direct = lands_last(c, arg);
    for (uint32_t j = i + 1; direct && j < n->count; j++) direct = !reads(n->as.call.at[j], p, 0);
    uint32_t r = p->reg;
    if (direct) {
      e->fresh = VS_NO_REGISTER;
    } else {
      if (!vs_emit_register(e, &r)) return false;
      moves[count++] = (struct move){r, p->reg};
    }
    if (!gen(c, arg, r)) return false;
  }
  for (size_t i = 0; i < count; i++)
    if (!vs_emit_op(e, VS_O_MOVE, moves[i].to, moves[i].from, 0)) return false;
  e->next = keep;
  if (info->emitted) return vs_emit_back(e, VS_O_LOOP, info->top);
  info->emitted = true;
  info->top = (uint32_t)e->count;
  for (uint32_t i = 0; i < lambda->count; i++) {          /* a variable of a loop that is captured and assigned gets a
                                                           * new box in each iteration */
    vs_var *p = lambda->as.lambda.params[i].var;
    if (boxed(p) && !vs_emit_op(e, VS_O_BOX, p->reg, p->reg, 0)) return false;
  }
  size_t scope = e->variable_count;
  for (uint32_t i = 0; i < lambda->count; i++)
    if (!vs_emit_variable(e, lambda->as.lambda.params[i].var)) return false;
  if (!gen(c, lambda->as.lambda.body, to)) return false;
  vs_emit_scope_end(e, scope);
  return true;
}

/* ---- binding forms ---- */
static bool gen_let(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next;
  size_t scope = e->variable_count;
  for (uint32_t i = 0; i < n->count; i++) {
    vs_var *v = n->as.let.vars[i];
    if (!vs_emit_register(e, &v->reg) || !gen(c, n->as.let.values[i], v->reg)) return false;
    if (boxed(v) && !vs_emit_op(e, VS_O_BOX, v->reg, v->reg, 0)) return false;
  }
  for (uint32_t i = 0; i < n->count; i++)
    if (!vs_emit_variable(e, n->as.let.vars[i])) return false;
  if (!gen(c, n->as.let.body, to)) return false;
  vs_emit_scope_end(e, scope);
  e->next = keep;
  return true;
}

/* Creates the closures of the variables number `from` to `to` - 1 of the FIX n. These closures may capture each
 * other. */
static bool gen_run(compiler *c, vs_core_node *n, uint32_t from, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next, temp;
  VS_ASSERT(from <= to && to <= n->count);
  for (uint32_t i = from; i < to; i++) {
    vs_var *v = n->as.let.vars[i];
    if (vs_info(v)->loop) continue;
    if (!boxed(v)) {
      if (!gen_lambda(c, v->value, v->reg)) return false;
      continue;
    }
    if (!vs_emit_register(e, &temp) || !gen_lambda(c, v->value, temp) || !vs_emit_op(e, VS_O_SETBOX, v->reg, temp, 0))
      return false;
    e->next = keep;
  }
  for (uint32_t i = from; i < to; i++) {
    vs_var *v = n->as.let.vars[i];
    if (vs_info(v)->loop) continue;
    const vs_lambda_info *f = v->value->as.lambda.extra;
    for (uint32_t s = 0; s < f->free_count; s++) {
      const vs_var *g = f->free[s];
      if (vs_info(g)->fix != n || boxed(g) || vs_info(g)->lambda != e->lambda) continue;
      uint32_t j = i;
      while (j < to && n->as.let.vars[j] != g) j++;
      if (j == to) continue;                   /* variable g has its value already when the closure of variable v is
                                                * created */
      uint32_t closure = v->reg;
      if (boxed(v) && (!vs_emit_register(e, &temp) || !vs_emit_op(e, VS_O_UNBOX, temp, v->reg, 0))) return false;
      if (boxed(v)) closure = temp;
      if (!vs_emit_op1(e, VS_O_PATCH, closure, g->reg, 0, s)) return false;
      e->next = keep;
    }
  }
  return true;
}

static bool gen_fix(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next;
  size_t scope = e->variable_count;
  for (uint32_t i = 0; i < n->count; i++) {
    vs_var *v = n->as.let.vars[i];
    if (vs_info(v)->loop) {
      for (uint32_t p = 0; p < v->value->count; p++)
        if (!vs_emit_register(e, &v->value->as.lambda.params[p].var->reg)) return false;
      continue;
    }
    if (!vs_emit_register(e, &v->reg)) return false;
    if ((boxed(v) || vs_info(v)->early) && !load_value(c, VS_UNDEFINED, v->reg)) return false;
    if (boxed(v) && !vs_emit_op(e, VS_O_BOX, v->reg, v->reg, 0)) return false;
  }
  for (uint32_t i = 0; i < n->count;) {
    vs_var *v = n->as.let.vars[i];
    if (v->value) {
      uint32_t end = i;
      while (end < n->count && n->as.let.vars[end]->value) end++;
      if (!gen_run(c, n, i, end)) return false;
      i = end;
      continue;
    }
    uint32_t temp, before = e->next;
    if (!vs_emit_register(e, &temp) || !gen(c, n->as.let.values[i], temp)) return false;
    if (!vs_emit_op(e, boxed(v) ? VS_O_SETBOX : VS_O_MOVE, v->reg, temp, 0) || !vs_emit_variable(e, v)) return false;
    e->next = before;
    i++;
  }
  if (!gen(c, n->as.let.body, to)) return false;
  vs_emit_scope_end(e, scope);
  e->next = keep;
  return true;
}

static bool gen_set(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  vs_var *v = n->as.set.var;
  uint32_t keep = e->next, value, box;
  if (!boxed(v)) {                             /* a captured variable in a register of this activation gets a box in the
                                                * closure that captures it */
    value = v->reg;
    bool direct = lands_last(c, n->as.set.value);
    if ((!direct && !vs_emit_register(e, &value)) || !gen(c, n->as.set.value, value) ||
        (!direct && !vs_emit_op(e, VS_O_MOVE, v->reg, value, 0))) return false;
    e->next = keep;
    if (to == EFFECT) return true;
    if (!landing(c, to, &value) || !load_value(c, VS_UNSPECIFIC, value) || !finish(c, value, to)) return false;
    e->next = keep;
    return true;
  }
  if (!vs_emit_register(e, &value) || !gen(c, n->as.set.value, value)) return false;
  box = v->reg;
  if (vs_info(v)->lambda != e->lambda && (!vs_emit_register(e, &box) || !load_raw(c, v, box))) return false;
  if (!vs_emit_op(e, VS_O_SETBOX, box, value, 0)) return false;
  if (to != EFFECT &&
      (!load_value(c, VS_UNSPECIFIC, is_value(to) ? to : value) || !finish(c, is_value(to) ? to : value, to)))
    return false;
  e->next = keep;
  return true;
}

static bool gen_global_set(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next, value, k;
  if (!vs_emit_register(e, &value) || !gen(c, n->as.global.value, value) ||
      !vs_emit_constant(e, n->as.global.cell, &k) || !vs_emit_place(e, n->pos) ||
      !vs_emit_op1(e, n->kind == VS_AST_DEFGLOBAL ? VS_O_DEFGLOBAL : VS_O_SETGLOBAL, value, 0, 0, k))
    return false;
  if (to != EFFECT &&
      (!load_value(c, VS_UNSPECIFIC, is_value(to) ? to : value) || !finish(c, is_value(to) ? to : value, to)))
    return false;
  e->next = keep;
  return true;
}

static bool gen_check(compiler *c, vs_core_node *n, uint32_t to, bool fresh) {
  vs_emit *e = &c->e;
  vs_scheme *vm = e->ast->vm;
  vs_core_node *p = n->as.check.predicate;
  if (p->kind == VS_AST_GLOBAL) {
    vs_value v = vs_as_cell(pool(c, p->as.global.cell))->value;
    if (vs_as_cell(pool(c, p->as.global.cell))->h.flags & VS_F_CONSTANT && vs_is(v, VS_T_NATIVE) &&
        vs_is_symbol(vs_as_native(v)->name) && strcmp(vs_as_symbol(vs_as_native(v)->name)->name, "any?") == 0)
      return gen(c, n->as.check.value, to);
  }
  VS_ROOTS(vm, r, 1);
  uint32_t keep = e->next, w, at[3], k, kn;
  if (!vs_make_vector(vm, 3, VS_FALSE, &r[0])) return false;
  vs_vector *info = vs_as_vector(r[0]);        /* a new object needs no write barrier */
  info->at[0] = pool(c, n->as.check.name);
  info->at[1] = pool(c, n->as.check.text);
  info->at[2] = pool(c, n->as.check.who);
  if (!vs_emit_value(e, r[0], &k) || !window(c, 3, fresh, to, &w)) return false;
  for (int i = 0; i < 3; i++) {
    if (!vs_emit_register(e, &at[i])) return false;
    if (i < 2 && !gen(c, i == 0 ? p : n->as.check.value, at[i])) return false;
  }
  if (!vs_emit_place(e, n->pos)) return false;
  if (w < VS_NEAR) {
    if (!vs_emit_op1(e, VS_O_CHECK, w, 0, 0, k)) return false;
  } else {
    if (!vs_emit_value(e, vm->at.check, &kn) || !load_value(c, vm->at.check, w) || !load_value(c, r[0], at[2]) ||
        !vs_emit_place(e, n->pos) || !vs_emit_word(e, VS_INS(VS_O_CALLX, 0, 0, 0)) || !vs_emit_word(e, w) ||
        !vs_emit_word(e, 3) || !vs_emit_word(e, 0))
      return false;
  }
  e->next = keep;
  return finish(c, w, to);
}

static bool gen_case(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  uint32_t keep = e->next, r, first = 0, target;
  if (e->next + n->count + 1 >= VS_NEAR)
    return vs_fail_at(e->ast->vm, e->ast->vm->sym.syntax, n->pos, VS_NIL,
                      "too many variables around this case-lambda: move it into a procedure of its own");
  for (uint32_t i = 0; i < n->count; i++) {
    if (!vs_emit_register(e, &r) || !gen_lambda(c, n->as.clauses.at[i], r)) return false;
    if (i == 0) first = r;
  }
  if (!landing(c, to, &target) || !vs_emit_op(e, VS_O_CASE, target, first, n->count) || !finish(c, target, to))
    return false;
  e->next = keep;
  return true;
}

static bool gen_if(compiler *c, vs_core_node *n, uint32_t to, bool fresh) {
  vs_emit *e = &c->e;
  vs_jumps no = 0, end = 0;
  if (!test(c, n->as.branch.test, false, &no)) return false;
  e->fresh = fresh ? to : VS_NO_REGISTER;
  if (!gen(c, n->as.branch.then, to)) return false;
  if (!n->as.branch.otherwise && to == EFFECT) { vs_emit_here(e, no); return true; }
  if (to != TAIL && !vs_emit_branch(e, VS_O_JUMP, 0, 0, 0, &end)) return false;
  vs_emit_here(e, no);
  e->fresh = fresh ? to : VS_NO_REGISTER;
  if (n->as.branch.otherwise) {
    if (!gen(c, n->as.branch.otherwise, to)) return false;
  } else {
    uint32_t keep = e->next, r;
    if (!landing(c, to, &r) || !load_value(c, VS_UNSPECIFIC, r) || !finish(c, r, to)) return false;
    e->next = keep;
  }
  vs_emit_here(e, end);
  return true;
}

static bool gen(compiler *c, vs_core_node *n, uint32_t to) {
  vs_emit *e = &c->e;
  if (!vs_poll(e->ast->vm, 16) || !cover(c, n)) return false;
  bool fresh = e->fresh == to;
  uint32_t keep = e->next, r;
  e->fresh = VS_NO_REGISTER;
  switch (n->kind) {
    case VS_AST_CONST:
      if (to == EFFECT) return true;
      if (!landing(c, to, &r) || !load_value(c, pool(c, n->as.constant), r) || !finish(c, r, to)) return false;
      e->next = keep;
      return true;
    case VS_AST_LOCAL:
      if (to == EFFECT && !n->flag) return true;
      if (to == TAIL) {
        if (!operand(c, n, &r)) return false;
      } else if (!landing(c, to, &r) || !load_var(c, n, r)) {
        return false;
      }
      e->next = keep;
      return finish(c, r, to);
    case VS_AST_GLOBAL:
      if (!landing(c, to, &r) || !load_global(c, n, r) || !finish(c, r, to)) return false;
      e->next = keep;
      return true;
    case VS_AST_SETLOCAL: return gen_set(c, n, to);
    case VS_AST_SETGLOBAL: case VS_AST_DEFGLOBAL: return gen_global_set(c, n, to);
    case VS_AST_IF: return gen_if(c, n, to, fresh);
    case VS_AST_SEQ:
      for (uint32_t i = 0; i < n->count; i++) {
        bool last = i + 1 == n->count;
        if (last && fresh) e->fresh = to;
        if (!gen(c, n->as.seq.at[i], last ? to : EFFECT)) return false;
      }
      if (n->count || to == EFFECT) return true;
      if (!landing(c, to, &r) || !load_value(c, VS_UNSPECIFIC, r) || !finish(c, r, to)) return false;
      e->next = keep;
      return true;
    case VS_AST_CALL: return gen_call(c, n, to, fresh);
    case VS_AST_LET: return gen_let(c, n, to);
    case VS_AST_FIX: return gen_fix(c, n, to);
    case VS_AST_LAMBDA:
      if (to == EFFECT) return true;
      if (!landing(c, to, &r) || !gen_lambda(c, n, r) || !finish(c, r, to)) return false;
      e->next = keep;
      return true;
    case VS_AST_CASE: return to == EFFECT || gen_case(c, n, to);
    case VS_AST_CHECK: return gen_check(c, n, to, fresh);
  }
  return false;
}

/* ---- compiling a procedure ---- */
static bool set_parameters(compiler *c, vs_core_node *l, vs_value code) {
  vs_scheme *vm = c->e.ast->vm;
  vs_vector *names =
      (vs_vector *)(void *)vs_gc_alloc_old(vm, VS_T_VECTOR, 2 + l->count + (l->as.lambda.rest ? 1u : 0u));
  if (!names) return false;
  vs_code *k = vs_as_code(code);
  names->length = l->count + (l->as.lambda.rest ? 1u : 0u);
  for (uint32_t i = 0; i < l->count; i++) {
    const vs_param *p = &l->as.lambda.params[i];
    names->at[i] = pool(c, p->keyword ? p->keyword - 1 : p->var->name);
    if (p->keyword) k->keywords++;
    else if (p->fallback) k->optional++;
    else k->required++;
  }
  if (l->as.lambda.rest) names->at[l->count] = pool(c, l->as.lambda.rest->name);
  k->flags = l->as.lambda.rest ? VS_CODE_REST : k->optional || k->keywords ? 0 : VS_CODE_SIMPLE;
  vs_gc_store(vm, k, &k->params, vs_from_object(names));
  return true;
}

static bool gen_parameters(compiler *c, vs_core_node *l) {
  vs_emit *e = &c->e;
  uint32_t count = l->count + (l->as.lambda.rest ? 1u : 0u);
  if (count >= VS_NEAR)
    return vs_fail_at(e->ast->vm, e->ast->vm->sym.syntax, l->pos, VS_NIL, "too many parameters: pass a list");
  for (uint32_t i = 0; i < l->count; i++)
    if (!vs_emit_register(e, &l->as.lambda.params[i].var->reg)) return false;
  if (l->as.lambda.rest && !vs_emit_register(e, &l->as.lambda.rest->reg)) return false;
  for (uint32_t i = 0; i < l->count; i++) {
    vs_param *p = &l->as.lambda.params[i];
    vs_jumps given = 0;
    uint32_t k;
    if (p->fallback) {
      if (!vs_emit_branch(e, VS_O_JGIVEN, p->var->reg, 0, 0, &given)) return false;
      e->fresh = VS_NO_REGISTER;
      if (!gen(c, p->fallback, p->var->reg)) return false;
      vs_emit_here(e, given);
    } else if (p->keyword) {
      if (!vs_emit_branch(e, VS_O_JGIVEN, p->var->reg, 0, 0, &given) || !vs_emit_constant(e, p->keyword - 1, &k) ||
          !vs_emit_place(e, l->pos) || !vs_emit_op1(e, VS_O_MISSING, 0, 0, 0, k))
        return false;
      vs_emit_here(e, given);
    }
    if (boxed(p->var) && !vs_emit_op(e, VS_O_BOX, p->var->reg, p->var->reg, 0)) return false;
  }
  for (uint32_t i = 0; i < l->count; i++) /* the name of a keyword parameter's variable may differ from its keyword */
    if (l->as.lambda.params[i].keyword && !vs_emit_variable(e, l->as.lambda.params[i].var)) return false;
  vs_var *rest = l->as.lambda.rest;
  return !rest || !boxed(rest) || vs_emit_op(e, VS_O_BOX, rest->reg, rest->reg, 0);
}

/* Returns the procedure's documentation or #f. The documentation is a string at the start of its body that other
 * expressions follow. */
static vs_value doc_of(const compiler *c, const vs_core_node *body) {
  if (body->kind == VS_AST_SEQ && body->count > 1 && body->as.seq.at[0]->kind == VS_AST_CHECK)
    body = body->as.seq.at[body->count - 1];
  const vs_core_node *first = NULL;
  if (body->kind == VS_AST_SEQ && body->count > 1) first = body->as.seq.at[0];
  /* A string before definitions: body.c binds it to the name _. */
  if (body->kind == VS_AST_FIX && body->count > 0) {
    vs_value name = pool(c, body->as.let.vars[0]->name);
    if (vs_is_symbol(name) && strcmp(vs_as_symbol(name)->name, "_") == 0) first = body->as.let.values[0];
  }
  bool text = first && first->kind == VS_AST_CONST && vs_is_string(pool(c, first->as.constant));
  return text ? pool(c, first->as.constant) : VS_FALSE;
}

/* Compiles a LAMBDA into its code object. */
static bool compile_procedure(compiler *c, vs_core_node *l) {
  vs_ast *ast = c->e.ast;
  vs_value code = ast->pool[((vs_lambda_info *)l->as.lambda.extra)->code - 1];
  VS_ASSERT(l->kind == VS_AST_LAMBDA);
  c->e = (vs_emit){.ast = ast, .lambda = l, .fresh = VS_NO_REGISTER};
  c->covered = NULL;
  vs_gc_store(ast->vm, vs_as_code(code), &vs_as_code(code)->doc, doc_of(c, l->as.lambda.body));
  bool ok = set_parameters(c, l, code) && gen_parameters(c, l) && gen(c, l->as.lambda.body, TAIL) &&
            vs_emit_finish(&c->e, code);
  vs_code *k = vs_as_code(code);
  uint32_t record = ok && k->flags == VS_CODE_SIMPLE ? vs_code_record(c->e.ins, c->e.count, k->required) : 0;
  if (record) k->flags = record;
  vs_emit_close(&c->e);
  return ok;
}

bool vs_compile(vs_scheme *vm, vs_ast *ast, vs_core_node *body, vs_value *out) {
  compiler c = {.e = {.ast = ast}};
  vs_core_node *top = vs_ast_list(ast, VS_AST_LAMBDA, 0, body->pos);
  if (!top) return false;
  top->as.lambda.body = body;
  uint32_t index;
  if (!vs_analyse(ast, top) || !code_for(&c, top, &index)) return false;
  while (c.jobs) {
    vs_core_node *l = c.jobs->lambda;
    c.jobs = c.jobs->next;
    if (!compile_procedure(&c, l)) return false;
  }
  vs_closure *closure = (vs_closure *)(void *)vs_gc_alloc(vm, VS_T_CLOSURE, VS_WORDS(vs_closure));
  if (!closure) return false;
  closure->code = ast->pool[index];
  *out = vs_from_object(closure);
  return true;
}
