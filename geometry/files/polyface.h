/* Declares checks of points and faces before they become a node: whether they close, and their orientation. */
#ifndef VS_GEOMETRY_FILES_POLYFACE_H
#define VS_GEOMETRY_FILES_POLYFACE_H

#include "geometry/files/meshfile.h"
#include "model/mesh.h"
#include "model/node.h"

/* Faces over points; the caller owns both. Face f has the corners corners[starts[f]] .. corners[starts[f + 1] - 1],
 * which are indices of points from 0; starts has face_count + 1 entries. */
typedef struct {
  const vs_vec3 *points;
  size_t point_count;
  const uint32_t *starts, *corners;
  size_t face_count;
} vs_polygons;
/* Returns the faces of a list; valid until the list changes. */
static inline vs_polygons vs_polygons_of(const vs_face_list *l) {
  static const uint32_t none[1] = { 0 };
  return (vs_polygons){ l->points, l->point_count, l->face_count ? l->starts : none, l->corners, l->face_count };
}

/* Sets place[i] to the first point with i's coordinates. Returns false when memory is out. */
bool vs_polyface_merge(const vs_vec3 *points, size_t count, uint32_t *place);

/* Sets turned[f] (zeroed by the caller) for faces that must be turned to agree with the first face of their shell.
 * *closed: each edge is then used as often in one direction as in the other. Equal points have one index; coordinates
 * are not used. s: the store that may interrupt the work, or NULL. Returns false when memory is out or the run is
 * interrupted. */
bool vs_polyface_orient(vs_store *s, const vs_polygons *faces, unsigned char *turned, bool *closed, vs_error *e);

/* Makes the node. It drops faces of fewer than three different corners, turns faces that disagree with their
 * neighbours, and turns all faces if they close inside out; equal points become one. Without faces it returns the empty
 * node. NULL: e has the reason. */
vs_node *vs_polyface_make(vs_store *s, const vs_polygons *faces, vs_error *e);

/* Does the same. If the triangles were needed on the way, mesh (empty before) receives them, tagged by face; else it
 * stays empty. */
vs_node *vs_polyface_make_mesh(vs_store *s, const vs_polygons *faces, vs_mesh *mesh, vs_error *e);

#endif
