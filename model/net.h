/* Declares the cancelling of coincident triangles of a mesh. */
#ifndef VS_MODEL_NET_H
#define VS_MODEL_NET_H

#include "model/mesh.h"

/* Cancels pairs of triangles with the same three corners and opposite orientations, among the triangles with the index
 * `first` or a greater one. Also removes triangles with two equal corners. A closed mesh stays closed, and its winding
 * number about each point is unchanged. The remaining triangles are sorted by their corners; tags are lost. Returns
 * false when memory is out; m is then unusable. */
bool vs_mesh_net(vs_mesh *m, size_t first);

#endif
