/* Owns intervals: bounds that hold for every value in between, and tapes worked out with them. */
#ifndef VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H
#define VS_GEOMETRY_FUNCTIONS_ENCLOSURE_H

#include "geometry/functions/tape.h"

/* All numbers from low to high. `partial`: there may be operands in the intervals for which the expression has no
 * value. Both NaN: there is none at all. Bounds are rounded outwards: what is worked out exactly for numbers in the
 * operands lies in the result. */
typedef struct {
  double low, high;
  bool partial;
} vs_enclosure;

/* op is an operator. */
vs_enclosure vs_enclose(vs_tape_operator op, vs_enclosure a, vs_enclosure b,
                        vs_enclosure c); /* tests give [0 0], [1 1] or [0 1] */
/* The first output over the box in[0] x in[1] x ...; work has room for t->count enclosures. */
vs_enclosure vs_enclose_tape(const vs_tape *t, const vs_enclosure *in, vs_enclosure *work);

#endif
