/* Declares meshes whose faces are moved: each face to its own distance, or to another plane. */
#ifndef VS_GEOMETRY_MEASURE_MOVED_FACES_H
#define VS_GEOMETRY_MEASURE_MOVED_FACES_H

#include "geometry/measure/face_edges.h"

/* The new position of a face. */
typedef struct {
  bool tilted;          /* true: the face moves to the plane through `at` with this normal; it must be a plane face */
  vs_vec3 at, normal;
  double distance;      /* distance by which a face that is not tilted moves outwards; negative: inwards */
} vs_face_move;

typedef enum {
  VS_MOVED,
  VS_MOVED_MEMORY, /* memory is out */
  VS_MOVED_CORNER, /* the moved faces do not meet in one point at the corner *at */
  VS_MOVED_TURNED  /* the face at *at is turned over: the distance is too large */
} vs_moved_outcome;

/* Sets the vertices of `out`, a copy of the mesh of s, to the points where the moved faces meet. moves[i] is the move
 * of face i. Faces may then intersect elsewhere: solids/overlaps.h. Sets *at if the outcome is a failure. */
vs_moved_outcome vs_faces_move(const vs_mesh_edges *s, const vs_mesh_faces *faces, const vs_face_move *moves,
                               vs_mesh *out, vs_vec3 *at);

#endif
