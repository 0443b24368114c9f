/* Emits the instructions of one procedure. */
#include "vm/compiler/emit.h"

#include "vm/compiler/analyse.h"
#include "vm/machine/native.h"

static bool grow(vs_emit *e, void *array, size_t *room, size_t count, size_t size) {
  if (count < *room) return true;
  size_t more = *room ? *room * 2 : 64;
  void **p = array, *q = vs_mem(e->ast->vm, *p, *room * size, more * size);
  if (!q) return false;
  *p = q;
  *room = more;
  return true;
}

void vs_emit_close(vs_emit *e) {
  vs_scheme *vm = e->ast->vm;
  if (e->ins) vs_mem(vm, e->ins, e->room * sizeof *e->ins, 0);
  if (e->consts) vs_mem(vm, e->consts, e->const_room * sizeof *e->consts, 0);
  if (e->places) vs_mem(vm, e->places, e->place_room * sizeof *e->places, 0);
  if (e->inlined) vs_mem(vm, e->inlined, e->inlined_room * sizeof *e->inlined, 0);
  if (e->variables) vs_mem(vm, e->variables, e->variable_room * sizeof *e->variables, 0);
  e->ins = NULL; e->consts = NULL; e->places = NULL; e->inlined = NULL; e->variables = NULL;
}

bool vs_emit_register(vs_emit *e, uint32_t *out) {
  if (e->next >= VS_NEAR && e->next < VS_FAR) e->next = VS_FAR;
  if (e->next >= VS_MOST_REGISTERS)
    return vs_fail_at(e->ast->vm, e->ast->vm->sym.syntax, e->lambda->pos, VS_NIL,
                      "this procedure is too large: split it");
  *out = e->fresh = e->next++;
  if (e->next > e->most) e->most = e->next;
  return true;
}

bool vs_emit_word(vs_emit *e, uint32_t w) {
  if (!grow(e, &e->ins, &e->room, e->count, sizeof *e->ins)) return false;
  e->ins[e->count++] = w;
  return true;
}

/* Copies between a scratch register and a register with a number from VS_FAR, which instructions cannot name. */
static bool far_copy(vs_emit *e, unsigned op, uint32_t scratch, uint32_t far) {
  VS_ASSERT(far >= VS_FAR && scratch < VS_FAR);
  if (e->most < VS_FAR) e->most = VS_FAR;
  return vs_emit_word(e, VS_INSX(op, scratch, far));
}

/* Copies operands from registers with numbers from VS_FAR, which instructions cannot name, to scratch registers. Sets
 * *store to the result's register if it has such a number, otherwise to VS_NO_REGISTER. */
static bool operands(vs_emit *e, unsigned op, uint32_t r[3], uint32_t *store) {
  const char *how = vs_op_operands(op);
  *store = VS_NO_REGISTER;
  for (unsigned i = 0; i < 3; i++) {
    if ((how[i] != 's' && how[i] != 'd') || r[i] < VS_FAR) continue;
    uint32_t far = r[i];
    r[i] = VS_NEAR + i;
    if (how[i] == 'd') *store = far;
    else if (!far_copy(e, VS_O_FARLOAD, r[i], far)) return false;
  }
  return true;
}

/* Emits an instruction whose operands are registers that it can name. */
static bool encode(vs_emit *e, unsigned op, const uint32_t r[3]) {
  VS_ASSERT(r[0] < VS_FAR);
  return vs_emit_word(e, vs_op_operands(op)[1] == 'x' ? VS_INSX(op, r[0], r[1]) : VS_INS(op, r[0], r[1], r[2]));
}

bool vs_emit_op(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t r[3] = {a, b, c}, store;
  return operands(e, op, r, &store) && encode(e, op, r) &&
         (store == VS_NO_REGISTER || far_copy(e, VS_O_FARSTORE, r[0], store));
}

bool vs_emit_op1(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, uint32_t word) {
  uint32_t r[3] = {a, b, c}, store;
  return operands(e, op, r, &store) && encode(e, op, r) && vs_emit_word(e, word) &&
         (store == VS_NO_REGISTER || far_copy(e, VS_O_FARSTORE, r[0], store));
}

