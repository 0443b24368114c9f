/* Owns the advice that errors and warnings get when they are shown. */
#ifndef VS_SESSION_ADVICE_H
#define VS_SESSION_ADVICE_H

#include "session/session.h"

/* Appends to t, the error's text, what the program's own text says about the error, or replaces t by something better.
 * at: where the error is shown. False: out of memory. */
bool vs_session_advise(vs_session *s, vs_value condition, vs_span at, vs_text *t);
bool vs_session_advise_empty(vs_session *s, vs_text *t); /* the same for a drawing without objects */
/* Warns of a procedure that is the value v of the top-level form at the place, and on the line of which more stands:
 * make-box (xyz 0 0 0) (xyz 1 1 1). */
void vs_session_advise_named(vs_session *s, vs_value v, vs_pos place);

#endif
