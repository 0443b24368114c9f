/* Declares the format of compiled code: opcodes, fields of instructions, tables of places. */
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

/* An entry of code->places: the place in the source of an instruction that can fail. Entries are sorted by pc.
 *
 * In the heap image, code->places is a fixnum: a single place for the whole procedure, since messages show no places in
 * the language's own sources. If the interpreter records the calls that lead to errors, code->places is a pair of the
 * entries and a vector of variables.
 *
 * A variable has VS_VARIABLE_WORDS words: its symbol; its register, or -1 - i for captured variable i; the instructions
 * [from, to) in which it has its value. */
typedef struct vs_place { uint32_t pc, high, low; } vs_place;
enum { VS_VARIABLE_WORDS = 4 };
/* An entry of code->inlined: the instruction at pc replaces a call of a global procedure. constant: index of the
 * constant that is the procedure's cell. */
typedef struct vs_inlined { uint32_t pc, constant; } vs_inlined;

vs_pos vs_code_place(const vs_code *code, uint32_t pc);               /* Returns the place of the instruction at or
                                                                       * before pc. */
/* Returns the place of the instruction at or before pc. If no place precedes pc, returns the last place of the code, or
 * 0 if there is none. */
vs_pos vs_code_near_place(const vs_code *code, uint32_t pc);
uint32_t vs_code_place_start(const vs_code *code, uint32_t pc);       /* Returns the index of the last instruction at or
                                                                       * before pc that has a place. */
const vs_vector *vs_code_variables(const vs_code *code);              /* Returns the vector of variables for a debugger,
                                                                       * or NULL if the code has none. */
/* Returns the index of the constant that holds the global procedure's cell, where the instruction at pc replaces a call
 * of this procedure. */
uint32_t vs_code_inlined(const vs_code *code, uint32_t pc);
/* Returns the generic opcode of which `op` is a specialised form (opcodes.def), or `op` itself. */
int vs_op_generic(uint32_t op);
/* Returns a string with one letter for each operand of the opcode, as in opcodes.def. */
const char *vs_op_operands(uint32_t op);
/* Returns the number of words that follow the first word of an instruction with this opcode. */
uint32_t vs_op_extra(uint32_t op);

/* Recognises the code of a procedure that define-record-type creates. Returns VS_CODE_GET, VS_CODE_SET, VS_CODE_TEST or
 * VS_CODE_MAKE, or 0 for other code. required: number of the procedure's parameters. */
uint32_t vs_code_record(const uint32_t *ins, size_t words, uint32_t required);

/* Prepares the cell of a global variable for another value: removes VS_F_CONSTANT from the cell, and restores the calls
 * that were compiled to opcodes because the cell was constant. The environment calls this function before a
 * redefinition; the instructions SETGLOBAL and DEFGLOBAL call it themselves. */
void vs_cell_redefine(vs_value cell);

static inline uint32_t *vs_code_ins(const vs_code *c) { return (uint32_t *)(void *)vs_as_bytes(c->ins)->at; }
static inline vs_value *vs_code_consts(const vs_code *c) { return vs_as_vector(c->consts)->at; }

#endif
