/* Declares rigid motions near a given one, with their derivatives, and the principal axes of points. */
#ifndef VS_GEOMETRY_FITTING_RIGID_MOTION_H
#define VS_GEOMETRY_FITTING_RIGID_MOTION_H

#include "model/vec.h"

#include <stddef.h>

enum { VS_RIGID_UNKNOWNS = 6 };

/* The motion q = exp(w) R (p - c) + t + s. Its unknowns are w, a rotation vector times `size`, and the shift s: six
 * lengths, all 0 at the start. */
typedef struct {
  double turn[3][3];  /* R, row by row */
  vs_vec3 centre, to; /* c and t of the formula */
  double size;        /* a length of the scan, which converts rotations to lengths */
} vs_rigid_motion;

/* Returns the motion with these unknowns, as one whose unknowns are 0. The motion's size is above 0. */
vs_rigid_motion vs_rigid_moved(const vs_rigid_motion *m, const double unknowns[VS_RIGID_UNKNOWNS]);
static inline vs_vec3 vs_rigid_point(const vs_rigid_motion *m, vs_vec3 p) {
  vs_vec3 d = vs_v3_sub(p, m->centre);
  return vs_v3(m->turn[0][0] * d.x + m->turn[0][1] * d.y + m->turn[0][2] * d.z + m->to.x,
               m->turn[1][0] * d.x + m->turn[1][1] * d.y + m->turn[1][2] * d.z + m->to.y,
               m->turn[2][0] * d.x + m->turn[2][1] * d.y + m->turn[2][2] * d.z + m->to.z);
}
/* Computes the left Jacobian of the rotation group at the unknowns: rotation by w + dw is rotation by w, then by J dw.
 * size is above 0. */
void vs_rigid_jacobian(const double unknowns[VS_RIGID_UNKNOWNS], double size, double out[3][3]);
/* vs_rigid_map returns the motion as an affine map, vs_rigid_inverse the inverse map. */
vs_affine vs_rigid_map(const vs_rigid_motion *m);
vs_affine vs_rigid_inverse(const vs_rigid_motion *m);

/* Computes eigenvalues of the symmetric n by n matrix m, which is overwritten, in descending order, and unit
 * eigenvectors in the columns of v; both matrices row by row (Jacobi's method). */
void vs_symmetric_eigen(double *m, double *v, double *values, size_t n);
/* Sums over weighted points. They determine the centre of the points, and their axes in descending order of spread as
 * the rows of a rotation. */
typedef struct {
  double weight;
  vs_vec3 sum;
  double square[3][3];
} vs_point_moments;
void vs_point_moments_add(vs_point_moments *s, vs_vec3 p, double weight);
/* Computes the centre and the axes of the points. *spread: root of the mean square distance from the centre. The sum of
 * the weights is above 0. */
void vs_point_moments_axes(const vs_point_moments *s, vs_vec3 *centre, double axes[3][3], double *spread);

#endif
