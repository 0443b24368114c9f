/* Declares the repair of faces that do not bound a solid, and the search for the edges where they do not. */
#ifndef VS_GEOMETRY_FILES_REPAIR_H
#define VS_GEOMETRY_FILES_REPAIR_H

#include "geometry/files/meshfile.h"

/* Makes equal points one point, and removes points that no face uses. Returns false when memory is out. */
bool vs_face_list_compact(vs_face_list *l);

typedef struct {
  size_t count;      /* number of edges that occur more often in one direction than in the other, counted after equal
                      * points became one point */
  size_t face;       /* index, from 0, of a face at the first edge that occurs more often in one direction than in the
                      * other */
  vs_vec3 from, to;
} vs_open_edges;
/* Finds the edges that occur in faces more often in one direction than in the other. s: the store whose caller may
 * interrupt the work, or NULL. Returns false when memory is out or the run is interrupted. */
bool vs_face_list_open(vs_store *s, const vs_face_list *l, vs_open_edges *out, vs_error *e);

typedef struct {
  size_t welded;     /* number of points that were merged with a nearby point */
  size_t dropped;    /* number of removed faces: faces without area, repetitions of a face, and pairs of coincident
                      * faces with opposite orientation */
  size_t turned;     /* number of faces whose orientation was reversed */
  size_t holes;      /* number of holes that were closed with triangles */
  size_t largest;    /* number of edges around the largest hole */
} vs_repair_notes;
/* Repairs the faces in place, so that they are closed. Unites nearby points, removes degenerate faces, turns shells
 * (connected faces) outwards, and closes holes. The result may intersect itself. Returns false when memory is out or
 * the run is interrupted. */
bool vs_face_list_repair(vs_store *s, vs_face_list *l, vs_repair_notes *notes, vs_error *e);

#endif
