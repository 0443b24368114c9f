/* Declares functions on the calls that led to an error, and on samples of the procedures that run. */
#ifndef VS_SESSION_NAMES_H
#define VS_SESSION_NAMES_H

#include "session/session.h"

/* Returns the data of the call with this index among the calls in the user's own text. `calls` is the vector of calls
 * in an error object. Sets *at to the place of the call. Returns NULL if there are fewer calls. An allocation may move
 * the data. */
const vs_value *vs_session_call(vs_session *s, vs_value calls, size_t index, vs_span *at);
/* Appends the value v as text; a text longer than `most` bytes is cut and ends in " ...". */
bool vs_session_put_value(vs_scheme *vm, vs_text *t, vs_value v, size_t most);
/* Takes a sample of the procedures that are running now. */
void vs_session_look(vs_session *s);

#endif
