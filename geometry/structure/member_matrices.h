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
/* Sets a to the mass matrix of the member, whose mass is in kg. */
void vs_member_mass(const vs_structure_member *m, double length, double mass, vs_member_matrix a);

/* Converts the twelve numbers of a member's two ends from own axes to global axes. vs_member_to_own converts them from
 * global axes to own axes. */
void vs_member_to_global(const vs_vec3 axes[3], const double own[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]);
void vs_member_to_own(const vs_vec3 axes[3], const double global[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]);
/* Converts a member's matrix from own axes to global axes, in place. */
void vs_member_matrix_to_global(const vs_vec3 axes[3], vs_member_matrix k);

#endif
