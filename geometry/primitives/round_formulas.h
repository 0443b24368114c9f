/* Owns, for geometry/ alone, formulas that several round shapes share. */
#ifndef VS_GEOMETRY_PRIMITIVES_ROUND_FORMULAS_H
#define VS_GEOMETRY_PRIMITIVES_ROUND_FORMULAS_H

#include "geometry/measure/measure.h"

/* Computes volume, area and centroid of a cut cone; either radius may be 0. */
void vs_frustum_measure(vs_measure *m, vs_vec3 base, double r, vs_vec3 top, double s);
/* Is q, in the frame on the axis, in the cut cone from z = 0 to z = height? */
bool vs_frustum_holds(vs_vec3 q, double height, double base_radius, double top_radius);
double vs_ellipse_length(double a, double b); /* the circumference, of the half axes */

#endif
