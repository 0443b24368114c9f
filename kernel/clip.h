/* Owns the cutting down of leaves that are far larger than the place where they matter. */
#ifndef VS_KERNEL_CLIP_H
#define VS_KERNEL_CLIP_H

#include "kernel/problem.h"
#include "kernel/memory.h"

typedef struct {
  VS_LIST(vs_vec3) vertices;
  VS_LIST(uint32_t) corners; /* three a triangle */
  vs_mesh mesh;              /* of these */
} vs_clip;

typedef struct {
  vs_kernel_problem problem; /* what is to be evaluated: the given one, with other leaves where any were cut */
  VS_LIST(vs_kernel_leaf) leaves;
  VS_LIST(uint64_t) identities;
  VS_LIST(vs_clip) clips;
} vs_clipped;

/* Fills out->problem; what it points to lives as long as both p and out. bounds: of the leaves; those of what is cut
 * become smaller. False on error. */
bool vs_clip_leaves(vs_kernel *k, const vs_kernel_problem *p, vs_bounds *bounds, vs_clipped *out);
void vs_clipped_free(vs_kernel *k, vs_clipped *c);

#endif
