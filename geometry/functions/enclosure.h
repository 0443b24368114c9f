/* Declares intervals, which bound all values of an expression, and the evaluation of tapes with intervals. */
#ifndef VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H
#define VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H

#include "geometry/functions/tape.h"

/* An interval: all numbers from low to high, rounded outwards. partial: true if the expression may have no value for
 * some operands; if low and high are NaN, it never has one. */
typedef struct {
  double low, high;
  bool partial;
} vs_enclosure;

/* Returns the bounds of the result of the operator op (operators.def) for all operands in the intervals a, b and c. */
vs_enclosure vs_enclose(vs_tape_operator op, vs_enclosure a, vs_enclosure b,
                        vs_enclosure c); /* for a comparison, the result is the interval [0 0] (false), [1 1] (true) or
                                          * [0 1] (either) */
/* Returns the bounds of the tape's first output for all inputs in the intervals in[0], in[1] ... work: memory for
 * t->count intervals. */
vs_enclosure vs_enclose_tape(const vs_tape *t, const vs_enclosure *in, vs_enclosure *work);

#endif
