/* Declares an exact intersection test of two triangles of a mesh, in double coordinates. */
#ifndef VS_KERNEL_MESH_TRIANGLES_MEET_H
#define VS_KERNEL_MESH_TRIANGLES_MEET_H

#include "model/vec.h"

typedef enum {
  VS_MEET_NOT,   /* the triangles have no point in common except corners or an edge with equal positions */
  VS_MEET_TOUCH, /* the triangles touch: a corner or edge of one triangle lies on the other, and they have no other
                  * points in common */
  VS_MEET_CROSS  /* the triangles cross, or overlap along an edge or in an area */
} vs_triangle_meeting;

/* Returns true if the triangle with the three corners `corners` has no area: all lie on one line. */
bool vs_triangle_is_flat(const vs_vec3 *corners);

/* Returns whether triangles a and b cross, touch, or do neither. Each triangle has an area. */
vs_triangle_meeting vs_triangles_meet(const vs_vec3 a[3], const vs_vec3 b[3]);

/* Returns true if an edge of triangle a and an edge of triangle b lie in a common plane perpendicular to an axis, and
 * cross each other. */
bool vs_triangles_cross_level(const vs_vec3 a[3], const vs_vec3 b[3]);

#endif
