/* Cuts leaves that are far larger than the region where they can influence the result. */
#ifndef VS_KERNEL_CLIP_H
#define VS_KERNEL_CLIP_H

#include "kernel/problem.h"
#include "kernel/memory.h"

typedef struct {
  VS_LIST(vs_vec3) vertices;
  VS_LIST(uint32_t) corners; /* triangles of the cut mesh: three vertex numbers for each */
  vs_mesh mesh;              /* the cut mesh; its arrays are the lists `vertices` and `corners` above */
} vs_clip;

typedef struct {
  vs_kernel_problem problem; /* problem to evaluate: the caller's problem with the cut leaves instead of the original
                              * ones */
  VS_LIST(vs_kernel_leaf) leaves;
  VS_LIST(uint64_t) identities;
  VS_LIST(vs_clip) clips;
} vs_clipped;

/* Cuts the leaves of p that are too large, and sets out->problem, which points to data of p and out. bounds[i]: the
 * bounds of leaf i, reduced by the function if it cuts the leaf. Returns false and sets the error on failure. */
bool vs_clip_leaves(vs_kernel *k, const vs_kernel_problem *p, vs_bounds *bounds, vs_clipped *out);
void vs_clipped_free(vs_kernel *k, vs_clipped *c);

#endif
