/* Owns the interface of turn.c: Owns, for share, the question whether one subtree is another turned, mirrored and
 * moved. */
#ifndef VS_PASSES_TURN_H
#define VS_PASSES_TURN_H

#include "model/node.h"

/* Is b a turned, mirrored and moved, within near? *turn: the map. *work grows by what it cost, in points. False with
 * *starved: out of memory. */
bool vs_turn_find(vs_store *s, const vs_node *a, const vs_node *b, double near, vs_affine *turn, size_t *work,
                  bool *starved);

#endif
