/* Declares rigid motions with six unknowns and their derivatives, and the principal axes of points. */
#ifndef VS_GEOMETRY_FITTING_RIGID_MOTION_H
#define VS_GEOMETRY_FITTING_RIGID_MOTION_H

#include "model/vec.h"

#include <stddef.h>

enum { VS_RIGID_UNKNOWNS = 6 };

/* A rigid motion q = exp(w) R (p - c) + t + s. It has six unknowns, all 0 at the start and all lengths: a rotation
 * vector w times `size`, and the shift s. */
typedef struct {
  double turn[3][3];  /* rotation matrix R of the formula, row by row */
  vs_vec3 centre, to; /* centre: point c of the formula; to: point t */
  double size;        /* a length of the scan, which converts rotations in radians to lengths */
} vs_rigid_motion;

/* Returns the motion m changed by the given unknowns. For the result, the same motion has unknowns of 0. m->size is
 * above 0. */
vs_rigid_motion vs_rigid_moved(const vs_rigid_motion *m, const double unknowns[VS_RIGID_UNKNOWNS]);
static inline vs_vec3 vs_rigid_point(const vs_rigid_motion *m, vs_vec3 p) {
  vs_vec3 d = vs_v3_sub(p, m->centre);
  return vs_v3(m->turn[0][0] * d.x + m->turn[0][1] * d.y + m->turn[0][2] * d.z + m->to.x,
               m->turn[1][0] * d.x + m->turn[1][1] * d.y + m->turn[1][2] * d.z + m->to.y,
               m->turn[2][0] * d.x + m->turn[2][1] * d.y + m->turn[2][2] * d.z + m->to.z);
}
/* Computes the left Jacobian J of the rotation group for the rotation vector w in the unknowns: rotation by w + dw
 * equals rotation by w, then by J dw, for a small dw. `size` is above 0. */
void vs_rigid_jacobian(const double unknowns[VS_RIGID_UNKNOWNS], double size, double out[3][3]);
/* Returns the motion m as an affine map. */
vs_affine vs_rigid_map(const vs_rigid_motion *m);
/* Returns the inverse of the motion m as an affine map. */
vs_affine vs_rigid_inverse(const vs_rigid_motion *m);

/* Computes the eigenvalues of the symmetric n by n matrix m in descending order, and unit eigenvectors in the columns
 * of v (Jacobi's method). Both matrices are stored row by row; m is overwritten. */
void vs_symmetric_eigen(double *m, double *v, double *values, size_t n);
/* Weighted sums over points, from which vs_point_moments_axes computes the centre and the axes of the points. */
typedef struct {
  double weight;
  vs_vec3 sum;
  double square[3][3];
} vs_point_moments;
void vs_point_moments_add(vs_point_moments *s, vs_vec3 p, double weight);
/* Computes the centre and the axes of the points that were added to s. *spread: root of the mean square distance from
 * the centre. The sum of the weights is above 0. */
void vs_point_moments_axes(const vs_point_moments *s, vs_vec3 *centre, double axes[3][3], double *spread);

#endif
