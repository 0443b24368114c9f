/* Declares the matrices of a straight member: they relate the movements of its ends to the forces on them. */
#ifndef VS_GEOMETRY_STRUCTURE_MEMBER_MATRICES_H
#define VS_GEOMETRY_STRUCTURE_MEMBER_MATRICES_H

#include "geometry/structure/structure.h"

/* A matrix over the degrees of freedom of a member, in its own axes: six for its first end, then six for its second;
 * see structure.h. */
typedef double vs_member_matrix[VS_MEMBER_WAYS][VS_MEMBER_WAYS];

/* Sets axes to the unit vectors of the member's own x, y and z axes, for a member between the two points. roll:
 * rotation of y and z about x, in radians. Returns the member's length. */
double vs_member_axes(vs_vec3 from, vs_vec3 to, double roll, vs_vec3 axes[3]);

/* Sets k to the member's stiffness, and f to the end forces that are equivalent to the distributed load `line`, in N/m
 * in own axes. Both take hinges into account, and are exact for bending by Euler and Bernoulli. */
void vs_member_stiffness(const vs_structure_member *m, double length, vs_vec3 line, vs_member_matrix k,
                         double f[VS_MEMBER_WAYS]);

/* Sets a to the change of the member's stiffness by an axial force. force: in N, positive for tension. */
void vs_member_geometric(const vs_structure_member *m, double length, double force, vs_member_matrix a);
/* Adds to a, a matrix of the member's nodes, the change of their stiffness by the axial force at the ends of rigid
 * arms. */
void vs_member_arms_geometric(const vs_structure_member *m, const vs_vec3 axes[3], double force, vs_member_matrix a);
/* Sets a to the mass matrix of the member, whose mass is in kg. */
void vs_member_mass(const vs_structure_member *m, double length, double mass, vs_member_matrix a);

/* Sets out to the forces and moments at the nodes, in global axes, from those at the member's ends, in own axes. */
void vs_member_to_nodes(const vs_structure_member *m, const vs_vec3 axes[3], const double own[VS_MEMBER_WAYS],
                        double out[VS_MEMBER_WAYS]);
/* Returns the displacement of the member's end that is `offset` away from a node with the given movements. */
vs_vec3 vs_member_end(const double node[VS_WAYS], vs_vec3 offset);
/* Sets out to the movements of the member's ends, in own axes, from those of its nodes, in global axes. */
void vs_member_from_nodes(const vs_structure_member *m, const vs_vec3 axes[3], const double moved[VS_MEMBER_WAYS],
                          double out[VS_MEMBER_WAYS]);
/* Converts a matrix of the member's ends, in own axes, to one of its nodes, in global axes, in place. */
void vs_member_matrix_to_nodes(const vs_structure_member *m, const vs_vec3 axes[3], vs_member_matrix k);

#endif
