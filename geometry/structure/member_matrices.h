/* Declares the matrices of a straight member: between the movements of its ends, and the forces on them. */
#ifndef VS_GEOMETRY_STRUCTURE_MEMBER_MATRICES_H
#define VS_GEOMETRY_STRUCTURE_MEMBER_MATRICES_H

#include "geometry/structure/structure.h"

/* The numbers of an end are those of the structure's ways, on the member's own axes. */
typedef double vs_member_matrix[VS_MEMBER_WAYS][VS_MEMBER_WAYS];

/* Sets the unit vectors of the own axes; returns the length. */
double vs_member_axes(vs_vec3 from, vs_vec3 to, double roll, vs_vec3 axes[3]);

/* Sets k to the stiffness, and f to the forces that replace the load `line`, in N/m on own axes. Both consider the
 * hinges: they are exact for the member as a whole (Euler and Bernoulli's bending). */
void vs_member_stiffness(const vs_structure_member *m, double length, vs_vec3 line, vs_member_matrix k,
                         double f[VS_MEMBER_WAYS]);

/* Sets a to the stiffness that an axial force adds, in N and positive for tension. */
void vs_member_geometric(const vs_structure_member *m, double length, double force, vs_member_matrix a);
/* Sets a to the matrix of the member's mass, in kg. */
void vs_member_mass(const vs_structure_member *m, double length, double mass, vs_member_matrix a);

/* Turn the twelve numbers of both ends from own axes to global ones, and back. */
void vs_member_to_global(const vs_vec3 axes[3], const double own[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]);
void vs_member_to_own(const vs_vec3 axes[3], const double global[VS_MEMBER_WAYS], double out[VS_MEMBER_WAYS]);
/* Turns a matrix from own axes to global ones, in place. */
void vs_member_matrix_to_global(const vs_vec3 axes[3], vs_member_matrix k);

#endif
