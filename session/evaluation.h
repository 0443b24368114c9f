/* Owns the interface of evaluation.c: the two ends of an evaluation. */
#ifndef VS_SESSION_EVALUATION_H
#define VS_SESSION_EVALUATION_H

#include "session/session.h"

/* Begins an evaluation: the limits count from here, and the traces of the last one are forgotten. */
void vs_session_begin(vs_session *s, unsigned flags);
/* Ends it and reports the condition that it failed with; usage: the fault is the caller's, exit 2. */
vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage);

/* Is it the condition that (exit code) unwinds with? */
bool vs_session_is_exit(vs_value condition);

#endif
