/* Stores the boolean expression over leaves, and updates its value whenever the arrangement enters or leaves a leaf. */
#ifndef VS_KERNEL_EXPRESSION_H
#define VS_KERNEL_EXPRESSION_H

#include "kernel/problem.h"
#include "kernel/memory.h"

enum { VS_GATES = 8 };

/* The flattened expression. A term is merged into its user if it has no other user, in four cases: a union in a
 * union, an intersection in an intersection, a difference that is the first operand of a difference, a union that is
 * subtracted. Each term counts its true operands. When a leaf changes, only terms whose operands change are
 * evaluated. */
typedef struct {
  VS_LIST(uint8_t) kind;      /* the vs_term_kind of each term */
  VS_LIST(uint32_t) need;     /* for each intersection: number of operands that must be true */
  VS_LIST(uint32_t) positive; /* for each term: number of true operands that are not subtracted */
  VS_LIST(uint32_t) negative; /* for each difference: number of its subtracted operands that are true */
  VS_LIST(uint32_t) user_first;
  VS_LIST(uint32_t) users;    /* the users of all terms, grouped by operand. An element is 2 * user + 1 if the user
                               * subtracts the operand, else 2 * user */
  VS_LIST(int32_t) winding;   /* winding number of each leaf at the current place */
  VS_LIST(uint32_t) leaf_first, leaf_terms; /* leaf_terms: the terms of all leaves, grouped by leaf; leaf_first[i]:
                                             * index where the terms of leaf i begin */
  VS_LIST(uint8_t) taken_off; /* for each leaf: 1 if it is subtracted, so that it makes the result smaller */
  VS_LIST(uint32_t) stack;
  VS_LIST(uint8_t) forces;    /* for each leaf: 1 if the result inside the leaf does not depend on other leaves */
  uint32_t gates[VS_GATES];   /* terms that gate the result: if a gate is false, the result is false for any value of
                               * the other terms */
  uint32_t gate_count;
  bool forced;                /* value of the result inside a leaf whose element of `forces` is 1 */
  VS_LIST(uint8_t) waits;     /* for each term: 0: not in the heap; 1: in the heap, and false when it was put there; 3:
                               * in the heap, and true when it was put there */
  uint32_t root;
} vs_expression;

bool vs_expression_build(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p);
bool vs_expression_add(vs_kernel *k, vs_expression *e, uint32_t leaf, int32_t delta); /* Adds delta to the leaf's
                                                                                       * winding number and updates the
                                                                                       * terms. Returns false when
                                                                                       * memory is out. */
bool vs_expression_value(const vs_expression *e);
bool vs_expression_gated(const vs_expression *e); /* returns true if one of the gates is false */
/* Sets *answer to true if the leaf makes the result true. This is so if a chain of true terms leads from the leaf to
 * the root, in which no term subtracts the previous term. The leaf's winding number must be positive. Returns false
 * when memory is out. */
bool vs_expression_upholds(vs_kernel *k, vs_expression *e, uint32_t leaf, bool *answer);
void vs_expression_free(vs_kernel *k, vs_expression *e);

#endif
