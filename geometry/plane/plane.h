/* Declares the search for the plane of a curve or region. It uses the data of the node itself; only joins and hulls are
 * sampled. */
#ifndef VS_GEOMETRY_PLANE_PLANE_H
#define VS_GEOMETRY_PLANE_PLANE_H

#include "model/node.h"

typedef enum {
  VS_PLANE_NONE,     /* the node lies in no plane, or is neither a curve nor a region */
  VS_PLANE_MANY,     /* the node is a straight line or a point, which lies in many planes */
  VS_PLANE_ONE
} vs_plane_count;
typedef struct {
  vs_vec3 point, normal; /* point: a point of the plane; normal: unit vector that points up; for a vertical plane, it
                          * points towards +Y, or along +X if it has no component along Y */
  double size;           /* size of the curve or region in model units, for the tolerance of comparisons */
} vs_shape_plane;

/* Finds the plane of node n. A set has the plane of its first part that is not empty, because its constructor has
 * checked that all parts lie in one plane. */
vs_plane_count vs_node_plane(const vs_node *n, vs_shape_plane *out);
bool vs_plane_same(const vs_shape_plane *a, const vs_shape_plane *b); /* returns true if the planes a and b agree within
                                                                       * 1e-6 of the shapes' sizes */

#endif