bool vs_emit_branch(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, vs_jumps *list) {
  uint32_t r[3] = {a, b, c}, store;
  if (!operands(e, op, r, &store) || !encode(e, op, r) || !vs_emit_word(e, *list)) return false;
  *list = (uint32_t)e->count;                 /* the list of jumps is 1 + index of its last offset word */
  return true;
}

bool vs_emit_back(vs_emit *e, unsigned op, uint32_t target) {
  VS_ASSERT(target <= e->count);
  return vs_emit_word(e, VS_INS(op, 0, 0, 0)) && vs_emit_word(e, (uint32_t)((int64_t)target - (int64_t)e->count - 1));
}

void vs_emit_here(vs_emit *e, vs_jumps list) {
  while (list) {
    uint32_t at = list - 1, before = e->ins[at];
    VS_ASSERT(at < e->count && before < list); /* goes backwards through the list of jumps: the offset word of each jump
                                                * contains the list of the jumps before it */
    e->ins[at] = (uint32_t)(e->count - at - 1);
    list = before;
  }
}

bool vs_emit_constant(vs_emit *e, uint32_t index, uint32_t *out) {
  const vs_value *pool = e->ast->pool;
  VS_ASSERT(index < e->ast->pool_count);
  for (size_t i = e->const_count, tries = 0; i-- > 0 && tries < 64; tries++)
    if (pool[e->consts[i]] == pool[index]) { *out = (uint32_t)i; return true; }
  if (!grow(e, &e->consts, &e->const_room, e->const_count, sizeof *e->consts)) return false;
  e->consts[e->const_count] = index;
  *out = (uint32_t)e->const_count++;
  return true;
}

bool vs_emit_value(vs_emit *e, vs_value v, uint32_t *out) {
  uint32_t index;
  return vs_ast_const(e->ast, v, &index) && vs_emit_constant(e, index, out);
}

bool vs_emit_place(vs_emit *e, vs_pos pos) {
  if (e->place_count && e->places[e->place_count - 1].pc == e->count) e->place_count--;
  if (!grow(e, &e->places, &e->place_room, e->place_count, sizeof *e->places)) return false;
  e->places[e->place_count++] = (vs_place){(uint32_t)e->count, (uint32_t)(pos >> 32), (uint32_t)pos};
  return true;
}

bool vs_emit_inlined(vs_emit *e, uint32_t cell) {
  if (!grow(e, &e->inlined, &e->inlined_room, e->inlined_count, sizeof *e->inlined)) return false;
  e->inlined[e->inlined_count++] = (vs_inlined){(uint32_t)e->count, cell};
  return true;
}

/* Returns true if the debugger shows the variable: it is in the source text, and is no procedure that is defined within
 * a body. */
static bool worth_showing(const vs_emit *e, const vs_var *v) {
  vs_value name = e->ast->pool[v->name];
  return e->ast->vm->config.keep_calls && !v->introduced && !v->value && vs_is_symbol(name) &&
         strcmp(vs_as_symbol(name)->name, "_") != 0;
}

bool vs_emit_variable(vs_emit *e, const vs_var *v) {
  if (!worth_showing(e, v)) return true;
  if (!grow(e, &e->variables, &e->variable_room, e->variable_count, sizeof *e->variables)) return false;
  e->variables[e->variable_count++] = (vs_named_register){v->name, v->reg, (uint32_t)e->count, UINT32_MAX};
  return true;
}

void vs_emit_scope_end(vs_emit *e, size_t first) {
  VS_ASSERT(first <= e->variable_count);
  for (size_t i = first; i < e->variable_count; i++)
    if (e->variables[i].to == UINT32_MAX) e->variables[i].to = (uint32_t)e->count;
}

