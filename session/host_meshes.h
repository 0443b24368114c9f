/* Owns what a host that draws has been handed: meshes by the hash of what they are, and where each stands. */
#ifndef VS_SESSION_HOST_MESHES_H
#define VS_SESSION_HOST_MESHES_H

#include "session/session.h"

void vs_session_free_meshes(vs_session *s);

#endif
