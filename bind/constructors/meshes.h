/* Declares a function of meshes.c that the reading of model files uses. */
#ifndef VS_BIND_CONSTRUCTORS_MESHES_H
#define VS_BIND_CONSTRUCTORS_MESHES_H

#include "geometry/files/meshfile.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Sets *out to a new node of the faces in l: a solid if they enclose a volume, otherwise a surface or the empty node.
 * Closed faces that overlap become one solid without overlaps; *flawless is then false, and l changes. file: the file's
 * name for errors, or "". On failure *out is NULL. The caller owns *out. */
vs_status vs_bind_whole_faces(vs_args *f, const char *file, vs_face_list *l, bool *flawless, vs_node **out);

#endif
