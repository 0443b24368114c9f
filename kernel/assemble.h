/* Copies meshes into the kernel's results: input meshes that stay unchanged, and finished parts of a result that occur
 * again elsewhere. The kernel reserves space for the copies in a fixed order. Threads write them at the end, when all
 * sources are complete. */
#ifndef VS_KERNEL_ASSEMBLE_H
#define VS_KERNEL_ASSEMBLE_H

#include "kernel/problem.h"
#include "kernel/memory.h"

typedef struct { size_t vertex, triangle, vertices, triangles; } vs_range; /* a range of a mesh. vertex, triangle:
                                                                            * indices of its first vertex and triangle;
                                                                            * vertices, triangles: how many it has */

typedef struct {
  const vs_mesh *mesh;       /* mesh to copy completely; if NULL, the range `from` of an earlier result is copied
                              * instead */
  vs_range from;
  uint32_t into;             /* index of the result that receives the copy */
  size_t vertex, triangle;   /* positions in the result of the copy's first vertex and first triangle */
  vs_affine map;
  const uint32_t *were, *leaves; /* Tags of the copy. A triangle whose tag in the original is the tag of leaf were[i]
                                  * gets the tag of leaf leaves[i]. If `were` is NULL, all triangles get the tag of leaf
                                  * leaves[0]. */
  uint32_t leaf_count;
} vs_placement;

typedef struct {
  VS_LIST(vs_placement) meshes, again;
} vs_placing;

/* Reserves space for `vertices` vertices and `triangles` triangles, with their tags, in the mesh out. Adds these
 * numbers to the counts of out. Returns false and sets the error if the result becomes too large or memory is out. */
bool vs_placing_room(vs_kernel *k, vs_mesh *out, size_t vertices, size_t triangles);
/* Copies the meshes of all placements in p into the array `results`. Returns false and sets the error on failure. */
bool vs_placing_finish(vs_kernel *k, vs_placing *p, const vs_kernel_leaf *leaves, vs_mesh *results);
void vs_placing_free(vs_kernel *k, vs_placing *p);

#endif
