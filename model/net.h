/* Owns the netting of a mesh's triangles. */
#ifndef VS_MODEL_NET_H
#define VS_MODEL_NET_H

#include "model/mesh.h"

/* Of the triangles from `first` on, those with the same three corners become as many of one side as there are more of
 * it; those with a corner twice go. A closed chain stays one, and winds around each place as often. They come to be in
 * the order of their corners; tags are not kept. False: out of memory, and m is not to be used. */
bool vs_mesh_net(vs_mesh *m, size_t first);

#endif
