/* Owns the parts of the result that are copied: meshes that stay unchanged, and results at further places. The kernel
 * makes room for each in order; threads fill it at the end, when all sources are complete. */
#ifndef VS_KERNEL_ASSEMBLE_H
#define VS_KERNEL_ASSEMBLE_H

#include "kernel/problem.h"
#include "kernel/memory.h"

typedef struct { size_t vertex, triangle, vertices, triangles; } vs_range; /* the first vertex and triangle, and the
                                                                            * counts */

typedef struct {
  const vs_mesh *mesh;       /* source, copied whole; NULL: a range of the result */
  vs_range from;
  uint32_t into;             /* index of the result */
  size_t vertex, triangle;   /* target of the copy */
  vs_affine map;
  const uint32_t *were, *leaves; /* triangles with the tag of leaf were[i] get the tag of leaves[i]; were NULL: all get
                                  * the tag of leaves[0] */
  uint32_t leaf_count;
} vs_placement;

typedef struct {
  VS_LIST(vs_placement) meshes, again;
} vs_placing;

/* Makes room in a result, with tags, and adds it to the counts. */
bool vs_placing_room(vs_kernel *k, vs_mesh *out, size_t vertices, size_t triangles);
/* Copies all placements of the list. */
bool vs_placing_finish(vs_kernel *k, vs_placing *p, const vs_kernel_leaf *leaves, vs_mesh *results);
void vs_placing_free(vs_kernel *k, vs_placing *p);

#endif
