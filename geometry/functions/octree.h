/* Declares the octree over the cells of a dual contour: it replaces several points by one where the surface is flat. */
#ifndef VS_GEOMETRY_FUNCTIONS_OCTREE_H
#define VS_GEOMETRY_FUNCTIONS_OCTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A contour of equal cells. A ring is a piece of the surface within a cell. A quad joins the four rings around an edge
 * of the grid that the surface crosses; the first of them is in the cell at whose lowest corner the edge begins. */
typedef struct {
  size_t rings, quads;
  const vs_vec3 *point;           /* for each ring, on the surface and within its cell */
  const int32_t (*place)[3];      /* of its cell in the grid */
  const bool *barred;             /* its cell must not be merged: another sheet passes through the same side of it */
  const uint32_t (*around)[4];    /* a quad's rings in order around the edge */
  const uint8_t *axis;            /* of its edge */
  const vs_vec3 *root, *normal;   /* the point where the surface crosses the edge, and its normal there, of length 1 */
  double size;                    /* of a cell */
  vs_long_work work;
} vs_octree_leaves;

typedef enum { VS_OCTREE_DONE, VS_OCTREE_STOPPED, VS_OCTREE_MEMORY } vs_octree_outcome;

/* Sets stands_for[ring] to the ring whose point represents it, to itself if nothing is merged. With these rings in each
 * quad, and without repeated ones, the mesh remains a closed manifold. A ring that represents others lies within
 * `tolerance` >= 0 of the planes through all their crossings. */
vs_octree_outcome vs_octree_merge(const vs_octree_leaves *leaves, double tolerance, uint32_t *stands_for);

#endif
