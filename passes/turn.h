/* Declares the test whether a subtree is another subtree rotated, mirrored and moved. */
#ifndef VS_PASSES_TURN_H
#define VS_PASSES_TURN_H

#include "model/node.h"

typedef struct { const vs_node *a, *b; } vs_turn_pair;
/* Returns true if subtree b is subtree a rotated, mirrored or moved, within the tolerance `near`. Sets *turn to the map
 * from a to b. Adds the number of visited points and nodes to *work. Returns false with *e set if memory is out or the
 * run is interrupted. */
bool vs_turn_find(vs_turn_pair pair, double near, vs_affine *turn, size_t *work, vs_error *e);

#endif
