/* Owns what a session keeps of the comparison of two drawings. */
#ifndef VS_SESSION_COMPARISON_H
#define VS_SESSION_COMPARISON_H

#include "session/session.h"

void vs_session_free_comparison(vs_session *s);
/* Puts in the place of *ref, the number-th of what vs_drawing_compare found to be shown, whose node the caller owns,
 * one that reaches a little further out where it would share walls with what is unchanged. */
bool vs_session_swell(vs_session *s, size_t number, vs_ref *ref, vs_error *e);

#endif
