/* Owns the boolean expression over leaves. Its value is updated whenever the arrangement enters or leaves a leaf. */
#ifndef VS_KERNEL_EXPRESSION_H
#define VS_KERNEL_EXPRESSION_H

#include "kernel/problem.h"
#include "kernel/memory.h"

enum { VS_GATES = 8 };

/* The flattened expression: no union in a union, no intersection in an intersection, no difference as a difference's
 * first operand, no union as one of its other operands (if the inner term has that user alone). Each term counts its
 * true operands, so a leaf that changes costs only the terms whose value changes. */
typedef struct {
  VS_LIST(uint8_t) kind;      /* vs_term_kind */
  VS_LIST(uint32_t) need;     /* INTERSECTION: number of true operands that make it true */
  VS_LIST(uint32_t) positive; /* number of true operands that are not subtracted */
  VS_LIST(uint32_t) negative; /* DIFFERENCE: number of true operands that are subtracted */
  VS_LIST(uint32_t) user_first;
  VS_LIST(uint32_t) users;    /* term * 2 + 1 if that term subtracts it, else term * 2 */
  VS_LIST(int32_t) winding;   /* of each leaf */
  VS_LIST(uint32_t) leaf_first, leaf_terms; /* the terms of each leaf */
  VS_LIST(uint8_t) taken_off; /* of each leaf: 1 if it makes the result smaller */
  VS_LIST(uint32_t) stack;
  VS_LIST(uint8_t) forces;    /* of each leaf: 1 if the result inside it does not depend on the others */
  uint32_t gates[VS_GATES];   /* terms outside of which the result is false */
  uint32_t gate_count;
  bool forced;                /* the value of the result where it is settled */
  VS_LIST(uint8_t) waits;     /* of each term, for a leaf in several terms: 0 not in the heap; 1 in it; 3 in it, and the
                               * term was true at that time */
  uint32_t root;
} vs_expression;

bool vs_expression_build(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p);
bool vs_expression_add(vs_kernel *k, vs_expression *e, uint32_t leaf, int32_t delta); /* Adds delta to the leaf's
                                                                                       * winding number and updates the
                                                                                       * terms. Returns false when
                                                                                       * memory is out. */
bool vs_expression_value(const vs_expression *e);
bool vs_expression_gated(const vs_expression *e); /* returns true if one of the gates is false */
/* Sets *answer to true if the leaf, which is true, makes the result true: it counts for a true term, and so on up to
 * the root. Operands that the expression subtracts do not count. Returns false when memory is out. */
bool vs_expression_upholds(vs_kernel *k, vs_expression *e, uint32_t leaf, bool *answer);
void vs_expression_free(vs_kernel *k, vs_expression *e);

#endif
