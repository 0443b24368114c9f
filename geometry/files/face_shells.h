/* Declares the division of faces into shells: sets of faces that are connected by common edges. */
#ifndef VS_GEOMETRY_FILES_FACE_SHELLS_H
#define VS_GEOMETRY_FILES_FACE_SHELLS_H

#include "geometry/files/meshfile.h"

/* Sets shell[f] to the first face of face f's shell, a set of faces that common edges connect. Sets open[f] to 1 if f
 * is the first face of a shell that has an edge of an odd number of faces, else to 0. */
bool vs_face_list_shells(vs_store *s, const vs_face_list *l, uint32_t *shell, unsigned char *open, vs_error *e);

#endif
