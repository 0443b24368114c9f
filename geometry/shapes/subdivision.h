/* Owns subdivision surfaces: Catmull and Clark's of polygons, Loop's of triangles, with creases.
 *
 * Rules and limits: E. Catmull, J. Clark (1978); C. Loop (1987); creases of some sharpness: T. DeRose, M. Kass,
 * T. Truong (1998). Borders are creases; where three creases or more meet the point stays. */
#ifndef VS_GEOMETRY_SHAPES_SUBDIVISION_H
#define VS_GEOMETRY_SHAPES_SUBDIVISION_H

#include "geometry/files/meshfile.h"
#include "model/long_work.h"

typedef struct {
  uint32_t a, b;    /* points */
  double sharpness; /* levels that the edge stays sharp; INFINITY: all */
} vs_crease;

typedef enum { VS_SUBDIVIDE_CATMULL_CLARK, VS_SUBDIVIDE_LOOP } vs_subdivision_scheme;

/* How often faces are subdivided, by which scheme, and with which creases. limit: the points then go to where they
 * would come to lie after endless subdivisions. */
typedef struct {
  const vs_crease *creases;
  size_t crease_count;
  int levels;
  vs_subdivision_scheme scheme;
  bool limit;
} vs_subdivision;

/* Replaces the faces of l, whose points are those that their corners share, by the subdivided ones. Loop takes polygons
 * as fans of triangles. False: out of memory, or the caller said so. levels are 0 or more. */
bool vs_subdivide(vs_face_list *l, const vs_subdivision *how, vs_long_work work);

#endif
