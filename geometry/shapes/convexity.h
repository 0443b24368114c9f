/* Declares tests whether meshes are convex, and the division of a mesh's boundary into convex polygons. */
#ifndef VS_GEOMETRY_SHAPES_CONVEXITY_H
#define VS_GEOMETRY_SHAPES_CONVEXITY_H

#include "geometry/nets/mesh_edges.h"

/* Returns true if the closed mesh bounds a convex solid. Deviations of at most a billionth of its size count as 0. */
bool vs_mesh_is_convex(const vs_mesh_edges *s);

/* For a corner of a convex mesh: a cone that contains every direction in which this corner is the mesh's farthest
 * point. axis: unit vector. */
typedef struct {
  vs_vec3 axis;
  double angle; /* greatest angle of such a direction from `axis`, in radians, at most pi */
} vs_normal_cap;
/* Sets caps[v], the cone of directions in which vertex v is the mesh's farthest point, for each vertex v of a triangle;
 * of several vertices at one position, only for the first. Returns false when memory is out. */
bool vs_mesh_normal_caps(const vs_mesh_edges *s, vs_normal_cap *caps);

/* Convex polygons, one after another, counter-clockwise as seen from outside. */
typedef struct {
  vs_vec3 *at;
  size_t count, room;
  uint32_t *starts; /* polygon i has the points at[starts[i]] to at[starts[i + 1] - 1] */
  size_t polygons, start_room;
} vs_convex_faces;
void vs_convex_faces_free(vs_convex_faces *c);
/* Joins the mesh's coplanar triangles to convex polygons: removes edges as long as the polygons stay convex. out must
 * be empty at the call; the caller frees it in either case. Returns false when memory is out. */
bool vs_mesh_convex_faces(const vs_mesh_edges *s, vs_convex_faces *out);

#endif
