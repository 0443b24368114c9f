/* Declares the running of a program's checks, which checking.c implements. */
#ifndef VS_SESSION_CHECKING_H
#define VS_SESSION_CHECKING_H

#include "session/session.h"

/* Runs all waiting checks after a program that ended without error, and warns about each check that fails. Does nothing
 * if the flags postpone checks. The limits of the program apply to checks, too. Returns VS_OUTCOME_DONE or
 * VS_OUTCOME_INTERRUPTED. */
vs_outcome vs_session_check(vs_session *s, unsigned flags);

#endif
