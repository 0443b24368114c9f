/* Declares the cancelling of coincident triangles of a mesh. */
#ifndef VS_MODEL_NET_H
#define VS_MODEL_NET_H

#include "model/mesh.h"

/* Cancels pairs of triangles that have the same three corners and opposite orientations; removes triangles with two
 * equal corners. Considers only triangles with an index of at least `first`. A closed mesh stays closed, and its
 * winding number around each point does not change. The remaining triangles are sorted by their corners; tags are lost.
 * Returns false when memory is out; m is then unusable. */
bool vs_mesh_net(vs_mesh *m, size_t first);

#endif
