/* Declares, for use in geometry/ alone, the steps of a sweep that bends more tightly than its profile is wide. */
#ifndef VS_GEOMETRY_PROFILES_OVERTURN_H
#define VS_GEOMETRY_PROFILES_OVERTURN_H

#include "geometry/profiles/swept.h"

/* at: the points of all sections, section by section, and once more those of the first where the last goes on to it;
 * size: of the whole sweep. The sections' x and y turn right-handed about the way. Does part of the profile go
 * backwards from section `step` to the one that follows it? */
bool vs_overturns(const vs_swept *s, const vs_vec3 *at, size_t step, double size);

/* Cuts such steps into as many as the tolerance needs: tetrahedra that reach over the line on which the profile stands
 * still miss it by a quarter of what their corners differ by. False: out of memory. */
bool vs_overturn_refine(vs_swept *s, double tolerance);

/* The bend that leaves the profile the least room, or that nearest to `near`, where this is not NULL: its place on the
 * path, and how many times as large the profile may be there. Where no bend is too tight neither is changed. */
void vs_overturn_tightest(const vs_swept *s, const vs_vec3 *near, vs_vec3 *at, double *fits);

/* The rows of a grid mesh: numbers[r * n + i] is the vertex of point i in row r; turns[r]: the step from row r to the
 * next goes backwards somewhere, and its walls are cut by number (grid.h). inside_out: the triangles have been turned.
 */
typedef struct {
  const vs_swept *s;
  const uint32_t *numbers;
  const bool *turns;
  size_t steps;
  bool inside_out;
} vs_overturn_rows;
/* The triangles of out from number `first` on are the walls and caps of these rows. Adds, twice, all that goes
 * backwards, the right way out: then the mesh winds more than 0 times around all that the profile passes through, and
 * around nothing else. False: out of memory. */
bool vs_overturn_fill(const vs_overturn_rows *rows, size_t first, vs_mesh *out);

#endif
