/* Declares, for use in geometry/ alone, the extents of round shapes under an affine map. */
#ifndef VS_GEOMETRY_MEASURE_REACH_H
#define VS_GEOMETRY_MEASURE_REACH_H

#include "model/vec.h"

#include <stddef.h>

/* Each function enlarges b by the bounds, mapped by a, of the shape in its name. */
void vs_reach_disc(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 normal, double r);
/* An ellipse with the radius rx along X and ry along Y of the frame. */
void vs_reach_oval(vs_bounds *b, const vs_affine *a, const vs_affine *frame, vs_vec3 center, double rx, double ry);
/* A ball of radius r whose centre moves on a horizontal circle of radius `ring`. */
void vs_reach_ball(vs_bounds *b, const vs_affine *a, vs_vec3 center, double ring, double r);
void vs_reach_points(vs_bounds *b, const vs_affine *a, const vs_vec3 *at, size_t n);
/* A body that extends by `reach` along x, y and z to both sides of the mapped centre. */
void vs_reach_sides(vs_bounds *b, const vs_affine *a, vs_vec3 center, vs_vec3 reach);
vs_vec3 vs_reach_row(const vs_affine *a, int i); /* returns row i of the linear part of a */

#endif
