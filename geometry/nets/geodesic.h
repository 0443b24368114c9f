/* Declares the computation of shortest paths over the triangles of a mesh, and along the members of a net. */
#ifndef VS_GEOMETRY_NETS_GEODESIC_H
#define VS_GEOMETRY_NETS_GEODESIC_H

#include "model/mesh.h"

/* A member of a net: the indices of its two end points, and its length. */
typedef struct {
  uint32_t a, b;
  double length;
} vs_way;

/* A net: its members and the number of its points. */
typedef struct {
  const vs_way *ways;
  size_t way_count, point_count;
} vs_way_net;

/* Finds the shortest path from point `from` to point `to`; both are indices of the net's points. *out becomes the array
 * of the points' indices, which the caller frees. *count 0: there is no path. Returns false when memory is out. */
bool vs_ways_shortest(const vs_way_net *net, uint32_t from, uint32_t to, uint32_t **out, size_t *count);

/* Finds a shortest path over the mesh, between the points of the mesh that are nearest to p and q. The path is a
 * polyline that bends where it crosses edges. No path close to it is shorter. Vertices with equal positions are one
 * corner. The caller frees *out. *count 0: the mesh does not connect the points. Returns false when memory is out. */
bool vs_mesh_geodesic(const vs_mesh *m, vs_vec3 p, vs_vec3 q, vs_vec3 **out, size_t *count);

#endif
