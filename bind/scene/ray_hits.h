/* Declares the nearest intersection of a ray with solids and surfaces. ray_hits.c computes it with the triangles by
 * which objects are measured. */
#ifndef VS_BIND_SCENE_RAY_HITS_H
#define VS_BIND_SCENE_RAY_HITS_H

#include "model/node.h"
#include "vm/machine/native.h"

/* An intersection of a ray. at: distance from the ray's start, as a multiple of the length of its direction; INFINITY
 * if there is none. The member origin: place of the program that made the part, or NULL if it is unknown. */
typedef struct { double at; const vs_origin *origin; } vs_ray_hit;

/* Sets *hit to the nearest intersection of a ray with the object, at or after the ray's start `from`. Curves and
 * regions are ignored. If it fails, returns false and sets *e, or leaves *e empty if the VM's error is already set. */
bool vs_ray_meets(vs_scheme *vm, vs_ref object, vs_vec3 from, vs_vec3 direction, vs_ray_hit *hit, vs_error *e);

#endif
