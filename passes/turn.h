/* Owns the interface of turn.c: Owns, for share, the question whether one subtree is another turned, mirrored and
 * moved. */
#ifndef VS_PASSES_TURN_H
#define VS_PASSES_TURN_H

#include "model/node.h"

typedef struct { const vs_node *a, *b; } vs_turn_pair;
/* Is b a turned, mirrored and moved, within near? *turn: the map. *work grows by what it cost, in points and nodes that
 * were gone through. False with *e set: out of memory, or interrupted. */
bool vs_turn_find(vs_turn_pair pair, double near, vs_affine *turn, size_t *work, vs_error *e);

#endif
