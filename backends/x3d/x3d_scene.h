/* Declares the contents of an X3D scene. */
#ifndef VS_BACKENDS_X3D_X3D_SCENE_H
#define VS_BACKENDS_X3D_X3D_SCENE_H

#include "backends/backend.h"

bool vs_x3d_scene(vs_emitter *e); /* writes the contents of the Scene */

#endif
