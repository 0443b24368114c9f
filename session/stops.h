/* Declares functions on programs that have stopped for a debugger (vm/stepping/step.h). visualscheme.h declares the
 * host's functions for this (vs_stop_get, vs_resume ...). */
#ifndef VS_SESSION_STOPS_H
#define VS_SESSION_STOPS_H

#include "session/session.h"

/* Sets, from the flags of the next evaluation, the places where that evaluation may stop. */
void vs_session_arm(vs_session *s, unsigned flags);
/* If the evaluation stopped at a call that a macro created, which is in no source text, continues to the next stop. ok:
 * whether the evaluation ended without a stop or error. Returns whether the continued evaluation ended without a stop
 * or error. */
bool vs_session_pass(vs_session *s, bool ok);
/* Stores the stop at which the evaluation ended, and returns VS_OUTCOME_STOPPED. */
vs_outcome vs_session_stopped(vs_session *s);
/* Removes the stop that was stored last, and sets *stop and the flags of its evaluation. Returns false if no program is
 * stopped. */
bool vs_session_take_stop(vs_session *s, vs_value *stop, unsigned *flags);
/* Sets *out to a list of (symbol . value), the variables visible at the stop. Returns false when memory is out. */
bool vs_session_bindings(vs_session *s, vs_value *out);

#endif
