/* Owns what a condition keeps of the calls that it ended, for the session. */
#ifndef VS_SESSION_NAMES_H
#define VS_SESSION_NAMES_H

#include "session/session.h"

/* The words of the index-th call of the user's own (run.h) in the vector `calls` of a condition, and where it was;
 * NULL: there are not so many. They move at the next allocation. */
const vs_value *vs_session_call(vs_session *s, vs_value calls, size_t index, vs_span *at);
bool vs_session_put_value(vs_scheme *vm, vs_text *t, vs_value v, size_t most); /* written, and cut with " ..." */
/* Notes which procedures run now. */
void vs_session_look(vs_session *s);

#endif
