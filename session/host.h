/* Declares the system calls of the interpreter, which host.c implements. */
#ifndef VS_SESSION_HOST_H
#define VS_SESSION_HOST_H

#include "session/session.h"

/* Sizes of the structs of options in version 0.1, from their last members then. Members of later versions come behind
 * these and leave the sizes as they are. */
#define VS_SIZE_TO(type, last) (offsetof(type, last) + sizeof ((type *)0)->last)
enum {
  VS_FIRST_OPTIONS = VS_SIZE_TO(vs_options, limit_stack),
  VS_FIRST_FIT_OPTIONS = VS_SIZE_TO(vs_fit_options, confidence),
  VS_FIRST_OUTPUT_OPTIONS = VS_SIZE_TO(vs_output_options, look)
};

/* Copies a struct of options, which begins with its size, from the host to *own, which contains the defaults. Copies
 * the members that the host's header and the library both have. room: the size of *own. first: the size in version
 * 0.1, which a size of 0 means. given may be NULL. */
void vs_session_take_options(void *own, size_t room, size_t first, const void *given);
/* Sets *given, a host's struct of `size` bytes, to the defaults in *own; members that the library lacks become 0. */
void vs_session_give_options(void *given, size_t size, const void *own, size_t room);
void *vs_session_memory(void *session, void *old, size_t old_bytes, size_t bytes);  /* Allocates, reallocates or
                                                                                     * frees memory, for the VM and
                                                                                     * the store. */
double vs_session_clock(void *session);                                            /* Returns monotonic time in
                                                                                    * seconds. */
bool vs_session_interrupted(void *session); /* returns true to interrupt the VM: on a request of the host, or if the
                                             * current output exceeds its time limit */
/* The callback vs_job.going of the session's jobs: reports progress to the host. Returns false if the host
 * interrupts. */
bool vs_session_going(void *session, const char *stage, double fraction);
/* Returns the job (limits, progress and messages) for work other than an output; this job has no time limit of its
 * own. */
vs_job vs_session_job(vs_session *s);
/* Reads a whole file as text, which the caller frees. If `source` is true, also keeps a copy of the text, whose lines
 * messages show. On failure, returns false and sets *why to the reason. */
bool vs_session_read(vs_session *s, const char *path, bool source, char **text, size_t *length, const char **why);
/* Reports that the file could not be read. why: the reason that vs_session_read has set. Returns the outcome of the
 * failure. */
vs_outcome vs_session_unread(vs_session *s, const char *path, const char *why);
bool vs_session_keep_source(vs_session *s, const char *name, unsigned first_line, const char *text, size_t length);
void vs_session_close_files(vs_session *s);
void vs_session_free_sources(vs_session *s);

extern const vs_io vs_session_io;

#endif
