/* Declares intervals: bounds of all values in between, and the evaluation of tapes with them. */
#ifndef VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H
#define VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H

#include "geometry/functions/tape.h"

/* All numbers from low to high. `partial`: the intervals may contain operands for which the expression has no value.
 * Both NaN: it has no value at all. Bounds are rounded outwards: the exact result for numbers in the operands lies in
 * the result. */
typedef struct {
  double low, high;
  bool partial;
} vs_enclosure;

/* Returns the bounds of an operator; op is an operator. */
vs_enclosure vs_enclose(vs_tape_operator op, vs_enclosure a, vs_enclosure b,
                        vs_enclosure c); /* tests give [0 0], [1 1] or [0 1] */
/* Returns the bounds of the first output over the box in[0] x in[1] x ...; work has room for t->count enclosures. */
vs_enclosure vs_enclose_tape(const vs_tape *t, const vs_enclosure *in, vs_enclosure *work);

#endif
