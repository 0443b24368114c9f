/* Declares the search for directions in which nothing holds a node, even if all other nodes are held. */
#ifndef VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H
#define VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H

#include "geometry/structure/structure.h"

/* The stiffness of a node against its own movement, on global axes. */
typedef double vs_node_stiffness[VS_WAYS][VS_WAYS];

/* Sets motion[0..] to the directions, at right angles to each other, in which b does not resist and no way is held, and
 * returns how many they are. Replaces b by a stiffness that resists them alone. A node whose members give its turns no
 * stiffness at all does not turn: unturned[i] tells so of way i. */
int vs_loose_ways(vs_node_stiffness b, const bool held[VS_WAYS], double motion[VS_WAYS][VS_WAYS],
                  bool unturned[VS_WAYS]);

#endif
