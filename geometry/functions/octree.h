/* Declares an octree over the cells of a dual contour. It replaces several points by one where the surface is flat. */
#ifndef VS_GEOMETRY_FUNCTIONS_OCTREE_H
#define VS_GEOMETRY_FUNCTIONS_OCTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A contour of cells of equal size. A ring is a piece of the surface within a cell. A quad connects the four rings
 * around an edge of the grid that the surface crosses. The edge begins at the lowest corner of a cell; the first ring
 * of the quad lies in this cell. */
typedef struct {
  size_t rings, quads;
  const vs_vec3 *point;           /* point of each ring, on the surface and within its cell */
  const int32_t (*place)[3];      /* grid position of each ring's cell */
  const bool *barred;             /* true if the ring's cell must not be merged, because another sheet of the surface
                                   * passes through a side of this cell */
  const uint32_t (*around)[4];    /* the four rings of each quad, in order around the edge */
  const uint8_t *axis;            /* axis of each quad's edge */
  const vs_vec3 *root, *normal;   /* for each quad: the point where the surface crosses the edge, and its unit normal
                                   * there */
  double size;                    /* size of a cell */
  vs_long_work work;
} vs_octree_leaves;

typedef enum { VS_OCTREE_DONE, VS_OCTREE_STOPPED, VS_OCTREE_MEMORY } vs_octree_outcome;

/* Sets stands_for[ring] to the ring whose point replaces the ring's point, or to the ring itself if it is not merged.
 * If each quad uses these points, without repeated points, the mesh remains a closed manifold. A point that replaces
 * others is within `tolerance` of the planes through all their crossings. tolerance is at least 0. */
vs_octree_outcome vs_octree_merge(const vs_octree_leaves *leaves, double tolerance, uint32_t *stands_for);

#endif
