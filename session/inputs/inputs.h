/* Owns the interface of inputs.c: the files that a session has read, which no output may overwrite. */
#ifndef VS_SESSION_INPUTS_INPUTS_H
#define VS_SESSION_INPUTS_INPUTS_H

#include <stdbool.h>

#include "session/session.h"

/* Notes an open file that was read, or (made) that the program itself has created. Ignores pipes and others that are no
 * regular files. Returns false when memory is out. */
bool vs_session_note(vs_session *s, const char *path, int file, bool made);
/* As vs_session_note with made false, for the file at path; returns true also if there is no file. */
bool vs_session_note_path(vs_session *s, const char *path);
/* Returns true if the file at path was read, under any name. */
bool vs_session_is_input(const vs_session *s, const char *path);
/* Returns the name of the index-th file read; NULL after the last. */
const char *vs_session_input(const vs_session *s, size_t index);
void vs_session_free_inputs(vs_session *s);

#define VS_INPUT_KEPT "it was read by this run, and no output takes the place of what it is made from"

#endif
