/* Declares the general part of a POV-Ray scene: its beginning and its end. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SCENE_H
#define VS_BACKENDS_POVRAY_POVRAY_SCENE_H

#include "backends/povray/povray_materials.h"

/* vs_povray_begin writes the scene's beginning (camera, light, sky), and vs_povray_end its end. */
bool vs_povray_begin(vs_emitter *e);
bool vs_povray_end(vs_emitter *e);
double vs_povray_ambient(const vs_emitter *e); /* returns the brightness that a draft adds to all surfaces; 0 for other
                                                * qualities */

#endif
