/* Owns the live view's interface: one call that serves a model until it is ended. A client of visualscheme.h alone.
 *
 * live.c: the session, which evaluates in the calling thread; aside.c: a second interpreter in a thread of its own, for
 * outputs with other values; published.c: what windows are told, under one lock; serve.c: HTTP, a thread a
 * connection; said.c: what a run prints and its messages; waiting.c: how many clients may be slow; http.c:
 * libmicrohttpd, loaded when the first view opens; chunks.c: a scene in pieces, so that only what changed travels;
 * scene_host.c: the program's scene, its frames and gizmos; model_files.c: reading, watching and writing the model's
 * files. */
#ifndef VS_LIVE_LIVE_H
#define VS_LIVE_LIVE_H

#include "live/live_options.h"

/* A view of an interpreter that somebody else uses: the prompt. All calls come from the thread that uses it. */
typedef struct live_follower live_follower;

typedef enum { LIVE_NOTHING, LIVE_ASKED_SET, LIVE_ASKED_PROMPT } live_asked_kind;
typedef struct { live_asked_kind kind; char *name, *value; } live_asked; /* live_asked_free frees both */

/* Opens a view on what the interpreter draws; o->model, interpreter's host, parameters, ended and running count for
 * nothing. The address is told, and the drawing shown as it is. NULL: what failed has been said on standard error. */
live_follower *live_follow(const live_options *o, vs_scheme *scheme);
void live_follow_close(live_follower *f);
void live_follow_tell(const live_follower *f); /* the address once more, and the browser */
/* Messages from here on belong to the next thing that is shown; the host hands over what it is told. */
void live_follow_begin(live_follower *f);
void live_follow_output(live_follower *f, const char *text, size_t length);
void live_follow_value(live_follower *f, const char *text, size_t length);
void live_follow_diagnose(live_follower *f, const vs_diagnostic *d);
/* Shows the drawing as it is, and what was said. */
void live_follow_show(live_follower *f);
/* The next request of a window. Outputs are made at once, here. LIVE_NOTHING: no window asks for anything. */
live_asked live_follow_asked(live_follower *f);
void live_asked_free(live_asked *a);

/* Shows the model until *ended is set. Returns VS_OUTCOME_DONE then; VS_OUTCOME_USAGE: the model cannot be read;
 * VS_OUTCOME_WORKER: no libmicrohttpd; VS_OUTCOME_MACHINE: no memory or no port. A failure has been told on standard
 * error. */
vs_outcome live_view(const live_options *o);

#endif
