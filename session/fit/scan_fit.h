/* Declares the data that a session keeps of its last fit to a scan. */
#ifndef VS_SESSION_FIT_SCAN_FIT_H
#define VS_SESSION_FIT_SCAN_FIT_H

#include "session/session.h"

void vs_session_free_fit(vs_session *s);

#endif
