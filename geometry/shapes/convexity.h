/* Declares questions about the convexity of meshes, and their boundary as convex polygons. */
#ifndef VS_GEOMETRY_SHAPES_CONVEXITY_H
#define VS_GEOMETRY_SHAPES_CONVEXITY_H

#include "geometry/nets/mesh_edges.h"

/* Returns true if the closed mesh bounds a convex solid. Deviations up to a billionth of its size are ignored. */
bool vs_mesh_is_convex(const vs_mesh_edges *s);

/* The directions in which a corner of a convex mesh is the farthest: all of them lie within an angle of the axis. */
typedef struct {
  vs_vec3 axis;
  double angle; /* in radians, at most pi */
} vs_normal_cap;
/* Sets caps[v] for each vertex v of a triangle that is the first at its position. caps has an element for each vertex.
 * Returns false when memory is out. */
bool vs_mesh_normal_caps(const vs_mesh_edges *s, vs_normal_cap *caps);

/* Convex polygons one after the other, counter-clockwise as seen from outside. */
typedef struct {
  vs_vec3 *at;
  size_t count, room;
  uint32_t *starts; /* polygon i: the points from starts[i] to starts[i + 1] - 1 */
  size_t polygons, start_room;
} vs_convex_faces;
void vs_convex_faces_free(vs_convex_faces *c);
/* Makes of the mesh's triangles plane convex polygons, as few as removing edges leaves. out must be empty; the caller
 * frees it in either case. Returns false when memory is out. */
bool vs_mesh_convex_faces(const vs_mesh_edges *s, vs_convex_faces *out);

#endif
