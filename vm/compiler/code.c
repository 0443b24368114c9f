/* Contains the facts about each opcode, and searches the tables of compiled procedures. */
#include "vm/compiler/code.h"

static const struct { const char *operands; uint8_t extra, generic; } ops[VS_O_COUNT] = {
#define VS_OP(name, operands, extra, generic) {operands, extra, VS_O_##generic},
#include "vm/compiler/opcodes.def"
#undef VS_OP
};

int vs_op_generic(uint32_t op) {
  VS_ASSERT(op < VS_O_COUNT);
  return ops[op].generic;
}
const char *vs_op_operands(uint32_t op) {
  VS_ASSERT(op < VS_O_COUNT);
  return ops[op].operands;
}
uint32_t vs_op_extra(uint32_t op) {
  VS_ASSERT(op < VS_O_COUNT);
  return ops[op].extra;
}

/* Returns the last entry of the table of places whose instruction is at or before pc, or NULL. */
static const vs_place *place_at(const vs_code *code, uint32_t pc) {
  vs_value places = vs_is_pair(code->places) ? vs_car(code->places) : code->places;
  if (!vs_is(places, VS_T_BYTES)) return NULL;
  const vs_place *at = (const vs_place *)(const void *)vs_as_bytes(places)->at;
  size_t low = 0, high = vs_as_bytes(places)->length / sizeof *at;
  while (low < high) {                 /* binary search: `low` becomes the index of the first entry after pc */
    size_t mid = (low + high) / 2;
    if (at[mid].pc <= pc) low = mid + 1; else high = mid;
  }
  return low ? &at[low - 1] : NULL;
}

vs_pos vs_code_place(const vs_code *code, uint32_t pc) {
  if (vs_is_fixnum(code->places)) return vs_pos_of(code->places);
  const vs_place *p = place_at(code, pc);
  return p ? (vs_pos)p->high << 32 | p->low : 0;
}

vs_pos vs_code_near_place(const vs_code *code, uint32_t pc) {
  vs_pos exact = vs_code_place(code, pc);
  const vs_place *p = exact ? NULL : place_at(code, UINT32_MAX);
  return p ? (vs_pos)p->high << 32 | p->low : exact;
}

uint32_t vs_code_place_start(const vs_code *code, uint32_t pc) {
  const vs_place *p = place_at(code, pc);
  return p ? p->pc : 0;
}

const vs_vector *vs_code_variables(const vs_code *code) {
  return vs_is_pair(code->places) ? vs_as_vector(vs_cdr(code->places)) : NULL;
}

uint32_t vs_code_inlined(const vs_code *code, uint32_t pc) {
  const vs_inlined *at = (const vs_inlined *)(const void *)vs_as_bytes(code->inlined)->at;
  size_t low = 0, high = vs_as_bytes(code->inlined)->length / sizeof *at;
  while (low < high) {
    size_t mid = (low + high) / 2;
    if (at[mid].pc < pc) low = mid + 1; else high = mid;
  }
  return at[low].constant;
}

static bool is_return(uint32_t ins, uint32_t a) { return ins == VS_INS(VS_O_RETURN, a, 0, 0); }

/* Returns true if the two instructions at `ins` load and return the immediate value v. */
static bool gives(const uint32_t *ins, vs_value v) {
  return (ins[0] & 255) == VS_O_IMM && VS_IMMEDIATE(VS_B(ins[0]), VS_C(ins[0])) == v && is_return(ins[1], VS_A(ins[0]));
}

/* Returns true if the instructions create and return a record. They are: an instruction that loads the record type, a
 * move or an immediate value for each field, RECORD, RETURN. */
static bool is_record_maker(const uint32_t *ins, size_t words, uint32_t type, uint32_t required) {
  uint32_t fields = 0;
  for (; words > 2; ins++, words--, fields++) {
    uint32_t op = *ins & 255;
    bool known = op == VS_O_IMM || (op == VS_O_MOVE && VS_B(*ins) < required);
    if (!known || VS_A(*ins) != type + 1 + fields) return false;
  }
  return words == 2 && (ins[0] & 255) == VS_O_RECORD && VS_B(ins[0]) == type && VS_C(ins[0]) == fields + 1 &&
         is_return(ins[1], VS_A(ins[0]));
}

uint32_t vs_code_record(const uint32_t *ins, size_t words, uint32_t required) {
  size_t first = words && (*ins & 255) == VS_O_FREE ? 1 : 2;
  if (words < first + 2 || (first == 2 && (*ins & 255) != VS_O_GLOBAL)) return 0;
  uint32_t type = VS_A(*ins);
  ins += first;
  words -= first;
  uint32_t a = VS_A(*ins);
  if (required == 1 && words == 3 && *ins == VS_INS(VS_O_RECREF, a, 0, type) && is_return(ins[2], a))
    return VS_CODE_GET;
  if (required == 2 && words == 4 && *ins == VS_INS(VS_O_RECSET, 0, type, 1) && gives(ins + 2, VS_UNSPECIFIC))
    return VS_CODE_SET;
  if (required == 1 && words == 6 && *ins == VS_INS(VS_O_JRECORD, 0, type, 0) && ins[1] == 2 &&
      gives(ins + 2, VS_TRUE) && gives(ins + 4, VS_FALSE)) return VS_CODE_TEST;
  return is_record_maker(ins, words, type, required) ? VS_CODE_MAKE : 0;
}

void vs_cell_redefine(vs_value v) {
  vs_cell *cell = vs_as_cell(v);
  VS_ASSERT(cell->h.flags & VS_F_CONSTANT);
  cell->h.flags &= (uint16_t)~VS_F_CONSTANT;
  for (vs_value l = cell->users; vs_is_pair(l); l = vs_cdr(l)) {
    vs_code *code = vs_as_code(vs_car(l));
    if (code->flags & VS_CODE_RECORD) code->flags = VS_CODE_SIMPLE;
    const vs_inlined *at = (const vs_inlined *)(const void *)vs_as_bytes(code->inlined)->at;
    for (size_t i = 0, n = vs_as_bytes(code->inlined)->length / sizeof *at; i < n; i++) {
      if (vs_code_consts(code)[at[i].constant] != v) continue;
      uint32_t *ins = &vs_code_ins(code)[at[i].pc];
      *ins = (*ins & ~255u) | (uint32_t)vs_op_generic(*ins & 255);
    }
  }
  cell->users = VS_NIL;
}
