/* Owns programs that are stopped, for the session (vm/stepping/step.h). The host's questions about them stand in
 * visualscheme.h. */
#ifndef VS_SESSION_STOPS_H
#define VS_SESSION_STOPS_H

#include "session/session.h"

/* Says where what runs next may stop, by the flags of its evaluation. */
void vs_session_arm(vs_session *s, unsigned flags);
/* Goes on from stops at what macros made, which nobody wrote; ok: the evaluation has ended well. Returns whether it
 * has then. */
bool vs_session_pass(vs_session *s, bool ok);
/* The outcome of an evaluation that stopped, with the stop kept. */
vs_outcome vs_session_stopped(vs_session *s);
/* Takes the stop that was kept last, and the flags of its evaluation. False: nothing is stopped. */
bool vs_session_take_stop(vs_session *s, vs_value *stop, unsigned *flags);
/* A list of (symbol . value): the variables of the place where the program is stopped. False: out of memory. */
bool vs_session_bindings(vs_session *s, vs_value *out);

#endif
