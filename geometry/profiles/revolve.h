/* Declares revolutions, for geometry/ and the back-ends: a profile that is turned about an axis. Its points are given
 * by distances from the axis and heights along it. */
#ifndef VS_GEOMETRY_PROFILES_REVOLVE_H
#define VS_GEOMETRY_PROFILES_REVOLVE_H

#include "geometry/measure/measure.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "geometry/plane/ear_clipping.h"

typedef struct {
  vs_vec2 *profile;     /* Points of the profile's loops, one loop after another, as in an outline. x: distance from the
                         * axis, at least 0, and exactly 0 on the axis; y: height along the axis. */
  size_t *sizes;
  bool *hole;
  size_t loop_count, count;
  bool filled;          /* true for a solid; false if the profile is an open curve, which sweeps a surface */
  vs_vec3 at, axis, out, side; /* at: a point of the axis; axis: unit vector along the axis; out: unit vector from the
                                * axis towards the profile; side: unit vector a quarter turn further */
  double start, angle;  /* start: angle at which the profile begins; angle: angle by which it is turned, negative for
                         * the opposite direction and at most a full turn; in radians */
  bool full;
  double reach;         /* largest distance of the profile's points from the axis */
} vs_revolve;

void vs_revolve_free(vs_revolve *r);
/* Computes the data of the revolution n. Returns false and sets e if the profile's plane does not contain the axis, or
 * the profile crosses the axis. */
bool vs_revolve_plan(const vs_node *n, const vs_fineness *f, vs_revolve *out, vs_error *e);
size_t vs_revolve_steps(const vs_revolve *r, const vs_fineness *f, int segments); /* returns the number of steps into
                                                                                   * which the angle of the revolution
                                                                                   * is divided for its mesh */
/* Appends the triangles of the revolution. steps > 0. Returns false when memory is out. */
bool vs_revolve_mesh(const vs_revolve *r, size_t steps, vs_mesh *out);
void vs_revolve_bounds(const vs_revolve *r, const vs_affine *a, vs_bounds *b);
/* Returns true if the solid of revolution contains p. r->filled must be true. */
bool vs_revolve_holds(const vs_revolve *r, vs_vec3 p);
/* Measures the revolution by Pappus's theorem, with the moments of the profile's polygon. If the profile is a circle,
 * the result is exact. Returns false and sets e on failure. */
bool vs_revolve_measure(const vs_node *n, const vs_fineness *f, vs_measure *m, vs_error *e);
/* Returns the radius of a profile that is a circle; placements that preserve circles may be around it. Returns 0 for
 * any other profile. */
double vs_profile_circle(const vs_node *profile);
/* Returns true if the point (x, y) is inside the loops by the even-odd rule, in the plane of the loops. */
bool vs_loops_hold(const vs_vec2 *at, const size_t *sizes, size_t loop_count, double x, double y);

#endif
