/* Declares formulas that several round shapes share, for use in geometry/ alone. */
#ifndef VS_GEOMETRY_PRIMITIVES_ROUND_FORMULAS_H
#define VS_GEOMETRY_PRIMITIVES_ROUND_FORMULAS_H

#include "geometry/measure/measure.h"
#include "geometry/primitives/shape.h"

/* Sets volume, area and centroid of a cut cone with the radius r at the base and s at the top; a radius may be 0. */
void vs_frustum_measure(vs_measure *m, vs_vec3 base, double r, vs_vec3 top, double s);
/* Returns true if q lies in the cut cone between z = 0 (its base) and z = height. The coordinates of q are those of a
 * frame with the axis as Z. */
bool vs_frustum_holds(vs_vec3 q, double height, double base_radius, double top_radius);

/* The functions of vs_shape for a cylinder, cone or cut cone; each treats n as a cut cone, with equal radii or a radius
 * of 0. */
bool vs_round_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e);
bool vs_round_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
bool vs_round_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e);
bool vs_round_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height);
void vs_round_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top);

/* Defines the vs_shape of a cylinder, cone or cut cone, as VS_SHAPE does. The file must define the functions NAME_moved
 * and NAME_grown. */
#define VS_ROUND_SHAPE(lower)                                           \
  const vs_shape vs_shape_##lower = { .bounds = vs_round_bounds,        \
                                      .triangles = vs_round_triangles,  \
                                      .measure = vs_round_measure,      \
                                      .holds = vs_round_holds,          \
                                      .moved = lower##_moved,           \
                                      .axis = vs_round_axis,            \
                                      .grown = lower##_grown }

double vs_ellipse_length(double a, double b); /* returns the circumference of the ellipse with the half axes a and b */

#endif
