/* Declares subdivision surfaces: Catmull-Clark for polygons, Loop for triangles, with creases.
 *
 * Rules and limits: E. Catmull, J. Clark (1978); C. Loop (1987); creases of finite sharpness: T. DeRose, M. Kass, T.
 * Truong (1998). The borders of a surface are creases. A point where three or more creases end does not move. */
#ifndef VS_GEOMETRY_SHAPES_SUBDIVISION_H
#define VS_GEOMETRY_SHAPES_SUBDIVISION_H

#include "geometry/files/meshfile.h"
#include "model/long_work.h"

typedef struct {
  uint32_t a, b;    /* indices of the two points at the ends of the crease */
  double sharpness; /* number of subdivisions in which the crease stays sharp; INFINITY: it stays sharp in all */
} vs_crease;

typedef enum { VS_SUBDIVIDE_CATMULL_CLARK, VS_SUBDIVIDE_LOOP } vs_subdivision_scheme;

/* How a surface is subdivided. levels: number of subdivisions; limit: true if the points finally move to their limit
 * positions on the smooth surface; creases: edges that stay sharp. */
typedef struct {
  const vs_crease *creases;
  size_t crease_count;
  int levels;
  vs_subdivision_scheme scheme;
  bool limit;
} vs_subdivision;

/* Replaces the faces of l by subdivided faces. Two faces are neighbours only if they have common point indices. Loop's
 * scheme first divides polygons into triangles. how->levels is at least 0. Returns false when memory is out, or the
 * caller interrupts. */
bool vs_subdivide(vs_face_list *l, const vs_subdivision *how, vs_long_work work);

#endif