/* Adds the captured variables to the debugger's table of variables. */
static bool captured_variables(vs_emit *e) {
  const vs_lambda_info *f = e->lambda->as.lambda.extra;
  for (uint32_t i = 0; i < f->free_count; i++) {
    if (!worth_showing(e, f->free[i])) continue;
    if (!grow(e, &e->variables, &e->variable_room, e->variable_count, sizeof *e->variables)) return false;
    e->variables[e->variable_count++] = (vs_named_register){f->free[i]->name, -1 - (int64_t)i, 0, UINT32_MAX};
  }
  return true;
}

/* Adds the debugger's table of variables, if it is not empty, to code->places. */
static bool add_variables(vs_emit *e, vs_code *c) {
  vs_scheme *vm = e->ast->vm;
  VS_ROOTS(vm, r, 2);
  if (!captured_variables(e)) return false;
  if (!e->variable_count) return true;
  if (!vs_make_vector(vm, e->variable_count * VS_VARIABLE_WORDS, VS_FALSE, &r[0])) return false;
  for (size_t i = 0; i < e->variable_count; i++) {
    vs_value *to = vs_as_vector(r[0])->at + i * VS_VARIABLE_WORDS;
    to[1] = vs_fix(e->variables[i].where);
    to[2] = vs_fix(e->variables[i].from);
    to[3] = vs_fix(e->variables[i].to);
    vs_gc_store(vm, vs_as_vector(r[0]), &to[0], e->ast->pool[e->variables[i].name]);
  }
  if (!vs_cons(vm, c->places, r[0], &r[1])) return false;
  vs_gc_store(vm, c, &c->places, r[1]);
  return true;
}

/* Copies n bytes to a new object in old space, where objects do not move. The interpreter keeps addresses of these
 * bytes. */
static bool old_bytes(vs_scheme *vm, const void *at, size_t n, vs_value *out) {
  vs_bytes *b = (vs_bytes *)(void *)vs_gc_alloc_old(vm, VS_T_BYTES, 2 + (n + 7) / 8);
  if (!b) return false;
  b->length = n;
  if (n) memcpy(b->at, at, n);
  *out = vs_from_object(b);
  return true;
}

bool vs_emit_finish(vs_emit *e, vs_value code) {
  vs_scheme *vm = e->ast->vm;
  VS_ROOTS(vm, r, 1);
  vs_code *c = vs_as_code(code);              /* objects in old space do not move */
  VS_ASSERT(!vs_gc_is_young(vm, vs_object_of(code)));
  if (e->count >= 1u << 28)
    return vs_fail_at(vm, vm->sym.syntax, e->lambda->pos, VS_NIL, "this procedure is too large: split it");
  vs_vector *consts = (vs_vector *)(void *)vs_gc_alloc_old(vm, VS_T_VECTOR, 2 + e->const_count);
  if (!consts) return false;
  consts->length = e->const_count;
  for (size_t i = 0; i < e->const_count; i++) consts->at[i] = e->ast->pool[e->consts[i]];
  vs_gc_store(vm, c, &c->consts, vs_from_object(consts));
  if (!old_bytes(vm, e->ins, e->count * sizeof *e->ins, &r[0])) return false;
  vs_gc_store(vm, c, &c->ins, r[0]);
  if (!old_bytes(vm, e->places, e->place_count * sizeof *e->places, &r[0])) return false;
  vs_gc_store(vm, c, &c->places, r[0]);
  if (!add_variables(e, c)) return false;
  if (!old_bytes(vm, e->inlined, e->inlined_count * sizeof *e->inlined, &r[0])) return false;
  vs_gc_store(vm, c, &c->inlined, r[0]);
  c->registers = e->most;
  for (size_t i = 0; i < e->inlined_count; i++) {
    vs_cell *cell = vs_as_cell(vs_code_consts(c)[e->inlined[i].constant]);
    if (vs_is_pair(cell->users) && vs_car(cell->users) == code) continue;
    r[0] = vs_from_object(cell);
    vs_value users;
    if (!vs_cons(vm, code, cell->users, &users)) return false;
    cell = vs_as_cell(r[0]);
    vs_gc_store(vm, cell, &cell->users, users);
  }
  return true;
}
