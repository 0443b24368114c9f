/* Owns the interface of checking.c: the running of the checks that wait. */
#ifndef VS_SESSION_CHECKING_H
#define VS_SESSION_CHECKING_H

#include "session/session.h"

/* After a program that ended well, unless the flags keep the checks: runs all checks within the limits of the program,
 * and warns of those that fail. Returns DONE, or INTERRUPTED. */
vs_outcome vs_session_check(vs_session *s, unsigned flags);

#endif
