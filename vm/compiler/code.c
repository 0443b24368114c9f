/* Owns what is known of each opcode, and the look-ups in a procedure's tables. */
#include "vm/compiler/code.h"

static const struct { const char *operands; uint8_t extra, generic; } ops[VS_O_COUNT] = {
#define VS_OP(name, operands, extra, generic) {operands, extra, VS_O_##generic},
#include "vm/compiler/opcodes.def"
#undef VS_OP
};

int vs_op_generic(uint32_t op) { return ops[op].generic; }
const char *vs_op_operands(uint32_t op) { return ops[op].operands; }
uint32_t vs_op_extra(uint32_t op) { return ops[op].extra; }

vs_pos vs_code_place(const vs_code *code, uint32_t pc) {
  if (vs_is_fixnum(code->places)) return vs_pos_of(code->places);
  vs_value places = vs_is_pair(code->places) ? vs_car(code->places) : code->places;
  if (!vs_is(places, VS_T_BYTES)) return 0;
  const vs_place *at = (const vs_place *)(const void *)vs_as_bytes(places)->at;
  size_t low = 0, high = vs_as_bytes(places)->length / sizeof *at;
  while (low < high) {                 /* first entry behind pc */
    size_t mid = (low + high) / 2;
    if (at[mid].pc <= pc) low = mid + 1; else high = mid;
  }
  return low ? (vs_pos)at[low - 1].high << 32 | at[low - 1].low : 0;
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
