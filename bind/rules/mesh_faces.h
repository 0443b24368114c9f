/* Declares the components (faces, edges, vertices) of a scope that is a mesh, computed by mesh_faces.c. */
#ifndef VS_BIND_RULES_MESH_FACES_H
#define VS_BIND_RULES_MESH_FACES_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Implements scope-component for scopes that are meshes. of: the components, such as faces or edges. */
vs_status vs_mesh_components(vs_args *f, const char *of, vs_value *out);

#endif
