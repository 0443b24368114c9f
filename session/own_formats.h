/* Owns the interface of own_formats.c: the formats that a host defines (vs_register_format). */
#ifndef VS_SESSION_OWN_FORMATS_H
#define VS_SESSION_OWN_FORMATS_H

#include "session/session.h"

/* Returns the host's format of this name, ending or path; NULL if there is none. */
const vs_format *vs_session_own_format(const vs_session *s, const char *text);
void vs_session_free_own_formats(vs_session *s);

#endif
