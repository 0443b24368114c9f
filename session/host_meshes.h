/* Owns the interface of host_meshes.c: the meshes that a drawing host has, by the hash of their shapes, and their
 * places. */
#ifndef VS_SESSION_HOST_MESHES_H
#define VS_SESSION_HOST_MESHES_H

#include "session/session.h"

void vs_session_free_meshes(vs_session *s);

#endif
