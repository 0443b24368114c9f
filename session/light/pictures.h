/* Declares the public functions on pictures of linear light: vs_picture_... of visualscheme.h. */
#ifndef VS_SESSION_LIGHT_PICTURES_H
#define VS_SESSION_LIGHT_PICTURES_H

#include "geometry/pictures/tone.h"
#include "model/node.h"
#include "session/session.h"

/* Converts the public options of tone mapping to those of geometry/. */
vs_tone vs_session_tone(const vs_development *d);
/* Writes a file that appears under its name only when it is complete. */
bool vs_session_write_bytes(const vs_session *s, const char *path, const unsigned char *at, size_t size, vs_error *e);

#endif
