/* Owns the interface of names.c: the calls that a condition has ended, for the session. */
#ifndef VS_SESSION_NAMES_H
#define VS_SESSION_NAMES_H

#include "session/session.h"

/* Returns the words of the index-th call of the user's own (run.h) in the vector `calls` of a condition, with its place
 * in *at; NULL if there are fewer. An allocation may move them. */
const vs_value *vs_session_call(vs_session *s, vs_value calls, size_t index, vs_span *at);
bool vs_session_put_value(vs_scheme *vm, vs_text *t, vs_value v, size_t most); /* writes the value; cuts it with " ..."
                                                                                * after `most` bytes */
/* Takes a sample of the procedures that run now. */
void vs_session_look(vs_session *s);

#endif
