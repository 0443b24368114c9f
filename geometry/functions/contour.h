/* Declares the meshing of functions: it makes a closed mesh around the part of a box in which a function is below 0. A
 * tape (list of operations) describes the function. */
#ifndef VS_GEOMETRY_FUNCTIONS_CONTOUR_H
#define VS_GEOMETRY_FUNCTIONS_CONTOUR_H

#include "geometry/functions/tape.h"
#include "model/long_work.h"
#include "model/vec.h"

enum { VS_CONTOUR_CELLS = 1024 }; /* greatest number of cells along the longest side of a box */

typedef enum {
  VS_CONTOUR_DONE,
  VS_CONTOUR_EMPTY,     /* the function is nowhere below 0 in the box */
  VS_CONTOUR_NO_NUMBER, /* the function has no value at the point `at` */
  VS_CONTOUR_POLE,      /* the function changes its sign through infinity (a pole), near the point `at` */
  VS_CONTOUR_STOPPED,   /* the caller interrupted the meshing */
  VS_CONTOUR_MANY,      /* the mesh before merging has more triangles than out->most */
  VS_CONTOUR_MEMORY
} vs_contour_outcome;

typedef struct {
  vs_vec3 *points;
  uint32_t (*triangles)[3]; /* corners of the mesh's triangles, counter-clockwise as seen from outside, where the
                             * function is above 0 */
  size_t point_count, triangle_count;
  size_t point_room, triangle_room;
  vs_vec3 at;       /* point where the function has no value (VS_CONTOUR_NO_NUMBER) or is infinite (VS_CONTOUR_POLE) */
  size_t most;      /* input: greatest number of triangles of the mesh before cells are merged; 0: no limit */
  bool capped;      /* true if the function is below 0 up to a side of the box, so that this side closes the mesh */
  double deviation; /* largest distance of a triangle's centre from the surface, to first order */
} vs_contour;

/* A box from corner p to corner q, p < q along each axis, divided into cubes. `cells`: number of cubes along its
 * longest side. `tolerance`: cubes are merged where the surface is flat within this length. */
typedef struct { vs_vec3 p, q; int cells; double tolerance; } vs_contour_grid;

/* Makes the closed mesh of the part of the grid's box where t(x, y, z) < 0. grid->cells is 1 to VS_CONTOUR_CELLS. The
 * caller frees the mesh with vs_contour_free after any outcome. */
vs_contour_outcome vs_contour_make(const vs_tape *t, const vs_contour_grid *grid, vs_long_work work, vs_contour *out);
void vs_contour_free(vs_contour *c);

#endif
