/* Declares the signed distance from a closed mesh. */
#ifndef VS_GEOMETRY_MEASURE_MESH_DISTANCE_H
#define VS_GEOMETRY_MEASURE_MESH_DISTANCE_H

#include "model/mesh.h"

/* A closed mesh prepared for tests: a bounding volume hierarchy, and normals of faces, edges and points, which
 * distinguish inside from outside (J. Baerentzen, H. Aanaes, 2005). */
typedef struct vs_mesh_distance vs_mesh_distance;

/* Copies the data that it needs; points that edges share must have one index. Returns NULL when memory is out. */
vs_mesh_distance *vs_mesh_distance_new(const vs_mesh *m);
void vs_mesh_distance_free(vs_mesh_distance *d); /* NULL is allowed */
/* Returns the distance of p, negative inside; 0 if the mesh has no triangle. *slope (may be NULL): its gradient. */
double vs_mesh_distance_at(const vs_mesh_distance *d, vs_vec3 p, vs_vec3 *slope);

#endif
