/* Declares rational B-splines: their points and slopes, and the parameters at which they are sampled.
 *
 * Notation: L. Piegl and W. Tiller, The NURBS Book (1997). A direction has `count` control points, a degree p and count
 * + p + 1 non-decreasing knots; the parameter goes from knots[p] to knots[count]. */
#ifndef VS_GEOMETRY_PROFILES_NURBS_H
#define VS_GEOMETRY_PROFILES_NURBS_H

#include "model/node.h"

enum { VS_NURBS_DEGREE = 15 };

typedef struct {
  int degree; /* 1 to VS_NURBS_DEGREE */
  size_t count;
  const double *knots;
} vs_nurbs_knots;

typedef struct {
  vs_nurbs_knots u, v;   /* a curve has u alone: v.count is 0 */
  const vs_vec3 *points; /* of a surface row by row, u.count rows of v.count */
  const double *weights; /* as many, or NULL: all are 1 */
} vs_nurbs;

typedef enum { VS_NURBS_GOOD, VS_NURBS_FALLS, VS_NURBS_BREAKS, VS_NURBS_NOTHING } vs_nurbs_fault;
/* Checks for decreasing knots; an inner knot with a multiplicity above `degree`, where a curve is discontinuous; an
 * empty range of the parameter. *at: the index of the knot. */
vs_nurbs_fault vs_nurbs_check(const vs_nurbs_knots *k, size_t *at);

double vs_nurbs_low(const vs_nurbs_knots *k);
double vs_nurbs_high(const vs_nurbs_knots *k);
/* Returns the point of a curve, or of a surface at (u, v); slopes may be NULL. Parameters are clamped to their
 * ranges. */
vs_vec3 vs_nurbs_point(const vs_nurbs *n, double u, double v, vs_vec3 *slope_u, vs_vec3 *slope_v);

/* Makes ascending parameters of one direction, including both ends and all knots. Samples of a curve, or of a surface's
 * lines in that direction, are within `chord` > 0 of their chords. Returns their number; the caller frees *out. 0: out
 * of memory. */
size_t vs_nurbs_parameters(const vs_nurbs *n, bool along_v, double chord, double **out);

/* Returns a curve as a node: splines through its points, within a 1e-7th of its size, joined at corners; a polyline if
 * the degree is 1; the empty node if all points are equal. NULL: out of memory. */
vs_node *vs_nurbs_curve_node(vs_store *s, const vs_nurbs *n);

#endif
