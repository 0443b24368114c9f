/* Owns the interface of x3d_scene.c: the contents of an X3D scene. */
#ifndef VS_BACKENDS_X3D_X3D_SCENE_H
#define VS_BACKENDS_X3D_X3D_SCENE_H

#include "backends/backend.h"

bool vs_x3d_scene(vs_emitter *e); /* the Scene's contents */

#endif
