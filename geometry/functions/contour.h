/* Declares closed meshes of the region of a box in which a tape's value is below 0. */
#ifndef VS_GEOMETRY_FUNCTIONS_CONTOUR_H
#define VS_GEOMETRY_FUNCTIONS_CONTOUR_H

#include "geometry/functions/tape.h"
#include "model/long_work.h"
#include "model/vec.h"

enum { VS_CONTOUR_CELLS = 1024 }; /* the most along a box's longest side */

typedef enum {
  VS_CONTOUR_DONE,
  VS_CONTOUR_EMPTY,     /* the value is nowhere below 0 in the box */
  VS_CONTOUR_NO_NUMBER, /* the tape has no value at `at` */
  VS_CONTOUR_POLE,      /* the value changes its sign through infinity near `at` */
  VS_CONTOUR_STOPPED,   /* the caller interrupted */
  VS_CONTOUR_MANY,      /* the cells' mesh has more triangles than out->most */
  VS_CONTOUR_MEMORY
} vs_contour_outcome;

typedef struct {
  vs_vec3 *points;
  uint32_t (*triangles)[3]; /* counter-clockwise seen from the side of values above 0 */
  size_t point_count, triangle_count;
  size_t point_room, triangle_room;
  vs_vec3 at;       /* the place of the failure */
  size_t most;      /* input: the most triangles of the cells before they are merged; 0: no limit */
  bool capped;      /* the box cuts the region: its sides close the mesh */
  double deviation; /* the largest distance of triangles' centres from the surface, to first order */
} vs_contour;

/* A box from its corner p to q, p below q along each axis, cut into `cells` cubes along its longest side. Cubes are
 * merged to larger ones where the surface is flat within the tolerance, a length; 0: within rounding errors. */
typedef struct { vs_vec3 p, q; int cells; double tolerance; } vs_contour_grid;

/* Makes the mesh of t(x, y, z) < 0 in the grid's box. If the cubes' own deviation is above the tolerance, none are
 * merged. The mesh is a closed manifold: each edge has two triangles and each point one fan. The caller frees it by
 * vs_contour_free after any outcome. cells is 1 to VS_CONTOUR_CELLS. */
vs_contour_outcome vs_contour_make(const vs_tape *t, const vs_contour_grid *grid, vs_long_work work, vs_contour *out);
void vs_contour_free(vs_contour *c);

#endif
