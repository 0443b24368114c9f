/* Declares the advice that is added to errors and warnings. */
#ifndef VS_SESSION_ADVICE_H
#define VS_SESSION_ADVICE_H

#include "session/session.h"

/* Appends advice to the error's text t, or replaces t by a better text. at: the place that the error report shows.
 * Returns false when memory is out. */
bool vs_session_advise(vs_session *s, vs_value condition, vs_span at, vs_text *t);
bool vs_session_advise_empty(vs_session *s, vs_text *t); /* Appends advice to the message "nothing is drawn". Returns
                                                          * false when memory is out. */
/* Called for a top-level form that is only the name of a procedure v. Warns if more text follows on its line, as in
 * make-box (xyz 0 0 0) (xyz 1 1 1). */
void vs_session_advise_named(vs_session *s, vs_value v, vs_pos place);

#endif
