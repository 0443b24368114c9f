/* Declares checks of faces over points before they become a node: whether they close, and their orientation. */
#ifndef VS_GEOMETRY_FILES_POLYFACE_H
#define VS_GEOMETRY_FILES_POLYFACE_H

#include "geometry/files/meshfile.h"
#include "model/mesh.h"
#include "model/node.h"

/* Faces over points; the caller owns the arrays. Face f has the corners corners[starts[f]] to corners[starts[f + 1] -
 * 1], which are indices of points, counted from 0. starts has face_count + 1 elements. */
typedef struct {
  const vs_vec3 *points;
  size_t point_count;
  const uint32_t *starts, *corners;
  size_t face_count;
} vs_polygons;
/* Returns the faces of a list. The result is valid until the list changes. */
static inline vs_polygons vs_polygons_of(const vs_face_list *l) {
  static const uint32_t none[1] = { 0 };
  return (vs_polygons){ l->points, l->point_count, l->face_count ? l->starts : none, l->corners, l->face_count };
}

/* Sets place[i] to the index of the first point with the coordinates of point i. Returns false when memory is out. */
bool vs_polyface_merge(const vs_vec3 *points, size_t count, uint32_t *place);

/* Sets turned[f] to 1 for faces that must be reversed to agree with the first face of their shell (connected faces).
 * *closed: true if each edge then occurs equally often in both directions. Returns false when memory is out or the run
 * is interrupted. */
bool vs_polyface_orient(vs_store *s, const vs_polygons *faces, unsigned char *turned, bool *closed, vs_error *e);

/* Makes a node (solid) of the faces. Merges equal points, drops degenerate faces, and reverses faces so that all face
 * outwards. If there are no faces, returns the empty node. Returns NULL and sets e on failure. */
vs_node *vs_polyface_make(vs_store *s, const vs_polygons *faces, vs_error *e);

/* Makes a node (solid) of the faces as vs_polyface_make does. If that computes the solid's triangles, stores them in
 * mesh, which is empty at the call; the tag of a triangle is the index of its face. */
vs_node *vs_polyface_make_mesh(vs_store *s, const vs_polygons *faces, vs_mesh *mesh, vs_error *e);

#endif
