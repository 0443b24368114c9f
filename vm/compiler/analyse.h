/* Declares facts about a core tree that the compiler needs before it emits code: captured variables, boxes, loops. */
#ifndef VS_VM_COMPILER_ANALYSE_H
#define VS_VM_COMPILER_ANALYSE_H

#include "vm/front/ast.h"

#define VS_NOT_READY UINT32_MAX

/* Facts about a variable; vs_var.extra points to it. */
typedef struct vs_var_info {
  vs_core_node *lambda;           /* LAMBDA in whose activation (frame of registers) the variable has a register */
  vs_core_node *fix;              /* FIX that binds the variable, or NULL */
  uint32_t ready;            /* moment (a number that analyse.c assigns to nodes) at which the variable gets its value;
                              * 0 for parameters and variables of LET */
  bool boxed;                /* whether the register contains a box, because the variable is captured before it has a
                              * value (assigned variables always have boxes) */
  bool early;                /* whether a reference may be evaluated before the variable has its value */
  bool loop;                 /* whether the value is a LAMBDA that runs in the activation (the registers) of the
                              * procedure around it, so that its calls are jumps */
  bool emitted;              /* for loops: whether the loop was compiled, so that the member `top` is set */
  uint32_t top;              /* for loops: index of the loop's first instruction */
} vs_var_info;

/* Facts about a LAMBDA with an activation of its own; vs_core_node.as.lambda.extra points to it. */
typedef struct vs_lambda_info {
  vs_core_node *parent;           /* the enclosing LAMBDA, or NULL */
  uint32_t made;             /* moment (a number that analyse.c assigns to nodes) at which the enclosing LAMBDA creates
                              * the closure */
  vs_var **free; uint32_t free_count, free_room;
  bool *early;               /* early[i]: whether the closure is created before free[i] has a value */
  uint32_t *index, index_room;   /* index: hash table of positions in `free` if it has many elements; each entry is 0 or
                                  * 1 + position. index_room: number of entries */
  uint32_t code;             /* 1 + constant index of the lambda's code object */
} vs_lambda_info;

/* Returns the index of variable v among those that the closure f has captured, or UINT32_MAX. */
uint32_t vs_free_index(const vs_lambda_info *f, const vs_var *v);
static inline vs_var_info *vs_info(const vs_var *v) { return v->extra; }

/* Analyses the tree whose outermost LAMBDA is `top`. Afterwards `flag` is set in each LOCAL node whose variable may
 * have no value yet when the node is evaluated; the program must check it. Returns false with the error set. */
bool vs_analyse(vs_ast *ast, vs_core_node *top);

#endif
