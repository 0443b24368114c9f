/* Declares the repair of sweeps that bend more tightly than their profile is wide, for use in geometry/ alone. */
#ifndef VS_GEOMETRY_PROFILES_OVERTURN_H
#define VS_GEOMETRY_PROFILES_OVERTURN_H

#include "geometry/profiles/swept.h"

/* Returns true if a part of the profile goes backwards from section `step` to the next section. `at`: the points of all
 * sections in order, at the end of a joined sweep those of the first again. `size`: size of the sweep. The sections' x
 * and y are right-handed about the path's direction. */
bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size);

/* Divides the steps in which a part of the profile goes backwards, as far as the tolerance requires. A step is the part
 * between two neighbouring sections. marked[r]: true if step r may be divided; NULL: all may. Returns false when memory
 * is out. */
bool vs_overturn_refine(vs_swept *s, const bool *marked, double tolerance);

/* Finds the bend that limits the size of the profile most, or if `near` is not NULL, the bend nearest to this point.
 * *at: position of the bend; *fits: factor by which the profile must be scaled down there. Both stay unchanged if no
 * bend is too tight. */
void vs_overturn_tightest(const vs_swept *s, const vs_vec3 *near, vs_vec3 *at, double *fits);

/* The vertices of a sweep's mesh. `numbers[r * n + i]`: vertex of point i in row r. `turns[r]`: true if a part of the
 * profile goes backwards from row r to the next. `inside_out`: true if the triangles have been reversed. */
typedef struct {
  const vs_swept *s;
  const uint32_t *numbers;
  const bool *turns;
  size_t steps;
  bool inside_out;
} vs_overturn_rows;
/* Appends the faces of all tetrahedra that go backwards, twice and facing outwards. The triangles of out from number
 * `first` are the sweep's walls and caps. Afterwards the winding number is above 0 exactly where the profile passes
 * through. Returns false when memory is out. */
bool vs_overturn_fill(const vs_overturn_rows *rows, size_t first, vs_mesh *out);

/* A point in a step of a sweep: between section `step` and the next section. */
typedef struct {
  vs_vec3 at;
  size_t step;
} vs_step_point;
/* All steps of a sweep. `at`: the points of all sections, one section after another, and those of the first section
 * again. `turns[r]`: true if a part of the profile goes backwards from section r to the next. */
typedef struct {
  const vs_swept *s;
  const vs_vec3 *at;
  const bool *turns;
} vs_overturn_steps;
/* Writes at most `most` random points to out, evenly distributed in the tetrahedra of all steps in which a part of the
 * profile goes backwards. *count: their number. Equal steps give equal points. Returns false when memory is out. */
bool vs_overturn_samples(const vs_overturn_steps *steps, vs_step_point *out, size_t most, size_t *count);

#endif
