/* Owns the interface of checking.c: running the checks that wait. */
#ifndef VS_SESSION_CHECKING_H
#define VS_SESSION_CHECKING_H

#include "session/session.h"

/* Behind a program that ended well, unless the flags keep the checks: runs them all within the limits of the program;
 * those that fail are warnings. Returns DONE, or INTERRUPTED. */
vs_outcome vs_session_check(vs_session *s, unsigned flags);

#endif
