/* Declares ambient occlusion: the openness of a point, by rays from it. */
#ifndef VS_GEOMETRY_MEASURE_OPENNESS_H
#define VS_GEOMETRY_MEASURE_OPENNESS_H

#include "geometry/measure/ray_tree.h"

/* The obstacles of rays: the tree's triangles, and an infinite level ground at `ground`; -INFINITY: no ground. Objects
 * farther than `far` do not count. */
typedef struct { const vs_ray_tree *tree; double ground, far; } vs_surrounding;

/* Returns the unobstructed part of the hemisphere over a surface, weighted by the cosine to its unit normal: 1 on an
 * open field, 0 in a crack. `from` lies slightly above the surface. `seed` shifts the pattern of the rays, so that
 * neighbours have different errors: the same seed gives the same number. */
double vs_openness(const vs_surrounding *s, vs_vec3 from, vs_vec3 normal, uint32_t seed);

#endif
