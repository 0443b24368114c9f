/* Owns the answer to "in which plane does this curve or region lie?", from what it was made of, without sampling it. */
#ifndef VS_GEOMETRY_PLANE_PLANE_H
#define VS_GEOMETRY_PLANE_PLANE_H

#include "model/node.h"

typedef enum {
  VS_PLANE_NONE,     /* it leaves every plane, or is no curve or region */
  VS_PLANE_MANY,     /* a straight line or a point */
  VS_PLANE_ONE
} vs_plane_count;
typedef struct {
  vs_vec3 point, normal; /* unit; up, or along +Y, or along +X */
  double size;           /* of what lies in it */
} vs_shape_plane;

/* Sets answer for their first part that is not nothing: their makers see to the others. */
vs_plane_count vs_node_plane(const vs_node *n, vs_shape_plane *out);
bool vs_plane_same(const vs_shape_plane *a, const vs_shape_plane *b); /* within 1e-6 of their sizes */

#endif
