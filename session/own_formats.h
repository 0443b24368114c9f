/* Declares the formats that a host defines (vs_register_format), implemented in own_formats.c. */
#ifndef VS_SESSION_OWN_FORMATS_H
#define VS_SESSION_OWN_FORMATS_H

#include "session/session.h"

/* Returns the host's format with this name or suffix, or the format of a path by its suffix. Returns NULL if there is
 * none. */
const vs_format *vs_session_own_format(const vs_session *s, const char *text);
void vs_session_free_own_formats(vs_session *s);

#endif
