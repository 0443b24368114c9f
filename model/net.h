/* Owns the netting of a mesh's triangles. */
#ifndef VS_MODEL_NET_H
#define VS_MODEL_NET_H

#include "model/mesh.h"

/* Nets the triangles from index `first`. Of those with the same three corners remain as many as the difference between
 * the two orientations; those with two equal corners are removed. A closed chain stays closed, and its winding number
 * about each point is unchanged. The triangles get the order of their corners; tags are lost. Returns false when memory
 * is out, and m is then unusable. */
bool vs_mesh_net(vs_mesh *m, size_t first);

#endif
