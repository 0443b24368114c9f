/* Declares the search for directions in which nothing holds a node, even if all other nodes are held. */
#ifndef VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H
#define VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H

#include "geometry/structure/structure.h"

/* The stiffness of a node against its own displacements and rotations, in global axes: a symmetric matrix. */
typedef double vs_node_stiffness[VS_WAYS][VS_WAYS];

/* Finds the directions, among degrees of freedom that are not held, in which the node's stiffness b does not resist.
 * Writes them to motion and returns their number. Replaces b by a stiffness that resists only in these directions.
 * unturned[i]: true if degree of freedom i is a rotation that no member resists. */
int vs_loose_ways(vs_node_stiffness b, const bool held[VS_WAYS], double motion[VS_WAYS][VS_WAYS],
                  bool unturned[VS_WAYS]);

#endif
