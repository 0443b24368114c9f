/* Owns the list of the files that a session has read: no output may take the place of one. */
#ifndef VS_SESSION_INPUTS_INPUTS_H
#define VS_SESSION_INPUTS_INPUTS_H

#include <stdbool.h>

#include "session/session.h"

/* Notes a file that is open: it was read, or (made) the program itself has begun it. Other things than files of the
 * disk, such as pipes, are passed over. False: out of memory. */
bool vs_session_note(vs_session *s, const char *path, int file, bool made);
/* As vs_session_note of what was read, of a file that stands at path; nothing there: true. */
bool vs_session_note_path(vs_session *s, const char *path);
/* Is what stands at path one of the files that were read, by whatever name? */
bool vs_session_is_input(const vs_session *s, const char *path);
/* The names of what was read; NULL past the last. */
const char *vs_session_input(const vs_session *s, size_t index);
void vs_session_free_inputs(vs_session *s);

#define VS_INPUT_KEPT "it was read by this run, and no output takes the place of what it is made from"

#endif
