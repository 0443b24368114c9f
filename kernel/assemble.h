/* Owns what comes into the result by copying: meshes that stand as they are, and results once more elsewhere. Room for
 * each is made in order; threads fill it in the end, when all that they copy from is there. */
#ifndef VS_KERNEL_ASSEMBLE_H
#define VS_KERNEL_ASSEMBLE_H

#include "kernel/problem.h"
#include "kernel/memory.h"

typedef struct { size_t vertex, triangle, vertices, triangles; } vs_range; /* the first of each, and how many */

typedef struct {
  const vs_mesh *mesh;       /* what is copied, all of it; NULL: a range of the result */
  vs_range from;
  uint32_t into;             /* which result */
  size_t vertex, triangle;   /* where to */
  vs_affine map;
  const uint32_t *were, *leaves; /* triangles of the tag of leaf were[i] have that of leaves[i] now; were NULL: all have
                                  * that of leaves[0] */
  uint32_t leaf_count;
} vs_placement;

typedef struct {
  VS_LIST(vs_placement) meshes, again;
} vs_placing;

/* Makes room in a result, with tags, and counts it in. */
bool vs_placing_room(vs_kernel *k, vs_mesh *out, size_t vertices, size_t triangles);
/* Does all that is listed. */
bool vs_placing_finish(vs_kernel *k, vs_placing *p, const vs_kernel_leaf *leaves, vs_mesh *results);
void vs_placing_free(vs_kernel *k, vs_placing *p);

#endif
