/* Owns the facts that the compiler needs of a tree before it emits code: homes, free variables, boxes, loops. */
#ifndef VS_VM_COMPILER_ANALYSE_H
#define VS_VM_COMPILER_ANALYSE_H

#include "vm/front/ast.h"

#define VS_NOT_READY UINT32_MAX

/* vs_var.extra */
typedef struct vs_var_info {
  vs_core_node *lambda;           /* the LAMBDA in whose activation it has a register */
  vs_core_node *fix;              /* the FIX that binds it, or NULL */
  uint32_t ready;            /* the moment from which it has its value; 0 for parameters and LET */
  bool boxed;                /* captured before it has a value: its register contains a box, as that of every assigned
                              * variable does */
  bool early;                /* some reference may precede its value */
  bool loop;                 /* bound to a LAMBDA that runs in the activation; calls of it are jumps */
  bool emitted;              /* loop: `top` is known */
  uint32_t top;              /* loop: index of its first instruction */
} vs_var_info;

/* vs_core_node.as.lambda.extra of every LAMBDA with an activation of its own */
typedef struct vs_lambda_info {
  vs_core_node *parent;           /* the LAMBDA around it, or NULL */
  uint32_t made;             /* the moment at which the parent makes its closure */
  vs_var **free; uint32_t free_count, free_room;
  bool *early;               /* early[i]: whether the closure is made before free[i] has a value */
  uint32_t *index, index_room;   /* of `free`: 1 + place, by hash, once there are many */
  uint32_t code;             /* 1 + constant index of its code object */
} vs_lambda_info;

/* Returns the number of a captured variable in its closure; UINT32_MAX: not captured. */
uint32_t vs_free_index(const vs_lambda_info *f, const vs_var *v);
static inline vs_var_info *vs_info(const vs_var *v) { return v->extra; }

/* Prepares the tree with the outermost LAMBDA `top`. Afterwards a LOCAL with `flag` set needs the check for a value. */
bool vs_analyse(vs_ast *ast, vs_core_node *top);

#endif
