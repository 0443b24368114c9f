/* Owns what is to be known of points and faces before they become a node: do they close, and which way do they face? */
#ifndef VS_GEOMETRY_FILES_POLYFACE_H
#define VS_GEOMETRY_FILES_POLYFACE_H

#include "geometry/files/meshfile.h"
#include "model/mesh.h"
#include "model/node.h"

/* Faces over points, all of it the caller's: face f has the corners corners[starts[f]] .. corners[starts[f + 1] - 1],
 * numbers of points from 0, and starts has face_count + 1. */
typedef struct {
  const vs_vec3 *points;
  size_t point_count;
  const uint32_t *starts, *corners;
  size_t face_count;
} vs_polygons;
/* The faces of a list, as long as it is not changed. */
static inline vs_polygons vs_polygons_of(const vs_face_list *l) {
  static const uint32_t none[1] = { 0 };
  return (vs_polygons){ l->points, l->point_count, l->face_count ? l->starts : none, l->corners, l->face_count };
}

/* place[i] = the first point with i's coordinates. False: out of memory. */
bool vs_polyface_merge(const vs_vec3 *points, size_t count, uint32_t *place);

/* turned[f] (zeroed before): faces that have to be turned to agree with the first of their shell. *closed: each edge is
 * then met as often one way as the other. faces: equal points have one number, and their places are not asked.
 * s: whose owner may stop it, or NULL. False: out of memory or interrupted. */
bool vs_polyface_orient(vs_store *s, const vs_polygons *faces, unsigned char *turned, bool *closed, vs_error *e);

/* Makes the node. A face of fewer than three different corners is dropped. Faces that disagree with their neighbours
 * are turned, and the whole of them if it closes inside out; equal points count as one. Nothing left: the empty node.
 * NULL: e says why. */
vs_node *vs_polyface_make(vs_store *s, const vs_polygons *faces, vs_error *e);

/* The same; mesh, empty before, becomes its triangles, tagged by face, where they were needed on the way: else it stays
 * empty. */
vs_node *vs_polyface_make_mesh(vs_store *s, const vs_polygons *faces, vs_mesh *mesh, vs_error *e);

#endif
