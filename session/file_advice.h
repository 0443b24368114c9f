/* Declares the functions of file_advice.c. */
#ifndef VS_SESSION_FILE_ADVICE_H
#define VS_SESSION_FILE_ADVICE_H

#include "session/session.h"

/* Appends the file that was probably meant to t, the error of a file that is not there. The host lists its folder.
 * Returns false when memory is out. */
bool vs_session_advise_file(vs_scheme *vm, vs_text *t);

#endif
