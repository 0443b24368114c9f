/* Declares the running of a program's checks, which checking.c implements. */
#ifndef VS_SESSION_CHECKING_H
#define VS_SESSION_CHECKING_H

#include "session/session.h"

/* Runs all waiting checks after a program that ended without error, and warns of each check that fails. Does nothing if
 * the flags postpone checks. Checks have the same limits as the program. Returns VS_OUTCOME_DONE or
 * VS_OUTCOME_INTERRUPTED. */
vs_outcome vs_session_check(vs_session *s, unsigned flags);

#endif
