/* Declares the conversion of a drawing to glTF's meshes and nodes. */
#ifndef VS_BACKENDS_GLTF_GLTF_COLLECT_H
#define VS_BACKENDS_GLTF_GLTF_COLLECT_H

#include "backends/backend.h"

bool vs_gltf_open(vs_emitter *e);
void vs_gltf_close(vs_emitter *e);

#endif
