/* Declares the live view's part as a host of the program's scene: its frames, its gizmos (handles to drag), and the
 * user's actions on its nodes. */
#ifndef VS_LIVE_SCENE_HOST_H
#define VS_LIVE_SCENE_HOST_H

#include "live/live_text.h"
#include "visualscheme.h"

/* Adds {"frames":..., "input":..., "gizmos":[...]} to t. Returns true if the scene changes with time, so that frames
 * are needed. */
bool live_scene_needs(vs_scheme *s, live_text *t);
/* Passes an action of the user to the scene. text: a button, and the ray under the mouse as six numbers. */
vs_outcome live_scene_input(vs_scheme *s, const char *kind, const char *text);

#endif
