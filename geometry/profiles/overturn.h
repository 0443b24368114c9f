/* Declares, for use in geometry/ alone, the repair of sweeps that bend more tightly than their profile is wide. */
#ifndef VS_GEOMETRY_PROFILES_OVERTURN_H
#define VS_GEOMETRY_PROFILES_OVERTURN_H

#include "geometry/profiles/swept.h"

/* Returns true if a part of the profile goes backwards from section `step` to the next section. The array `at` has the
 * points of all sections, one section after another. If the sweep is joined, the points of the first section follow
 * again. The size of the sweep is `size`. The x and y of a section are right-handed about the path's direction. */
bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size);

/* Divides steps in which a part of the profile goes backwards into as many steps as the tolerance requires: the steps r
 * with marked[r], or all if marked is NULL. In such a step, the tetrahedra deviate from the sweep by a quarter of the
 * difference between the distances of their corners. Returns false when memory is out. */
bool vs_overturn_refine(vs_swept *s, const bool *marked, double tolerance);

/* Finds the bend that limits the size of the profile most, or if `near` is not NULL, the bend nearest to this point.
 * *at: position of the bend on the path; *fits: factor by which the profile must be scaled down there. If no bend is
 * too tight, *at and *fits are not changed. */
void vs_overturn_tightest(const vs_swept *s, const vs_vec3 *near, vs_vec3 *at, double *fits);

/* The vertices of a sweep's mesh. numbers[r * n + i]: vertex of point i in row r. The element turns[r] is true if a
 * part of the profile goes backwards in the step from row r to the next. The walls of this step are then cut by number
 * (grid.h). The member inside_out is true if the triangles have been reversed. */
typedef struct {
  const vs_swept *s;
  const uint32_t *numbers;
  const bool *turns;
  size_t steps;
  bool inside_out;
} vs_overturn_rows;
/* Appends twice, facing outwards, the faces of all tetrahedra that go backwards. The triangles of out from index
 * `first` on must be the walls and caps of a sweep with these rows. Afterwards the winding number of the mesh is above
 * 0 exactly in the places through which the profile passes. Returns false when memory is out. */
bool vs_overturn_fill(const vs_overturn_rows *rows, size_t first, vs_mesh *out);

/* A point in the step from section `step` of a sweep to the next section. */
typedef struct {
  vs_vec3 at;
  size_t step;
} vs_step_point;
/* All steps of a sweep. The array `at` has the points of all sections, one section after another, and those of the
 * first again. The element turns[r] is true if a part of the profile goes backwards in the step from section r to the
 * next. */
typedef struct {
  const vs_swept *s;
  const vs_vec3 *at;
  const bool *turns;
} vs_overturn_steps;
/* Writes at most `most` random points to out, evenly distributed in the tetrahedra of all steps in which a part of the
 * profile goes backwards. *count: their number. Equal steps give equal points. Returns false when memory is out. */
bool vs_overturn_samples(const vs_overturn_steps *steps, vs_step_point *out, size_t most, size_t *count);

#endif
