/* Declares an octree over the cells of a mesh that was made from a function (dual contouring). It replaces several
 * points of the mesh by one where the surface is flat. */
#ifndef VS_GEOMETRY_FUNCTIONS_OCTREE_H
#define VS_GEOMETRY_FUNCTIONS_OCTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* The cells of a dual contour (mesh of a function), all of one size. A ring is a piece of the surface within a cell. A
 * quad connects the four rings around an edge of the grid that the surface crosses. */
typedef struct {
  size_t rings, quads;
  const vs_vec3 *point;           /* point[r]: point of ring r (a piece of the surface within a cell), on the surface
                                   * and within the cell */
  const int32_t (*place)[3];      /* place[r]: position in the grid of the cell that contains ring r, a piece of the
                                   * surface */
  const bool *barred;             /* barred[r]: true if ring r's cell must not be merged, because two sheets of the
                                   * surface pass through one side of this cell */
  const uint32_t (*around)[4];    /* around[q]: the four rings (pieces of the surface in cells) that quad q connects, in
                                   * order around a crossed edge of the grid */
  const uint8_t *axis;            /* axis[q]: axis (0 to 2) of the grid's edge that quad q surrounds */
  const vs_vec3 *root, *normal;   /* root[q], normal[q]: point where the surface crosses the edge that quad q surrounds,
                                   * and the surface's unit normal there */
  double size;                    /* side length of a cell */
  vs_long_work work;
} vs_octree_leaves;

typedef enum { VS_OCTREE_DONE, VS_OCTREE_STOPPED, VS_OCTREE_MEMORY } vs_octree_outcome;

/* Sets stands_for[r] to the ring (piece of the surface in a cell) whose point replaces the point of ring r; to r if it
 * keeps its point. Such a point is within `tolerance` of the planes through all crossings that it replaces. */
vs_octree_outcome vs_octree_merge(const vs_octree_leaves *leaves, double tolerance, uint32_t *stands_for);

#endif
