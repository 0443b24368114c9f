/* Owns ambient occlusion: how open a place is, by rays that go out from it. */
#ifndef VS_GEOMETRY_MEASURE_OPENNESS_H
#define VS_GEOMETRY_MEASURE_OPENNESS_H

#include "geometry/measure/ray_tree.h"

/* All that rays may meet: the tree's triangles, and a level ground without end at `ground`; -INFINITY: there is none.
 * Nothing farther than `far` counts. */
typedef struct { const vs_ray_tree *tree; double ground, far; } vs_surrounding;

/* The part of the half sphere over a surface in which nothing stands, weighed by the cosine to its unit normal: 1 on an
 * open field, 0 in a crack. `from` lies a hair above the surface. The rays stand in a pattern that `seed` shifts, so
 * that neighbours' errors differ: the same number for the same seed. */
double vs_openness(const vs_surrounding *s, vs_vec3 from, vs_vec3 normal, uint32_t seed);

#endif
