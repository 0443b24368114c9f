/* Owns the live view as a host of the program's scene: its frames, what a user does to its nodes, its gizmos. */
#ifndef VS_LIVE_SCENE_HOST_H
#define VS_LIVE_SCENE_HOST_H

#include "live/live_text.h"
#include "visualscheme.h"

/* Adds {"frames":..., "input":..., "gizmos":[...]} to t. Returns whether something is done in each frame. */
bool live_scene_needs(vs_scheme *s, live_text *t);
/* Hands on what a user did. text: a button, and the ray under the mouse as six numbers. */
vs_outcome live_scene_input(vs_scheme *s, const char *kind, const char *text);

#endif
