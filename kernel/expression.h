/* Owns the boolean expression over leaves, kept up to date while single leaves are entered and left. */
#ifndef VS_KERNEL_EXPRESSION_H
#define VS_KERNEL_EXPRESSION_H

#include "kernel/problem.h"
#include "kernel/memory.h"

enum { VS_GATES = 8 };

/* After flattening: no union in a union, no intersection in an intersection, no difference in a difference's first
 * operand, no union in its others (where the inner one has that user alone). Each term counts what makes it true, so a
 * leaf that changes costs only the terms whose value changes. */
typedef struct {
  VS_LIST(uint8_t) kind;      /* vs_term_kind */
  VS_LIST(uint32_t) need;     /* INTERSECTION: how many true operands */
  VS_LIST(uint32_t) positive; /* true operands that count for it */
  VS_LIST(uint32_t) negative; /* DIFFERENCE: true operands that are taken off */
  VS_LIST(uint32_t) user_first;
  VS_LIST(uint32_t) users;    /* term * 2 + 1 where it is taken off there */
  VS_LIST(int32_t) winding;   /* of each leaf */
  VS_LIST(uint32_t) leaf_first, leaf_terms; /* the terms that are the leaf */
  VS_LIST(uint8_t) taken_off; /* of each leaf: 1 where it makes the result smaller */
  VS_LIST(uint32_t) stack;
  VS_LIST(uint8_t) forces;    /* of each leaf: 1 where the result is settled inside of it, whatever the others are */
  uint32_t gates[VS_GATES];   /* terms outside of which the result is false */
  uint32_t gate_count;
  bool forced;                /* what the result is where it is settled */
  VS_LIST(uint8_t) waits;     /* of each term, for a leaf that stands in several: 1 in the heap, 2 it was true then */
  uint32_t root;
} vs_expression;

bool vs_expression_build(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p);
bool vs_expression_add(vs_kernel *k, vs_expression *e, uint32_t leaf, int32_t delta); /* changes its winding number */
bool vs_expression_value(const vs_expression *e);
bool vs_expression_gated(const vs_expression *e); /* is one of the gates false? */
/* Is the leaf, true now, one that makes the result true: does it count for a true term, and so on up to the root? What
 * is taken away elsewhere in the expression does not. False: out of memory. */
bool vs_expression_upholds(vs_kernel *k, vs_expression *e, uint32_t leaf, bool *answer);
void vs_expression_free(vs_kernel *k, vs_expression *e);

#endif
