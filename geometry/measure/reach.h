/* Declares, for use in geometry/ alone, the bounds of round shapes under an affine map. */
#ifndef VS_GEOMETRY_MEASURE_REACH_H
#define VS_GEOMETRY_MEASURE_REACH_H

#include "model/vec.h"

#include <stddef.h>

/* vs_reach_disc, _oval, _ball, _points and _sides enlarge b by the bounds, mapped by a, of a disc, an ellipse, a moving
 * ball, points, and a box. */
void vs_reach_disc(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 normal, double r);
/* Enlarges b by an ellipse, mapped by a, with the radius rx along X and ry along Y of the frame. */
void vs_reach_oval(vs_bounds *b, const vs_affine *a, const vs_affine *frame, vs_vec3 center, double rx, double ry);
/* Enlarges b by the space, mapped by a, of a ball of radius r whose centre moves on a horizontal circle of radius
 * `ring`. */
void vs_reach_ball(vs_bounds *b, const vs_affine *a, vs_vec3 center, double ring, double r);
void vs_reach_points(vs_bounds *b, const vs_affine *a, const vs_vec3 *at, size_t n);
/* Enlarges b by a body that extends by `reach` along x, y and z to both sides of the centre mapped by a. */
void vs_reach_sides(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 reach);
vs_vec3 vs_reach_row(const vs_affine *a, int i); /* returns row i (0 to 2) of the linear part of a */

#endif
