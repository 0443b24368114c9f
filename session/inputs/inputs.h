/* Declares the list of files that a session has read, and that no output may overwrite. */
#ifndef VS_SESSION_INPUTS_INPUTS_H
#define VS_SESSION_INPUTS_INPUTS_H

#include <stdbool.h>

#include "session/session.h"

/* Adds an open file that was read or, with made true, that the program itself created. Ignores pipes and everything
 * that is not a regular file. Returns false when memory is out. */
bool vs_session_note(vs_session *s, const char *path, int file, bool made);
/* Adds the file at path as read. Returns false when memory is out, and true even if there is no such file. */
bool vs_session_note_path(vs_session *s, const char *path);
/* Returns true if the file at path was read, even under another name. */
bool vs_session_is_input(const vs_session *s, const char *path);
/* Returns the name of the file read with this index, or NULL if there is none. */
const char *vs_session_input(const vs_session *s, size_t index);
void vs_session_free_inputs(vs_session *s);

#define VS_INPUT_KEPT "it was read by this run, and no output takes the place of what it is made from"

#endif
