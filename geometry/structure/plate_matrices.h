/* Declares the matrices of a flat triangle of a shell: it carries forces in its plane, and bends. */
#ifndef VS_GEOMETRY_STRUCTURE_PLATE_MATRICES_H
#define VS_GEOMETRY_STRUCTURE_PLATE_MATRICES_H

#include "geometry/structure/structure.h"

enum { VS_PLATE_WAYS = 3 * VS_WAYS, VS_PLATE_FORCES = 6 };

/* A matrix over the degrees of freedom of the three corners, in global axes. */
typedef double vs_plate_matrix[VS_PLATE_WAYS][VS_PLATE_WAYS];

/* Sets axes to the triangle's own axes: x is the global x projected into the plane (the global y, if the plane is
 * perpendicular to x); around z, the corners run counter-clockwise. Returns the area, 0 for corners on a line. */
double vs_plate_axes(const vs_vec3 at[3], vs_vec3 axes[3]);

/* Sets k to the stiffness of a triangle whose area is above 0. In its plane it is Felippa's optimal triangle with
 * rotations about the normal; across its plane it is a discrete Kirchhoff triangle. */
void vs_plate_stiffness(const vs_structure_plate *p, const vs_vec3 at[3], vs_plate_matrix k);

/* Sets forces to the forces and moments in the triangle's middle, in its own axes: n_x, n_y, n_xy, m_x, m_y, m_xy.
 * Moments that stretch the lower side are positive. moved: movements of the corners. */
void vs_plate_forces(const vs_structure_plate *p, const vs_vec3 at[3], const double moved[VS_PLATE_WAYS],
                     double forces[VS_PLATE_FORCES]);

#endif
