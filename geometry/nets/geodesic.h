/* Declares the computation of shortest paths over the triangles of a mesh, and along the members of a net of points. */
#ifndef VS_GEOMETRY_NETS_GEODESIC_H
#define VS_GEOMETRY_NETS_GEODESIC_H

#include "model/mesh.h"

/* A member of a net: the numbers of the two points that it connects, and its length. */
typedef struct {
  uint32_t a, b;
  double length;
} vs_way;

/* A net: its members and the number of its points. */
typedef struct {
  const vs_way *ways;
  size_t way_count, point_count;
} vs_way_net;

/* Finds the shortest path along the net's members from point `from` to point `to`. *out: numbers of the path's points,
 * an array that the caller frees; *count: its length, 0 if there is no path. Returns false when memory is out. */
bool vs_ways_shortest(const vs_way_net *net, uint32_t from, uint32_t to, uint32_t **out, size_t *count);

/* Finds a shortest path over mesh m between the points of the mesh nearest to p and q. *out: points of the path, a
 * polyline, which the caller frees; *count: their number, 0 if the mesh does not connect p and q. Returns false when
 * memory is out. */
bool vs_mesh_geodesic(const vs_mesh *m, vs_vec3 p, vs_vec3 q, vs_vec3 **out, size_t *count);

#endif
