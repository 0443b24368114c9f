/* Declares the functions that begin and end an evaluation. */
#ifndef VS_SESSION_EVALUATION_H
#define VS_SESSION_EVALUATION_H

#include "session/session.h"

/* Begins an evaluation: resets the counts for the limits, and deletes the data about the previous evaluation. */
void vs_session_begin(vs_session *s, unsigned flags);
/* Ends an evaluation, and reports its error if `ok` is false. usage: whether the error is the caller's fault, so that
 * the exit status is 2. */
vs_outcome vs_session_finish(vs_session *s, bool ok, bool usage);

/* Returns true if the object is the error object that a call of (exit code) raises. */
bool vs_session_is_exit(vs_value condition);

#endif
