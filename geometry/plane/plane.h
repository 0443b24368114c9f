/* Declares the plane of a curve or region, found from its node; only joins and hulls are sampled. */
#ifndef VS_GEOMETRY_PLANE_PLANE_H
#define VS_GEOMETRY_PLANE_PLANE_H

#include "model/node.h"

typedef enum {
  VS_PLANE_NONE,     /* it lies in no plane, or is no curve or region */
  VS_PLANE_MANY,     /* a straight line or a point */
  VS_PLANE_ONE
} vs_plane_count;
typedef struct {
  vs_vec3 point, normal; /* unit; up, or towards +Y, or along +X */
  double size;           /* of the curve or region */
} vs_shape_plane;

/* Finds the plane of a node. For a set it is that of the first part that is not empty: the code that makes the set
 * checks the others. */
vs_plane_count vs_node_plane(const vs_node *n, vs_shape_plane *out);
bool vs_plane_same(const vs_shape_plane *a, const vs_shape_plane *b); /* within 1e-6 of their sizes */

#endif
