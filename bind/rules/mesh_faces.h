/* Owns the interface of mesh_faces.c: the components of mesh scopes. */
#ifndef VS_BIND_RULES_MESH_FACES_H
#define VS_BIND_RULES_MESH_FACES_H

#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* scope-component of a mesh scope */
vs_status vs_mesh_components(vs_args *f, const char *of, vs_value *out);

#endif
