/* Owns the advice that errors and warnings get when they are shown. */
#ifndef VS_SESSION_ADVICE_H
#define VS_SESSION_ADVICE_H

#include "session/session.h"

/* Appends advice from the program's own text to t, the error's text, or replaces t by a better one. at: the place that
 * is shown for the error. Returns false when memory is out. */
bool vs_session_advise(vs_session *s, vs_value condition, vs_span at, vs_text *t);
bool vs_session_advise_empty(vs_session *s, vs_text *t); /* the same for a drawing without objects */
/* Warns of a procedure v that is the value of the top-level form at the place if more text follows on its line:
 * make-box (xyz 0 0 0) (xyz 1 1 1). */
void vs_session_advise_named(vs_session *s, vs_value v, vs_pos place);

#endif
