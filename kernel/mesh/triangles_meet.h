/* Declares an exact intersection test of two triangles of a mesh, in double coordinates. */
#ifndef VS_KERNEL_MESH_TRIANGLES_MEET_H
#define VS_KERNEL_MESH_TRIANGLES_MEET_H

#include "model/vec.h"

typedef enum {
  VS_MEET_NOT,   /* the triangles have at most corners or an edge with equal positions in common */
  VS_MEET_TOUCH, /* the triangles touch: one triangle has a corner or edge on the border of the other, or a corner in
                  * its face, and no more in common */
  VS_MEET_CROSS  /* the triangles cross, or overlap along an edge or in an area */
} vs_triangle_meeting;

/* Returns true if the triangle with these three corners has no area. */
bool vs_triangle_is_flat(const vs_vec3 *corners);

/* Tests two triangles that both have an area. */
vs_triangle_meeting vs_triangles_meet(const vs_vec3 a[3], const vs_vec3 b[3]);

/* Returns true if an edge of a and an edge of b lie in a common plane perpendicular to an axis, and cross each
 * other. */
bool vs_triangles_cross_level(const vs_vec3 a[3], const vs_vec3 b[3]);

#endif
