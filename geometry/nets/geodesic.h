/* Declares shortest paths: over the triangles of a mesh, and along members of a net. */
#ifndef VS_GEOMETRY_NETS_GEODESIC_H
#define VS_GEOMETRY_NETS_GEODESIC_H

#include "model/mesh.h"

/* A member of a net as a link of this length; its ends are indices below the count of points. */
typedef struct {
  uint32_t a, b;
  double length;
} vs_way;

/* The members of a net between points that are numbered from 0. */
typedef struct {
  const vs_way *ways;
  size_t way_count, point_count;
} vs_way_net;

/* Finds the shortest path between two points: the indices of its points from `from` on, which the caller frees; *count
 * 0: no path leads there. Both are indices below `points`. Returns false when memory is out. */
bool vs_ways_shortest(const vs_way_net *net, uint32_t from, uint32_t to, uint32_t **out, size_t *count);

/* Finds the geodesic between the points of the mesh that are nearest to p and q: a polyline that bends where it crosses
 * edges, locally the shortest. Corners at the same position are one. The caller frees *out; *count 0: the points lie on
 * parts that are not connected. Returns false when memory is out. */
bool vs_mesh_geodesic(const vs_mesh *m, vs_vec3 p, vs_vec3 q, vs_vec3 **out, size_t *count);

#endif
