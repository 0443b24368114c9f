/* Owns what becomes of POV-Ray's picture before it is handed on. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_PICTURE_H
#define VS_BACKENDS_POVRAY_POVRAY_PICTURE_H

#include "backends/backend.h"

/* Copies an EXR picture to a file that is there, without its date; with the layers that the options ask for. */
bool vs_povray_take_picture(vs_emitter *e, const char *from, const char *to);
/* The same as a PNG, by the options' tone. */
bool vs_povray_develop_picture(vs_emitter *e, const char *from, const char *to);

#endif
