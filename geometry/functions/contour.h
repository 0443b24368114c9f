/* Owns closed meshes of the places where a tape's value is below 0, within a box. */
#ifndef VS_GEOMETRY_FUNCTIONS_CONTOUR_H
#define VS_GEOMETRY_FUNCTIONS_CONTOUR_H

#include "geometry/functions/tape.h"
#include "model/long_work.h"
#include "model/vec.h"

enum { VS_CONTOUR_CELLS = 1024 }; /* along a box's longest side, at most */

typedef enum {
  VS_CONTOUR_DONE,
  VS_CONTOUR_EMPTY,     /* the value is nowhere below 0 in the box */
  VS_CONTOUR_NO_NUMBER, /* the tape has no value at `at` */
  VS_CONTOUR_POLE,      /* the value changes its sign through infinity near `at` */
  VS_CONTOUR_STOPPED,   /* the caller said so */
  VS_CONTOUR_MANY,      /* the cells' mesh has more triangles than out->most */
  VS_CONTOUR_MEMORY
} vs_contour_outcome;

typedef struct {
  vs_vec3 *points;
  uint32_t (*triangles)[3]; /* counter-clockwise seen from where the value is above 0 */
  size_t point_count, triangle_count;
  size_t point_room, triangle_room;
  vs_vec3 at;       /* where it failed */
  size_t most;      /* set before: so many triangles are all that the cells may have before they are merged; 0: any */
  bool capped;      /* the box cuts what is below 0: its sides close the mesh */
  double deviation; /* how far triangles' middles lie from the surface, to first order */
} vs_contour;

/* A box from its corner p to q, p below q along each axis, cut into `cells` cubes along its longest side. They are
 * merged to larger ones where the surface is flat within the tolerance, a length; 0: but for rounding. */
typedef struct { vs_vec3 p, q; int cells; double tolerance; } vs_contour_grid;

/* The mesh of t(x, y, z) < 0 in the grid's box. Where the deviation of the cubes themselves is above the tolerance,
 * none are merged. It is a closed manifold: each edge has two triangles and each point one fan. The caller frees it by
 * vs_contour_free, whatever the outcome. cells is 1 to VS_CONTOUR_CELLS. */
vs_contour_outcome vs_contour_make(const vs_tape *t, const vs_contour_grid *grid, vs_long_work work, vs_contour *out);
void vs_contour_free(vs_contour *c);

#endif
