/* Declares the live view as a host of the program's scene: its frames, its gizmos, and the user's actions on its
 * nodes. */
#ifndef VS_LIVE_SCENE_HOST_H
#define VS_LIVE_SCENE_HOST_H

#include "live/live_text.h"
#include "visualscheme.h"

/* Adds {"frames":..., "input":..., "gizmos":[...]} to t. Returns true if the scene acts in each frame. */
bool live_scene_needs(vs_scheme *s, live_text *t);
/* Passes on an action of the user. text: a button, and the ray under the mouse as six numbers. */
vs_outcome live_scene_input(vs_scheme *s, const char *kind, const char *text);

#endif
