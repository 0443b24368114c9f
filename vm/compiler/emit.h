/* Declares functions that emit the instructions of one procedure: registers, constants, jumps, places. Only compile.c
 * uses them. */
#ifndef VS_VM_COMPILER_EMIT_H
#define VS_VM_COMPILER_EMIT_H

#include "vm/front/ast.h"
#include "vm/compiler/code.h"

/* Instructions can name registers below VS_FAR only. Others are copied to and from scratch registers, which begin at
 * VS_NEAR. */
enum { VS_NEAR = 240, VS_FAR = 256, VS_MOST_REGISTERS = 60000 };
#define VS_NO_REGISTER UINT32_MAX

/* An entry of the debugger's table of variables. name: index in the tree's pool of constants; the other members are as
 * in code.h. */
typedef struct vs_named_register { uint32_t name; int64_t where; uint32_t from, to; } vs_named_register;

typedef struct vs_emit {
  vs_ast *ast;
  vs_core_node *lambda;                     /* LAMBDA that is being compiled */
  uint32_t next, most;                /* next: first free register; most: number of registers used */
  uint32_t fresh;                     /* register that was allocated for the value of the next expression, and does not
                                       * contain it yet */
  uint32_t *ins; size_t count, room;
  uint32_t *consts; size_t const_count, const_room;          /* constants of the procedure, as indices into the tree's
                                                              * pool */
  vs_place *places; size_t place_count, place_room;
  vs_inlined *inlined; size_t inlined_count, inlined_room;
  /* the debugger's table of variables; used only if the interpreter records the calls that lead to errors */
  vs_named_register *variables; size_t variable_count, variable_room;
} vs_emit;

typedef uint32_t vs_jumps;            /* List of jumps whose targets are not known yet: 0, or 1 + index of the last
                                       * jump's offset word, which contains the list of the jumps before it. */

void vs_emit_close(vs_emit *e);
bool vs_emit_register(vs_emit *e, uint32_t *out);                         /* allocates the next free register, and
                                                                           * stores its number in *out and in
                                                                           * e->fresh */
bool vs_emit_word(vs_emit *e, uint32_t w);
bool vs_emit_op(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c);
/* Emits an instruction that is followed by one extra word. */
bool vs_emit_op1(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, uint32_t word);
bool vs_emit_branch(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, vs_jumps *list);
bool vs_emit_back(vs_emit *e, unsigned op, uint32_t target);              /* Emits JUMP or LOOP back to the instruction
                                                                           * with the index `target`. */
void vs_emit_here(vs_emit *e, vs_jumps list);                             /* Sets the targets of all jumps in the list
                                                                           * to the next instruction. */
/* Sets *out to the index, among this procedure's constants, of a constant of the tree's pool. */
bool vs_emit_constant(vs_emit *e, uint32_t pool_index, uint32_t *out);
bool vs_emit_value(vs_emit *e, vs_value v, uint32_t *out);                /* Sets *out to the index of the value among
                                                                           * this procedure's constants. */
bool vs_emit_place(vs_emit *e, vs_pos pos);                               /* Sets the place of the next instruction. */
/* Records that the next instruction replaces a call of a global procedure. cell: index of the constant that is the
 * procedure's cell. */
bool vs_emit_inlined(vs_emit *e, uint32_t cell);
/* Adds the variable to the debugger's table: it is in its register from the next instruction on, until
 * vs_emit_scope_end is called. */
bool vs_emit_variable(vs_emit *e, const vs_var *v);
void vs_emit_scope_end(vs_emit *e, size_t first);
/* Stores the emitted instructions in `code`, which is an object in old space. */
bool vs_emit_finish(vs_emit *e, vs_value code);

#endif
