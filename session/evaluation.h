/* Declares the begin and the end of an evaluation. */
#ifndef VS_SESSION_EVALUATION_H
#define VS_SESSION_EVALUATION_H

#include "session/session.h"

/* Begins an evaluation: limits are counted from here; data about the previous evaluation is deleted. */
void vs_session_begin(vs_session *s, unsigned flags);
/* Ends an evaluation, and reports its error unless `ok`. usage: the error is the caller's fault, so the exit status is
 * 2. */
vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage);

/* Returns true if the error object is the one that (exit code) raises. */
bool vs_session_is_exit(vs_value condition);

#endif
