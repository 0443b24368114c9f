/* Declares the meshes that a host receives of a drawing, by the hash of each shape, with their placements. Implemented
 * in host_meshes.c. */
#ifndef VS_SESSION_HOST_MESHES_H
#define VS_SESSION_HOST_MESHES_H

#include "session/session.h"

void vs_session_free_meshes(vs_session *s);

#endif
