/* Declares ambient occlusion: the fraction of the hemisphere around a point from which light reaches it, computed with
 * rays. */
#ifndef VS_GEOMETRY_MEASURE_OPENNESS_H
#define VS_GEOMETRY_MEASURE_OPENNESS_H

#include "geometry/measure/ray_tree.h"

/* The obstacles for rays: the triangles of the tree, and an infinite horizontal ground at the height `ground`;
 * -INFINITY: no ground. far: distance beyond which obstacles are ignored. */
typedef struct { const vs_ray_tree *tree; double ground, far; } vs_surrounding;

/* Returns the unobstructed fraction of the hemisphere over a surface: 1 on an open field, 0 in a crack. `from`: a point
 * slightly above the surface. `seed`: shifts the pattern of rays, so that neighbouring points have different errors. */
double vs_openness(const vs_surrounding *s, vs_vec3 from, vs_vec3 normal, uint32_t seed);

#endif
