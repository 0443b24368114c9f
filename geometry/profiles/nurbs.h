/* Declares rational B-splines: their points and derivatives, and the parameters at which they are sampled.
 *
 * The notation is that of L. Piegl and W. Tiller, The NURBS Book (1997). In one direction, a spline has `count` control
 * points, a degree p and count + p + 1 non-decreasing knots. The parameter goes from knots[p] to knots[count]. */
#ifndef VS_GEOMETRY_PROFILES_NURBS_H
#define VS_GEOMETRY_PROFILES_NURBS_H

#include "model/node.h"

enum { VS_NURBS_DEGREE = 15 };

typedef struct {
  int degree; /* degree of the spline, 1 to VS_NURBS_DEGREE */
  size_t count;
  const double *knots;
} vs_nurbs_knots;

typedef struct {
  vs_nurbs_knots u, v;   /* knots in the two directions; a curve has only u, and v.count is 0 */
  const vs_vec3 *points; /* control points: u.count points for a curve; u.count rows of v.count points for a surface */
  const double *weights; /* weights[i]: weight of control point i; NULL: all weights are 1 */
} vs_nurbs;

typedef enum { VS_NURBS_GOOD, VS_NURBS_FALLS, VS_NURBS_BREAKS, VS_NURBS_NOTHING } vs_nurbs_fault;
/* Checks the knots of one direction. Faults are: a knot below the one before it; an inner knot that occurs more than
 * `degree` times, so that the curve is discontinuous; an empty range of the parameter. *at: index of the faulty
 * knot. */
vs_nurbs_fault vs_nurbs_check(const vs_nurbs_knots *k, size_t *at);

double vs_nurbs_low(const vs_nurbs_knots *k);
double vs_nurbs_high(const vs_nurbs_knots *k);
/* Returns the point of a curve at u, or of a surface at (u, v). Parameters outside of their range are clamped.
 * *slope_u, *slope_v: receive the derivatives by u and v; the pointers may be NULL. */
vs_vec3 vs_nurbs_point(const vs_nurbs *n, double u, double v, vs_vec3 *slope_u, vs_vec3 *slope_v);

/* Computes the parameters at which one direction is sampled, in ascending order. The curve, or each line of a surface
 * in this direction, is then within `chord` > 0 of the chords between samples. Returns the number of parameters, or 0
 * when memory is out. The caller frees *out. */
size_t vs_nurbs_parameters(const vs_nurbs *n, bool along_v, double chord, double **out);

/* Returns a node for a curve: interpolating splines, joined at corners, which deviate from the curve by at most 1e-7 of
 * its size. A curve of degree 1 becomes a polyline. If all points are equal, the node is empty. Returns NULL when
 * memory is out. */
vs_node *vs_nurbs_curve_node(vs_store *s, const vs_nurbs *n);

#endif
