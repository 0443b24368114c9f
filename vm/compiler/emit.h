/* Owns the construction of one procedure's instructions: registers, constants, jumps, places. Only compile.c uses
 * it. */
#ifndef VS_VM_COMPILER_EMIT_H
#define VS_VM_COMPILER_EMIT_H

#include "vm/front/ast.h"
#include "vm/compiler/code.h"

/* Instructions cannot name registers from VS_FAR on: these are copied to and from scratch registers VS_NEAR... */
enum { VS_NEAR = 240, VS_FAR = 256, VS_MOST_REGISTERS = 60000 };
#define VS_NO_REGISTER UINT32_MAX

/* name: index into the tree's pool; the rest as in code.h */
typedef struct vs_named_register { uint32_t name; int64_t where; uint32_t from, to; } vs_named_register;

typedef struct vs_emit {
  vs_ast *ast;
  vs_core_node *lambda;                     /* the LAMBDA being compiled */
  uint32_t next, most;                /* first free register; number of registers used */
  uint32_t fresh;                     /* a register just taken for the next expression, still without a value */
  uint32_t *ins; size_t count, room;
  uint32_t *consts; size_t const_count, const_room;          /* indices into the tree's pool */
  vs_place *places; size_t place_count, place_room;
  vs_inlined *inlined; size_t inlined_count, inlined_room;
  vs_named_register *variables; size_t variable_count, variable_room;     /* only if errors keep their calls */
} vs_emit;

typedef uint32_t vs_jumps;            /* 0, or 1 + index of the last open offset word; that contains the one before */

void vs_emit_close(vs_emit *e);
bool vs_emit_register(vs_emit *e, uint32_t *out);                         /* takes the next one, marks it fresh */
bool vs_emit_word(vs_emit *e, uint32_t w);
bool vs_emit_op(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c);
/* Emits an op with one extra word. */
bool vs_emit_op1(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, uint32_t word);
bool vs_emit_branch(vs_emit *e, unsigned op, uint32_t a, uint32_t b, uint32_t c, vs_jumps *list);
bool vs_emit_back(vs_emit *e, unsigned op, uint32_t target);              /* JUMP or LOOP to an emitted instruction */
void vs_emit_here(vs_emit *e, vs_jumps list);                             /* the jumps of the list come here */
/* The index is one of the tree's pool. */
bool vs_emit_constant(vs_emit *e, uint32_t pool_index, uint32_t *out);    /* index in this procedure's constants */
bool vs_emit_value(vs_emit *e, vs_value v, uint32_t *out);                /* the same for a value */
bool vs_emit_place(vs_emit *e, vs_pos pos);                               /* of the next instruction */
/* The next instruction replaces a call of this constant. */
bool vs_emit_inlined(vs_emit *e, uint32_t cell);
/* From the next instruction on the variable is in its register, up to the last one before vs_emit_scope_end, which gets
 * the earlier variable_count. */
bool vs_emit_variable(vs_emit *e, const vs_var *v);
void vs_emit_scope_end(vs_emit *e, size_t first);
/* Fills `code` (already allocated, old) with the emitted instructions. */
bool vs_emit_finish(vs_emit *e, vs_value code);

#endif
