/* Declares meshes whose faces are moved: each face to its own distance, or to another plane. */
#ifndef VS_GEOMETRY_MEASURE_MOVED_FACES_H
#define VS_GEOMETRY_MEASURE_MOVED_FACES_H

#include "geometry/measure/face_edges.h"

/* How one face moves. */
typedef struct {
  bool tilted;          /* true: the face, which must be plane, moves to the plane through `at` with the normal
                         * `normal` */
  vs_vec3 at, normal;
  double distance;      /* distance by which a face that is not tilted moves outwards; negative: inwards */
} vs_face_move;

typedef enum {
  VS_MOVED,
  VS_MOVED_MEMORY, /* memory is out */
  VS_MOVED_CORNER, /* no point lies on all moved faces around the corner at *at */
  VS_MOVED_TURNED  /* the face at *at has turned over, because it was moved too far */
} vs_moved_outcome;

/* Moves the faces of a mesh: sets the vertices of `out`, a copy of it, to the intersections of the moved faces.
 * moves[i]: move of face i. On a failure, sets *at to its place. */
vs_moved_outcome vs_faces_move(const vs_mesh_edges *s, const vs_mesh_faces *faces, const vs_face_move *moves,
                               vs_mesh *out, vs_vec3 *at);

#endif
