/* Owns the interface of evaluation.c: the two ends of an evaluation. */
#ifndef VS_SESSION_EVALUATION_H
#define VS_SESSION_EVALUATION_H

#include "session/session.h"

/* Begins an evaluation: the limits count from here; forgets the traces of the last one. */
void vs_session_begin(vs_session *s, unsigned flags);
/* Ends an evaluation and reports its condition if it failed. usage: the fault is the caller's, exit 2. */
vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage);

/* Returns true for the condition with which (exit code) unwinds. */
bool vs_session_is_exit(vs_value condition);

#endif
