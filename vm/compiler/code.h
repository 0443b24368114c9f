/* Owns the layout of compiled code: opcodes, instruction fields, the table of places. */
#ifndef VS_VM_COMPILER_CODE_H
#define VS_VM_COMPILER_CODE_H

#include "vm/values/value.h"

enum {
#define VS_OP(name, operands, extra, generic) VS_O_##name,
#include "vm/compiler/opcodes.def"
#undef VS_OP
  VS_O_COUNT
};

#define VS_INS(op, a, b, c)                                                                                            \
  ((uint32_t)(op) | (uint32_t)(a) << 8 | (uint32_t)(uint8_t)(b) << 16 | (uint32_t)(uint8_t)(c) << 24)
#define VS_INSX(op, a, bx) ((uint32_t)(op) | (uint32_t)(a) << 8 | (uint32_t)(uint16_t)(bx) << 16)
#define VS_A(i) ((i) >> 8 & 255)
#define VS_B(i) ((i) >> 16 & 255)
#define VS_C(i) ((i) >> 24)
#define VS_BX(i) ((i) >> 16)

/* code->places: in order of pc, an entry for every instruction that can fail. In the heap image it is a fixnum, one
 * place for the whole procedure: messages show no places in the language's own sources. If the interpreter keeps the
 * calls that errors end, it is a pair of the entries and a vector of variables, VS_VARIABLE_WORDS each: a symbol; the
 * register, or -1 - i for the i-th captured one; the instructions [from, to) in which the variable has its value. */
typedef struct vs_place { uint32_t pc, high, low; } vs_place;
enum { VS_VARIABLE_WORDS = 4 };
/* code->inlined: the cell (constant index) of the procedure that the instruction at pc replaces */
typedef struct vs_inlined { uint32_t pc, constant; } vs_inlined;

vs_pos vs_code_place(const vs_code *code, uint32_t pc);               /* of the instruction at or before pc */
uint32_t vs_code_place_start(const vs_code *code, uint32_t pc);       /* that instruction's index */
const vs_vector *vs_code_variables(const vs_code *code);              /* NULL: unknown */
uint32_t vs_code_inlined(const vs_code *code, uint32_t pc);           /* constant index */
/* op is an opcode. */
int vs_op_generic(uint32_t op);
/* op is an opcode. */
const char *vs_op_operands(uint32_t op);
/* op is an opcode. */
uint32_t vs_op_extra(uint32_t op);

/* Returns which of define-record-type's procedures these instructions of `required` parameters are; 0: none. */
uint32_t vs_code_record(const uint32_t *ins, size_t words, uint32_t required);

/* Clears VS_F_CONSTANT of a cell that will get another value, and patches all code that inlined it. The environment
 * calls it before a redefinition; SETGLOBAL and DEFGLOBAL do so themselves. */
void vs_cell_redefine(vs_value cell);

static inline uint32_t *vs_code_ins(const vs_code *c) { return (uint32_t *)(void *)vs_as_bytes(c->ins)->at; }
static inline vs_value *vs_code_consts(const vs_code *c) { return vs_as_vector(c->consts)->at; }

#endif
