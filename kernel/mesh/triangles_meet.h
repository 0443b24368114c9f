/* Declares the exact intersection test of two triangles of a mesh, in double coordinates. */
#ifndef VS_KERNEL_MESH_TRIANGLES_MEET_H
#define VS_KERNEL_MESH_TRIANGLES_MEET_H

#include "model/vec.h"

typedef enum {
  VS_MEET_NOT,   /* nothing in common but corners or an edge with equal positions */
  VS_MEET_TOUCH, /* one reaches the other's border, or its face with a corner, and no further */
  VS_MEET_CROSS  /* they cross, or overlap with an edge or a face */
} vs_triangle_meeting;

/* Returns true if the triangle of these corners has no area. */
bool vs_triangle_is_flat(const vs_vec3 *corners);

/* For triangles of which none is flat. */
vs_triangle_meeting vs_triangles_meet(const vs_vec3 a[3], const vs_vec3 b[3]);

/* Returns true if an edge of one and an edge of the other, both in one plane across an axis, cross each other there. */
bool vs_triangles_cross_level(const vs_vec3 a[3], const vs_vec3 b[3]);

#endif
