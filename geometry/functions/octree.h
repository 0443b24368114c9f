/* Owns the octree over the cells of a dual contour: which of its points stand for others, where the surface is flat. */
#ifndef VS_GEOMETRY_FUNCTIONS_OCTREE_H
#define VS_GEOMETRY_FUNCTIONS_OCTREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A contour of equal cells. A ring is where the surface passes through a cell; a quad joins the four rings around an
 * edge of the grid that the surface crosses, the first of them in the cell at whose lowest corner the edge begins. */
typedef struct {
  size_t rings, quads;
  const vs_vec3 *point;           /* of each ring, on the surface and within its cell */
  const int32_t (*place)[3];      /* of its cell in the grid */
  const bool *barred;             /* its cell is not to be merged: another sheet passes through the same side of it */
  const uint32_t (*around)[4];    /* a quad's rings in order round the edge */
  const uint8_t *axis;            /* of its edge */
  const vs_vec3 *root, *normal;   /* where the surface crosses the edge, and its normal there, of length 1 */
  double size;                    /* of a cell */
  vs_long_work work;
} vs_octree_leaves;

typedef enum { VS_OCTREE_DONE, VS_OCTREE_STOPPED, VS_OCTREE_MEMORY } vs_octree_outcome;

/* stands_for[ring] becomes the ring whose point stands for it, itself where nothing is merged. With each quad's rings
 * taken so, and those that are one left out, the mesh is a closed manifold as before. A ring that stands for others
 * lies within `tolerance` of the planes through all their crossings. The tolerance is 0 or more. */
vs_octree_outcome vs_octree_merge(const vs_octree_leaves *leaves, double tolerance, uint32_t *stands_for);

#endif
