/* Owns the question of what a ray meets first: solids and surfaces by their triangles, as fine as measures take them.
 * */
#ifndef VS_BIND_SCENE_RAY_HITS_H
#define VS_BIND_SCENE_RAY_HITS_H

#include "model/node.h"
#include "vm/machine/native.h"

/* Where a ray meets an object: after `at` lengths of its direction, on a part that was made at origin (NULL: that is
 * not known). at INFINITY: nowhere. */
typedef struct { double at; const vs_origin *origin; } vs_ray_hit;

/* The nearest place at or in front of `from` where the ray meets the object, whose bounds are looked at first. Curves
 * and regions are passed by. False: *e says why; where it says nothing, the condition is set. */
bool vs_ray_meets(vs_scheme *vm, vs_ref object, vs_vec3 from, vs_vec3 direction, vs_ray_hit *hit, vs_error *e);

#endif
