/* Declares the meshes of a drawing that a host receives (vs_mesh_next), implemented in host_meshes.c. */
#ifndef VS_SESSION_HOST_MESHES_H
#define VS_SESSION_HOST_MESHES_H

#include "session/session.h"

void vs_session_free_meshes(vs_session *s);

#endif
