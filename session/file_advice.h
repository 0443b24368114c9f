/* Declares the advice on files that do not exist, implemented in file_advice.c. */
#ifndef VS_SESSION_FILE_ADVICE_H
#define VS_SESSION_FILE_ADVICE_H

#include "session/session.h"

/* If the error's text t reports a file that does not exist, appends the name of the file that was probably meant. The
 * host lists the folder. Returns false when memory is out. */
bool vs_session_advise_file(vs_scheme *vm, vs_text *t);

#endif
