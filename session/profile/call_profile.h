/* Declares the samples of a running program. */
#ifndef VS_SESSION_PROFILE_CALL_PROFILE_H
#define VS_SESSION_PROFILE_CALL_PROFILE_H

#include "session/session.h"

void vs_session_look(vs_session *s);           /* takes a sample of the procedures that are running */
void vs_session_resume_profile(vs_session *s); /* sets the clock of the last sample to now, so that earlier time counts
                                                * for no call of the program */
void vs_session_forget_profile(vs_session *s); /* discards the samples */

#endif
