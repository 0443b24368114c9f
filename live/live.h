/* Declares the live view: a call that serves a model until it ends. It is a client of visualscheme.h only.
 *
 *   live.c         the session, which evaluates in the calling thread
 *   aside.c        a second interpreter in its own thread, for outputs with other values, and a third for exports
 *   open_browser.c the browser that opens the page
 *   published.c    the state that windows receive, under one lock
 *   serve.c        HTTP, a thread for each connection
 *   live_options.c reading files, also those of an untrusted model
 *   access.c       which requests the server accepts
 *   said.c         the printed text and the messages of a run
 *   waiting.c      a limit on slow clients
 *   http.c         libmicrohttpd, loaded when the first view opens
 *   chunks.c       a scene in pieces, so that only changes are sent
 *   scene_host.c   the program's scene, its frames and gizmos
 *   model_files.c  reading, watching and writing the model's files */
#ifndef VS_LIVE_LIVE_H
#define VS_LIVE_LIVE_H

#include "live/live_options.h"

/* A view of the interpreter that the prompt uses. All calls must come from the prompt's thread. */
typedef struct live_follower live_follower;

typedef enum { LIVE_NOTHING, LIVE_ASKED_SET, LIVE_ASKED_PROMPT } live_asked_kind;
typedef struct { live_asked_kind kind; char *name, *value; } live_asked; /* A request of a window to the prompt;
                                                                          * live_asked_free frees name and value. */

/* Opens a view of the interpreter's drawing, prints the view's address and shows the current drawing. Ignores these
 * members of o: model, the interpreter's host, parameters, ended and running. Returns NULL after a message on standard
 * error. */
live_follower *live_follow(const live_options *o, vs_scheme *scheme);
void live_follow_close(live_follower *f);
void live_follow_tell(const live_follower *f); /* Prints the view's address again, and opens the browser. */
/* live_follow_begin: the messages that follow belong to the drawing that live_follow_show shows next.
 * live_follow_output receives these messages from the host. */
void live_follow_begin(live_follower *f);
void live_follow_output(live_follower *f, const char *text, size_t length);
void live_follow_value(live_follower *f, const char *text, size_t length);
void live_follow_diagnose(live_follower *f, const vs_diagnostic *d);
/* Shows the current drawing and the messages received since live_follow_begin. */
void live_follow_show(live_follower *f);
/* Returns the next request of a window, or LIVE_NOTHING if there is none. Does not return requests for outputs, which
 * it handles itself. */
live_asked live_follow_asked(live_follower *f);
void live_asked_free(live_asked *a);

/* Opens a view without threads, for a host that is the server's only client (live/playground/). The host calls the
 * functions below; none of them waits. Returns NULL on failure, after a message on standard error. o must exist until
 * the view is closed. */
live_follower *live_alone_open(const live_options *o);
void live_alone_run(live_follower *l);  /* Runs the model for the first time. */
bool live_alone_turn(live_follower *l); /* Handles all waiting requests. Returns true if the scene is animated, so that
                                         * the host must call this function again soon. */
/* Returns the view's server, to which the host passes the window's requests. */
const struct live_server *live_alone_server(const live_follower *l);
void live_alone_close(live_follower *l);

/* Shows the model until *ended is set, and then returns VS_OUTCOME_DONE. On failure, after a message on standard error,
 * returns VS_OUTCOME_USAGE if the model cannot be read, VS_OUTCOME_WORKER if libmicrohttpd is missing,
 * VS_OUTCOME_MACHINE if there is no memory or no port. */
vs_outcome live_view(const live_options *o);

#endif
