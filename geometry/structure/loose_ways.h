/* Declares the search for directions in which nothing holds a node, even if all other nodes are held. */
#ifndef VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H
#define VS_GEOMETRY_STRUCTURE_LOOSE_WAYS_H

#include "geometry/structure/structure.h"

/* The stiffness of a node against its own displacements and rotations, in global axes: a symmetric matrix. */
typedef double vs_node_stiffness[VS_WAYS][VS_WAYS];

/* Finds the directions in which the node's stiffness b does not resist, among the degrees of freedom that are not held.
 * Writes them to motion, orthogonal to each other, and returns their number. Replaces b by a stiffness that resists
 * only them. unturned[i]: true if degree of freedom i is a rotation that no member resists, so that it is kept at 0. */
int vs_loose_ways(vs_node_stiffness b, const bool held[VS_WAYS], double motion[VS_WAYS][VS_WAYS],
                  bool unturned[VS_WAYS]);

#endif
