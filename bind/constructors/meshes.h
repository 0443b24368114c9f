/* Declares a function of meshes.c that the reading of models uses. */
#ifndef VS_BIND_CONSTRUCTORS_MESHES_H
#define VS_BIND_CONSTRUCTORS_MESHES_H

#include "geometry/files/meshfile.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Sets *out to a new node of the faces: a solid if they close, else a surface, or the empty node. Faces that close and
 * overlap become one solid without overlaps; *flawless is then false, and l changes. file: the name in errors, or "".
 * On failure *out is NULL. The caller owns *out. */
vs_status vs_bind_whole_faces(vs_args *f, const char *file, vs_face_list *l, bool *flawless, vs_node **out);

#endif
