/* Stores the boolean expression over leaves (placed meshes). Updates its value whenever a walk through the arrangement
 * enters or leaves a leaf. */
#ifndef VS_KERNEL_EXPRESSION_H
#define VS_KERNEL_EXPRESSION_H

#include "kernel/problem.h"
#include "kernel/memory.h"

enum { VS_GATES = 8 };

/* The flattened expression: terms such as a union in a union are merged into the term that uses them. Each term counts
 * its true operands. When a leaf changes, only terms whose operands change are evaluated. */
typedef struct {
  VS_LIST(uint8_t) kind;      /* kind[t]: vs_term_kind of term t */
  VS_LIST(uint32_t) need;     /* need[t]: number of operands of the intersection t that must be true for t to be true */
  VS_LIST(uint32_t) positive; /* positive[t]: number of true operands of term t that it does not subtract */
  VS_LIST(uint32_t) negative; /* negative[t]: for a difference t, the number of its subtracted operands that are true */
  VS_LIST(uint32_t) user_first;
  VS_LIST(uint32_t) users;    /* terms that use each term as an operand, grouped by operand; an element is 2 * user + 1
                               * if the term `user` subtracts the operand, else 2 * user */
  VS_LIST(int32_t) winding;   /* winding[i]: winding number of leaf i at the current place; positive means inside */
  VS_LIST(uint32_t) leaf_first, leaf_terms; /* leaf_terms: numbers of all terms of kind VS_TERM_LEAF, grouped by leaf;
                                             * leaf_first[i]: position in leaf_terms of the first term of leaf i */
  VS_LIST(uint8_t) taken_off; /* taken_off[i]: 1 if leaf i is subtracted, so that it makes the result smaller */
  VS_LIST(uint32_t) stack;
  VS_LIST(uint8_t) forces;    /* forces[i]: 1 if leaf i alone decides the result inside itself */
  uint32_t gates[VS_GATES];   /* Gates: terms outside of which the result is empty. If a gate is false, the result is
                               * false for any value of the other terms. */
  uint32_t gate_count;
  bool forced;                /* value of the result inside every leaf i with forces[i] = 1 */
  VS_LIST(uint8_t) waits;     /* waits[t]: state of term t in the heap of terms to evaluate. 0: it is not in the heap;
                               * 1: it is in the heap, and was false when it was put there; 3: in the heap, and was true
                               * then */
  uint32_t root;
} vs_expression;

bool vs_expression_build(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p);
bool vs_expression_add(vs_kernel *k, vs_expression *e, uint32_t leaf, int32_t delta); /* adds delta to the winding
                                                                                       * number of the leaf and
                                                                                       * evaluates the changed terms;
                                                                                       * returns false when memory is
                                                                                       * out */
bool vs_expression_value(const vs_expression *e);
bool vs_expression_gated(const vs_expression *e); /* returns true if an element of e->gates is false, and the result
                                                   * therefore is, too */
/* Sets *answer to true if the leaf makes the result true. This is so if a sequence of true terms leads from the leaf to
 * the root, in which no term subtracts the term before it. The leaf's winding number must be positive. Returns false
 * when memory is out. */
bool vs_expression_upholds(vs_kernel *k, vs_expression *e, uint32_t leaf, bool *answer);
void vs_expression_free(vs_kernel *k, vs_expression *e);

#endif
