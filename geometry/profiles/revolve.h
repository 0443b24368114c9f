/* Declares, for geometry/ and the back-ends, revolutions: a profile as distances from an axis and heights along it, turned
 * about that axis. */
#ifndef VS_GEOMETRY_PROFILES_REVOLVE_H
#define VS_GEOMETRY_PROFILES_REVOLVE_H

#include "geometry/measure/measure.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"
#include "geometry/plane/ear_clipping.h"

typedef struct {
  vs_vec2 *profile;     /* x: the distance from the axis, >= 0, exactly 0 on it; y: along the axis. Loops one after the
                         * other, as in an outline */
  size_t *sizes;
  bool *hole;
  size_t loop_count, count;
  bool filled;          /* false: an open profile, which makes a surface */
  vs_vec3 at, axis, out, side; /* a point of the axis; unit vectors: along it, towards the profile, and a quarter turn
                                * farther */
  double start, angle;  /* radians; angle has a sign, and is at most a turn */
  bool full;
  double reach;         /* the largest distance from the axis */
} vs_revolve;

void vs_revolve_free(vs_revolve *r);
/* Plans a revolution. Fails if the profile's plane does not contain the axis, or the profile crosses it. */
bool vs_revolve_plan(const vs_node *n, const vs_fineness *f, vs_revolve *out, vs_error *e);
size_t vs_revolve_steps(const vs_revolve *r, const vs_fineness *f, int segments); /* steps of the whole angle */
/* Appends the triangles; steps is above 0. Returns false when memory is out. */
bool vs_revolve_mesh(const vs_revolve *r, size_t steps, vs_mesh *out);
void vs_revolve_bounds(const vs_revolve *r, const vs_affine *a, vs_bounds *b);
/* Returns true if the solid, whose profile is filled, contains p. */
bool vs_revolve_holds(const vs_revolve *r, vs_vec3 p);
/* Measures by Pappus, with the moments of the plan's polygon; exactly if the polygon is a circle's. */
bool vs_revolve_measure(const vs_node *n, const vs_fineness *f, vs_measure *m, vs_error *e);
/* Returns the radius of a profile that is one circle, placed so that it stays circular; else 0. */
double vs_profile_circle(const vs_node *profile);
/* even-odd rule, in the plane of the loops */
bool vs_loops_hold(const vs_vec2 *at, const size_t *sizes, size_t loop_count, double x, double y);

#endif
