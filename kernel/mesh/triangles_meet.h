/* Owns the exact answer what two triangles of a mesh have in common, as the doubles stand. */
#ifndef VS_KERNEL_MESH_TRIANGLES_MEET_H
#define VS_KERNEL_MESH_TRIANGLES_MEET_H

#include "model/vec.h"

typedef enum {
  VS_MEET_NOT,   /* nothing but the corners or the edge that they share by place */
  VS_MEET_TOUCH, /* one comes to the other's border, or with a corner to its face, and no further */
  VS_MEET_CROSS  /* they cross, or lie on each other with an edge or a face */
} vs_triangle_meeting;

/* Have its corners no area between them? */
bool vs_triangle_is_flat(const vs_vec3 *corners);

/* Of triangles of which none is flat. */
vs_triangle_meeting vs_triangles_meet(const vs_vec3 a[3], const vs_vec3 b[3]);

/* Do an edge of one and an edge of the other, both in one plane across an axis, cross each other there? */
bool vs_triangles_cross_level(const vs_vec3 a[3], const vs_vec3 b[3]);

#endif
