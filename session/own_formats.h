/* Owns the interface of own_formats.c: the formats that a host brings (vs_register_format). */
#ifndef VS_SESSION_OWN_FORMATS_H
#define VS_SESSION_OWN_FORMATS_H

#include "session/session.h"

/* The host's format of this name, ending or path; NULL: it brought none such. */
const vs_format *vs_session_own_format(const vs_session *s, const char *text);
void vs_session_free_own_formats(vs_session *s);

#endif
