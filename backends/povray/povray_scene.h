/* Declares the frame of a POV-Ray scene. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SCENE_H
#define VS_BACKENDS_POVRAY_POVRAY_SCENE_H

#include "backends/povray/povray_materials.h"

/* Write the scene's beginning (camera, light, sky) and its end. */
bool vs_povray_begin(vs_emitter *e);
bool vs_povray_end(vs_emitter *e);
double vs_povray_ambient(const vs_emitter *e); /* returns the ambient light, which only drafts have */

#endif
