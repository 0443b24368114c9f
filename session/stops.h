/* Owns the interface of stops.c: stopped programs, for the session (vm/stepping/step.h). visualscheme.h has the host's
 * questions about them. */
#ifndef VS_SESSION_STOPS_H
#define VS_SESSION_STOPS_H

#include "session/session.h"

/* Sets where the next program may stop, by the flags of its evaluation. */
void vs_session_arm(vs_session *s, unsigned flags);
/* Continues after stops at calls that macros made, which are in no source text. ok: the evaluation has ended well.
 * Returns whether it has ended well afterwards. */
bool vs_session_pass(vs_session *s, bool ok);
/* Returns the outcome of a stopped evaluation, and keeps the stop. */
vs_outcome vs_session_stopped(vs_session *s);
/* Takes the stop that was kept last, and the flags of its evaluation. Returns false if no program is stopped. */
bool vs_session_take_stop(vs_session *s, vs_value *stop, unsigned *flags);
/* Sets *out to a list of (symbol . value): the variables at the place of the stop. Returns false when memory is out. */
bool vs_session_bindings(vs_session *s, vs_value *out);

#endif
