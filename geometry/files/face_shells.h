/* Declares the division of faces into shells. */
#ifndef VS_GEOMETRY_FILES_FACE_SHELLS_H
#define VS_GEOMETRY_FILES_FACE_SHELLS_H

#include "geometry/files/meshfile.h"

/* Sets shell[f] to the index of the first face of the shell of face f: faces that share an edge are one shell. Sets
 * open[f] to 1 if f is the first face of a shell with an edge that an odd number of faces uses, else to 0. Equal points
 * must have one index (vs_face_list_compact). Both arrays have face_count elements. s: the store whose caller may
 * interrupt the work. Returns false when memory is out or the run is interrupted. */
bool vs_face_list_shells(vs_store *s, const vs_face_list *l, uint32_t *shell, unsigned char *open, vs_error *e);

#endif
