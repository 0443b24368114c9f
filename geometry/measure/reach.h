/* Declares functions that compute bounds of round shapes under an affine map, for use in geometry/ alone. */
#ifndef VS_GEOMETRY_MEASURE_REACH_H
#define VS_GEOMETRY_MEASURE_REACH_H

#include "model/vec.h"

#include <stddef.h>

/* Enlarges the bounds b by a disc of radius r, perpendicular to `normal`, mapped by a. */
void vs_reach_disc(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 normal, double r);
/* Enlarges the bounds b by an ellipse in the XY plane of `frame`, mapped by a. rx, ry: its radii along X and Y. */
void vs_reach_oval(vs_bounds *b, const vs_affine *a, const vs_affine *frame, vs_vec3 center, double rx, double ry);
/* Enlarges the bounds b by the space of a moving ball of radius r, mapped by a. The ball's centre moves on a horizontal
 * circle of radius `ring` about center. */
void vs_reach_ball(vs_bounds *b, const vs_affine *a, vs_vec3 center, double ring, double r);
/* Enlarges b by n points mapped by a. */
void vs_reach_points(vs_bounds *b, const vs_affine *a, const vs_vec3 *at, size_t n);
/* Enlarges the bounds b by a box around the centre mapped by a, which extends by `reach` to each side. */
void vs_reach_sides(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 reach);
vs_vec3 vs_reach_row(const vs_affine *a, int i); /* returns row i (0 to 2) of the linear part of the affine map a */

#endif
