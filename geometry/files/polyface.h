/* Owns what is to be known of points and faces before they become a node: do they close, and which way do they face? */
#ifndef VS_GEOMETRY_FILES_POLYFACE_H
#define VS_GEOMETRY_FILES_POLYFACE_H

#include "model/mesh.h"
#include "model/node.h"

/* place[i] = the first point with i's coordinates. False: out of memory. */
bool vs_polyface_merge(const vs_vec3 *points, size_t count, uint32_t *place);

/* turned[f] (zeroed before): faces that have to be turned to agree with the first of their shell. *closed: each edge is
 * then met as often one way as the other. corners: equal points by one number, below points. s: whose owner may stop
 * it, or NULL. False: out of memory or interrupted. */
bool vs_polyface_orient(vs_store *s, size_t points, const uint32_t *starts, size_t face_count, const uint32_t *corners,
                        unsigned char *turned, bool *closed, vs_error *e);

/* Makes the node: face f has the corners corners[starts[f]] .. corners[starts[f + 1] - 1], zero-based and within count;
 * fewer than three different ones and the face is dropped. Faces that disagree with their neighbours are turned, and
 * the whole of them if it closes inside out; equal points count as one. Nothing left: the empty node. NULL: e says
 * why. */
vs_node *vs_polyface_make(vs_store *s, const vs_vec3 *points, size_t count, const uint32_t *starts, size_t face_count,
                          const uint32_t *corners, vs_error *e);

/* The same; mesh, empty before, becomes its triangles, tagged by face, where they were needed on the way: else it stays
 * empty. */
vs_node *vs_polyface_make_mesh(vs_store *s, const vs_vec3 *points, size_t count, const uint32_t *starts,
                               size_t face_count, const uint32_t *corners, vs_mesh *mesh, vs_error *e);

#endif
