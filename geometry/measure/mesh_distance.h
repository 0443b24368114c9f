/* Declares the signed distance of points from a closed mesh. */
#ifndef VS_GEOMETRY_MEASURE_MESH_DISTANCE_H
#define VS_GEOMETRY_MEASURE_MESH_DISTANCE_H

#include "model/mesh.h"

/* A closed mesh, prepared for queries of distances with a bounding volume hierarchy. Normals of faces, edges and points
 * show which side is inside (J. Baerentzen, H. Aanaes, 2005). */
typedef struct vs_mesh_distance vs_mesh_distance;

/* Prepares mesh m for queries of distances, and copies its data. Corners of facets at the same place must have one
 * index. Returns NULL when memory is out. */
vs_mesh_distance *vs_mesh_distance_new(const vs_mesh *m);
void vs_mesh_distance_free(vs_mesh_distance *d); /* frees d, which may be NULL */
/* Returns the distance of p from the mesh, negative inside, or 0 if the mesh has no triangle. *slope: the gradient of
 * the distance; slope may be NULL. */
double vs_mesh_distance_at(const vs_mesh_distance *d, vs_vec3 p, vs_vec3 *slope);

#endif
