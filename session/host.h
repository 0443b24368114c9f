/* Owns the interface of host.c: the interpreter's calls of the system. */
#ifndef VS_SESSION_HOST_H
#define VS_SESSION_HOST_H

#include "session/session.h"

void *vs_session_memory(void *session, void *old, size_t old_bytes, size_t bytes);  /* for the VM and the store */
double vs_session_clock(void *session);                                            /* seconds, monotonic */
bool vs_session_interrupted(void *session);
/* Reads a whole file as malloc'ed text; source: also keeps it as a source, for messages. Returns false with the reason
 * in *why. */
bool vs_session_read(vs_session *s, const char *path, bool source, char **text, size_t *length, const char **why);
/* Reports that vs_session_read failed. Returns the outcome. */
vs_outcome vs_session_unread(vs_session *s, const char *path, const char *why);
bool vs_session_keep_source(vs_session *s, const char *name, unsigned first_line, const char *text, size_t length);
void vs_session_close_files(vs_session *s);
void vs_session_free_sources(vs_session *s);

extern const vs_io vs_session_io;

#endif
