/* Owns the interface of ray_hits.c: the first hit of a ray on solids and surfaces, by triangles as fine as those of
 * measures. */
#ifndef VS_BIND_SCENE_RAY_HITS_H
#define VS_BIND_SCENE_RAY_HITS_H

#include "model/node.h"
#include "vm/machine/native.h"

/* A hit: after `at` lengths of the ray's direction, on a part made at origin (NULL: not known). at INFINITY: no hit. */
typedef struct { double at; const vs_origin *origin; } vs_ray_hit;

/* Computes the nearest hit at or after `from`; tests the object's bounds first. Ignores curves and regions. Returns
 * false with the reason in *e; an empty *e: the condition is set. */
bool vs_ray_meets(vs_scheme *vm, vs_ref object, vs_vec3 from, vs_vec3 direction, vs_ray_hit *hit, vs_error *e);

#endif
