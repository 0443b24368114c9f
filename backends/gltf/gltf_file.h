/* Declares the writing of the .glb file. */
#ifndef VS_BACKENDS_GLTF_GLTF_FILE_H
#define VS_BACKENDS_GLTF_GLTF_FILE_H

#include "backends/backend.h"

bool vs_gltf_write(vs_emitter *e);

#endif
