/* Declares functions on the calls that led to an error, and on samples of running procedures. */
#ifndef VS_SESSION_NAMES_H
#define VS_SESSION_NAMES_H

#include "session/session.h"

/* Returns the data of call number `index` among the user's own calls in the vector `calls` of an error object. Sets *at
 * to the place of the call. Returns NULL if there are fewer calls. An allocation may move the data. */
const vs_value *vs_session_call(vs_session *s, vs_value calls, size_t index, vs_span *at);
/* Appends the value v as text; a text longer than `most` bytes is cut and ends in " ...". */
bool vs_session_put_value(vs_scheme *vm, vs_text *t, vs_value v, size_t most);
/* Takes a sample of the procedures that are running now. */
void vs_session_look(vs_session *s);

#endif
